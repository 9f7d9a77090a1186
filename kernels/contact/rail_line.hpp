#pragma once
// Deflection of the rail's running surface along a line. [paper, Fig. 7]

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/state_list.hpp"

namespace tread {

/// Vertical displacement of a row of surface nodes: in the static state, and rolling, when it was last noted.
/// It only observes.
class RailLine {
 public:
  /// The row nearest to y [m].
  RailLine(const SweptBlock& rail, double y);

  /// Upward displacement of its nodes, by station [m].
  std::vector<double> rise(ConstNodeField displacement) const;

  /// `at_rest`: rise() of the static state; empty: zeros.
  void note_static(std::span<const double> at_rest);
  /// `wheel_x`: where the wheel stands [m].
  void note_rolling(ConstNodeField displacement, double wheel_x);

  const std::vector<std::int64_t>& slots() const { return slot_; }
  const std::vector<double>& x() const { return x_; }              ///< [m]
  const std::vector<double>& at_rest() const { return at_rest_; }  ///< the wheel at the start [m]
  const std::vector<double>& rolling() const { return rolling_; }  ///< [m]
  double wheel_x() const { return wheel_x_; }                      ///< of rolling() [m]

  void list_state(StateList& list) {
    list.add("at_rest", at_rest_);
    list.add("rolling", rolling_);
    list.add("wheel_x", wheel_x_);
  }

 private:
  std::vector<std::int64_t> slot_;
  std::vector<double> x_, at_rest_, rolling_;
  double wheel_x_ = 0;
};

}  // namespace tread
