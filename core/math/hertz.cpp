#include "core/math/hertz.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread {

namespace {

struct Elliptic {
  double k;     ///< complete elliptic integral K(e)
  double e;     ///< complete elliptic integral E(e)
  double diff;  ///< (K - E) / e^2, finite for e -> 0
};

Elliptic integrals(double ratio) {
  const double e2 = 1 - ratio * ratio;
  const double e = std::sqrt(e2);
  const double k = std::comp_ellint_1(e);
  const double second = std::comp_ellint_2(e);
  const double diff = e2 < 1e-6 ? std::numbers::pi / 4 * (1 + 3 * e2 / 8) : (k - second) / e2;
  return {k, second, diff};
}

/// Ratio (larger / smaller curvature) of the gap whose patch has the axis ratio b / a.
double curvature_ratio(double ratio) {
  const Elliptic i = integrals(ratio);
  const double e2 = 1 - ratio * ratio;
  if (e2 < 1e-6) return 1 + 3 * e2 / 4;
  return (i.e / (ratio * ratio) - i.k) / (i.k - i.e);
}

}  // namespace

double contact_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus / (2 * (1 - poissons_ratio * poissons_ratio));
}

double line_semi_axis(double radius, double contact_modulus, double line_load) {
  return std::sqrt(4 * radius * line_load / (std::numbers::pi * contact_modulus));
}

double line_load(double radius, double contact_modulus, double semi_axis) {
  return std::numbers::pi * contact_modulus * semi_axis * semi_axis / (4 * radius);
}

HertzPatch hertz(double radius_x, double radius_y, double contact_modulus, double load) {
  const double wide = std::max(radius_x, radius_y);
  const double narrow = std::min(radius_x, radius_y);
  double low = 1e-4;
  double high = 1;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (curvature_ratio(middle) > wide / narrow ? low : high) = middle;
  }
  const double ratio = 0.5 * (low + high);
  const Elliptic i = integrals(ratio);
  const double a = std::cbrt(3 * load * i.diff * wide / (std::numbers::pi * contact_modulus));
  const double b = ratio * a;
  const double p0 = 1.5 * load / (std::numbers::pi * a * b);
  HertzPatch patch;
  (radius_x >= radius_y ? patch.semi_axis_x : patch.semi_axis_y) = a;
  (radius_x >= radius_y ? patch.semi_axis_y : patch.semi_axis_x) = b;
  patch.max_pressure = p0;
  patch.approach = p0 / contact_modulus * b * i.k;
  return patch;
}

}  // namespace tread
