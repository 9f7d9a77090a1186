#pragma once
// The contact of a wheel with a sine as half-spaces make it: what the Hertz spring on a profile of points
// misses. [theory.md, Multi-body approach]

#include <array>
#include <utility>
#include <vector>

#include "core/math/elastic_pair.hpp"
#include "core/math/hertz.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

/// Approach of wheel and rail at a place beyond the depth there and the Hertz spring's, over F^(2/3).
struct ContactRelief {
  static constexpr int kLoads = 10;
  std::array<double, kLoads> approach{};  ///< at even steps of F^(2/3), from 0 on [m]
  double pitch = 0;                       ///< of F^(2/3); 0: none [N^(2/3)]

  /// Value and slope at s = F^(2/3), straight between the steps and beyond the last.
  double at(double s) const { return pitch > 0 ? value(s).first : 0; }
  std::pair<double, double> value(double s) const;
};

/// Sine under a wheel.
struct SineUnderWheel {
  double radius = 0;      ///< of the wheel [m]
  double radius_y = 0;    ///< of the lateral gap [m]
  double depth = 0;       ///< of the sine [m]
  double wavelength = 0;  ///< [m]
  double width = 0;       ///< half the width over which the depth falls to 0 as a parabola [m]
  double centre = 0;      ///< of the parabola, across from the contact [m]

  /// Depth at x, y from the contact [m], which lies at a phase beyond a crest [rad].
  double depth_at(double x, double y, double phase) const;
  /// Gap of the wheel that touches the smooth rail, `phase` as in depth_at().
  half_space::Gap gap(double phase) const;
  /// Grid that holds the contact at all phases under the load of a patch on the smooth rail.
  half_space::Grid grid(const HertzPatch& patch) const;
};

/// Reliefs of all phases of a sine.
class SineContact {
 public:
  SineContact() = default;
  /// Presses the wheel on the sine at five phases and nine loads up to `most` [N]. [Kalker, ch. 4, by
  /// kernels/half_space/half_space]
  SineContact(const SineUnderWheel& sine, const ElasticPair& pair, double most);

  bool empty() const { return harmonic_.empty(); }
  double most() const { return most_; }  ///< largest force of the presses [N]
  /// Relief at a phase beyond a crest [rad]; `share` of it [-].
  ContactRelief at(double phase, double share) const;

 private:
  std::vector<ContactRelief> harmonic_;  ///< coefficients of cos(m phase)
  double most_ = 0;
};

}  // namespace tread
