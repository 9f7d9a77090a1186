#pragma once
// Depth of the corrugated running surface. [paper, eqs. (6) and (7)]

#include <cstdint>
#include <optional>
#include <vector>

namespace tread {

/// Depth d(x, y) below the smooth surface [m], negative above it; zero outside of [start, start + length] and
/// of |y - centre| < width.
class Corrugation {
 public:
  struct Sine {
    double wavelength;  ///< L [m]
    double depth;       ///< d_m [m]
  };

  /// Roughness: waves of one amplitude at even distances of wavenumber, their phases drawn by `seed`.
  struct Random {
    double rms;          ///< of the depth between the ends that fade [m]
    double shortest;     ///< wavelength [m]
    double longest;      ///< wavelength [m]
    std::uint64_t seed;  ///< the same depths everywhere
  };

  /// The smooth rail.
  Corrugation() = default;

  /// Eqs. (6) and (7); `length` is cut to whole waves.
  Corrugation(Sine sine, double start, double length, double centre, double width);

  /// Depths measured along the rail, joined by monotone cubics; x counts from `start`.
  Corrugation(std::vector<double> x, std::vector<double> depth, double start, double centre, double width);

  /// Random depths, which fade over half the longest wave at either end. [theory.md, eq. (W1)]
  static Corrugation rough(const Random& random, double start, double length, double centre, double width);

  /// Positive downwards [m].
  double depth(double x, double y) const;

  bool smooth() const { return !(last_ > first_); }
  double first() const { return first_; }        ///< [m]
  double last() const { return last_; }          ///< [m]
  double deepest() const { return deepest_; }    ///< below the highest place, smooth rail included [m]
  double steepest() const { return steepest_; }  ///< no slope along the rail exceeds it [-]
  double centre() const { return centre_; }
  double width() const { return width_; }  ///< [m]

 private:
  double profile(double x) const;

  Sine sine_{1, 0};
  double first_ = 0, last_ = 0, centre_ = 0, width_ = 1, deepest_ = 0, steepest_ = 0;
  std::vector<double> x_, depth_, slope_;
};

/// 1 but for `fade` [m] at either end of [0, length] [m], where it falls to 0 as half a cosine.
double end_taper(double x, double length, double fade);

/// The first place [m] up to `end` where the depths differ by more than `tolerance` [m] anywhere across the
/// rail; looked for every 0.05 mm.
std::optional<double> first_difference(const Corrugation& a, const Corrugation& b, double end,
                                       double tolerance);

}  // namespace tread
