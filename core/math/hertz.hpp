#pragma once
// Normal contact of two elastic half-spaces with quadratic gap. [Johnson, Contact Mechanics, ch. 4]

namespace tread {

struct HertzPatch {
  double semi_axis_x = 0;   ///< semi-axis along the rolling direction [m]
  double semi_axis_y = 0;   ///< semi-axis across [m]
  double max_pressure = 0;  ///< [Pa]
  double approach = 0;      ///< approach of distant points [m]
};

/// Contact modulus E* = 1 / ((1 - nu1^2) / E1 + (1 - nu2^2) / E2) of two bodies of one material [Pa].
double contact_modulus(double youngs_modulus, double poissons_ratio);

/// Contact patch of the gap x^2 / (2 radius_x) + y^2 / (2 radius_y). Both radii are positive [m]; `load` [N];
/// `contact_modulus` E* [Pa].
HertzPatch hertz(double radius_x, double radius_y, double contact_modulus, double load);

/// Semi-axis of the contact of a cylinder and a plane under a load per width [m].
double line_semi_axis(double radius, double contact_modulus, double line_load);

/// Load per width under which a cylinder on a plane touches over two semi-axes [N/m].
double line_load(double radius, double contact_modulus, double semi_axis);

}  // namespace tread
