#pragma once
// Area and moments of inertia of a rail's section.

#include "core/geometry/profiles.hpp"

namespace tread {

struct SectionConstants {
  double area = 0;      ///< [m2]
  double centroid = 0;  ///< height of the centroid above the foot's bottom [m]
  double vertical = 0;  ///< second moment of area for bending in the vertical plane [m4]
  double lateral = 0;   ///< the same in the horizontal plane [m4]
};

/// Constants of the outline: head between the side faces' joints, and twice the right half below.
SectionConstants section_constants(const RailProfile& rail);

}  // namespace tread
