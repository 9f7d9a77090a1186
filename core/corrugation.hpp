#pragma once
// Depth of the corrugated running surface. [paper, eqs. (6) and (7)]

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "core/inline.hpp"
#include "core/math/monotone_cubic.hpp"
#include "core/running_surface.hpp"

namespace tread {

/// A corrugation as plain data, on a device too.
struct CorrugationView {
  double wavelength, wave_depth;  ///< of a sine, where there is no curve [m]
  double first, last, centre, width;
  MonotoneCubicView curve;
  PlacedDepth map;  ///< in place of profile and parabola, where it has rows

  TREAD_BODY double profile(double x) const {
    if (x <= first || x >= last) return 0;
    if (curve.places == 0)
      return 0.5 * wave_depth * (1 - std::cos(2 * std::numbers::pi * (x - first) / wavelength));
    return curve.value(x);
  }

  /// Depth at a place, positive downwards [m].
  TREAD_BODY double depth(double x, double y) const {
    const double across = (y - centre) / width;
    if (x <= first || x >= last || std::abs(across) >= 1) return 0;
    if (map.shape.rows > 0) {
      const bool beside = y < map.shape.y[0] || y > map.shape.y[map.shape.rows - 1];
      return beside ? 0 : map.shape.at(x - map.at, y).depth;
    }
    return profile(x) * (1 - across * across);
  }
};

/// Depth d(x, y) below the smooth surface [m], negative above it. The depth is zero outside [start, start +
/// length] and outside |y - centre| < width, or beside the outer rows of a map.
class Corrugation {
 public:
  struct Sine {
    double wavelength;  ///< wavelength L [m]
    double depth;       ///< depth d_m [m]
  };

  /// Roughness: waves of equal amplitude at equal steps of wavenumber; `seed` draws their phases.
  struct Random {
    double rms;          ///< root mean square of the depth between the fading ends [m]
    double shortest;     ///< shortest wavelength [m]
    double longest;      ///< longest wavelength [m]
    std::uint64_t seed;  ///< seed of the phases: a seed gives one profile on every machine
  };

  /// A smooth rail.
  Corrugation() = default;

  /// Sine waves of eqs. (6) and (7); `length` is cut to whole waves.
  Corrugation(Sine sine, double start, double length, double centre, double width);

  /// Depths measured along the rail [m], joined by monotone cubics; x counts from `start` [m].
  Corrugation(std::vector<double> x, std::vector<double> depth, double start, double centre, double width);

  /// Depths measured along and across, measured_map() of x from `start` and y from `centre` [m]: `map` from
  /// `first` to `last` along its x, and `width` to either side.
  Corrugation(DepthShapePointer map, double start, double centre, double width);

  /// Random depths that fade over half the longest wave at either end. [theory.md, eq. (W1)]
  static Corrugation rough(const Random& random, double start, double length, double centre, double width);

  /// Depth at a place, positive downwards [m].
  double depth(double x, double y) const { return view().depth(x, y); }
  /// The corrugation as plain data, while this object lives.
  CorrugationView view() const {
    return {
        sine_.wavelength, sine_.depth, first_,        last_,
        centre_,          width_,      curve_.view(), {map_ ? map_->view() : DepthShapeView(), map_start_}};
  }

  bool smooth() const { return !(last_ > first_); }
  double first() const { return first_; }        ///< [m]
  double last() const { return last_; }          ///< [m]
  double deepest() const { return deepest_; }    ///< depth below the highest place, smooth rail included [m]
  double steepest() const { return steepest_; }  ///< upper bound of the slope along the rail [-]
  double centre() const { return centre_; }
  double width() const { return width_; }  ///< [m]

 private:
  Sine sine_{1, 0};
  double first_ = 0, last_ = 0, centre_ = 0, width_ = 1, deepest_ = 0, steepest_ = 0;
  MonotoneCubic curve_;
  DepthShapePointer map_;  ///< in place of profile and parabola
  double map_start_ = 0;   ///< x of the map's zero [m]
};

/// Numbers of waves in a length, whole numbers; `first` above `last`: there are none.
struct WaveRange {
  double first, last;
};

/// Waves from `shortest` to `longest` [m] that fit into `length` [m] as whole numbers.
WaveRange waves_of(double shortest, double longest, double length);

/// Factor 1 that falls to 0 as half a cosine over `fade` [m] at either end of [0, length] [m].
double end_taper(double x, double length, double fade);

/// First place [m] up to `end` [m] where the depths differ by more than `tolerance` [m] anywhere across the
/// rail; the search step is 0.05 mm. Returns nullopt if there is none.
std::optional<double> first_difference(const Corrugation& a, const Corrugation& b, double end,
                                       double tolerance);

}  // namespace tread
