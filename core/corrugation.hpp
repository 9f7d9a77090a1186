#pragma once
// Depth of the corrugated running surface. [paper, eqs. (6) and (7)]

#include <optional>
#include <vector>

namespace tread {

/// Depth d(x, y) >= 0 below the smooth surface [m]; zero outside of [start, start + length] and of
/// |y - centre| < width.
class Corrugation {
 public:
  struct Sine {
    double wavelength;  ///< L [m]
    double depth;       ///< d_m [m]
  };

  /// The smooth rail.
  Corrugation() = default;

  /// Eqs. (6) and (7); `length` is cut to whole waves.
  Corrugation(Sine sine, double start, double length, double centre, double width);

  /// Depths measured along the rail, joined by monotone cubics; x counts from `start`.
  Corrugation(std::vector<double> x, std::vector<double> depth, double start, double centre, double width);

  /// Positive downwards [m].
  double depth(double x, double y) const;

  bool smooth() const { return !(last_ > first_); }
  double first() const { return first_; }  ///< [m]
  double last() const { return last_; }    ///< [m]
  double deepest() const { return deepest_; }
  double steepest() const { return steepest_; }  ///< no slope along the rail exceeds it [-]
  double centre() const { return centre_; }
  double width() const { return width_; }  ///< [m]

 private:
  double profile(double x) const;

  Sine sine_{1, 0};
  double first_ = 0, last_ = 0, centre_ = 0, width_ = 1, deepest_ = 0, steepest_ = 0;
  std::vector<double> x_, depth_, slope_;
};

/// The first place [m] up to `end` where the depths differ by more than `tolerance` [m] anywhere across the
/// rail; looked for every 0.05 mm.
std::optional<double> first_difference(const Corrugation& a, const Corrugation& b, double end,
                                       double tolerance);

}  // namespace tread
