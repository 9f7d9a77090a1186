#pragma once
// Share of a station in the values that a node takes by a tie, for a number or for lanes.

#include "kernels/update/node_motion_body.hpp"

namespace tread {

/// Adds the values (t, y, r) of a station, turned to the own basis. `cosine` and `sine` hold the share, too.
template <class V>
TREAD_INLINE void add_station_values(const V& share, const V& cosine, const V& sine, const V& t, const V& y,
                                     const V& r, V (&sum)[3]) {
  sum[0] += product(cosine, t) - product(sine, r);
  sum[1] += product(share, y);
  sum[2] += product(sine, t) + product(cosine, r);
}

}  // namespace tread
