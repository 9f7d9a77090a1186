#pragma once
// Numbers with units, as users write them, into SI.

#include <string>
#include <string_view>

namespace tread {

/// Exponents of metre, kilogram, second and byte.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int data = 0;
  bool operator==(const Dimension&) const = default;
};

/// A unit's size in SI is 10^exponent numerator / denominator. The power of ten goes into the digits of the
/// number before it becomes a double, so that "0.14 mm" is exactly the literal 0.14e-3.
struct Unit {
  int exponent = 0;
  double numerator = 1;
  double denominator = 1;
  Dimension dimension;
};

/// A kind of physical quantity that a key can ask for.
struct Quantity {
  std::string_view name;
  Dimension dimension;
  std::string_view si;        ///< its SI unit, as written in resolved scenes
  std::string_view accepted;  ///< the usual units, as listed in messages
};

inline constexpr Quantity kLength{"length", {1, 0, 0}, "m", "m, cm, mm, um, km"};
inline constexpr Quantity kTime{"time", {0, 0, 1}, "s", "s, ms, us, min, h"};
inline constexpr Quantity kSpeed{"speed", {1, 0, -1}, "m/s", "m/s, mm/s, km/h"};
inline constexpr Quantity kAcceleration{"acceleration", {1, 0, -2}, "m/s2", "m/s2, mm/s2"};
inline constexpr Quantity kMass{"mass", {0, 1, 0}, "kg", "kg, g, t"};
inline constexpr Quantity kDensity{"density", {-3, 1, 0}, "kg/m3", "kg/m3, t/m3, g/cm3"};
inline constexpr Quantity kForce{"force", {1, 1, -2}, "N", "N, kN, MN"};
inline constexpr Quantity kStiffness{"stiffness", {0, 1, -2}, "N/m", "N/m, kN/m, MN/m, N/mm, kN/mm"};
inline constexpr Quantity kViscousDamping{"viscous damping", {0, 1, -1}, "N s/m", "N s/m, kN s/m"};
inline constexpr Quantity kTorque{"torque", {2, 1, -2}, "N m", "N m, kN m"};
inline constexpr Quantity kStress{"stress", {-1, 1, -2}, "Pa", "Pa, kPa, MPa, GPa, N/mm2"};
inline constexpr Quantity kWear{"wear coefficient", {-2, 0, 2}, "kg/N/m", "kg/N/m, g/N/m, ug/N/m"};
inline constexpr Quantity kFrequency{"frequency", {0, 0, -1}, "Hz", "Hz, kHz"};
inline constexpr Quantity kData{"amount of data", {0, 0, 0, 1}, "B", "B, kB, MB, GB"};

/// Parses products, quotients and powers of m, g, t, s, min, h, N, J, Pa, Hz, B with SI prefixes from n to G:
/// "km/h", "kN s/m", "kg/m3", "mm^2", "kg/(N m)". A blank, '*' or '·' multiplies; '/' divides by the next
/// factor alone, or by brackets without others inside. Throws InputError.
Unit parse_unit(std::string_view text);

/// A finite decimal number and nothing else. Throws InputError.
double parse_number(std::string_view text);

/// A finite decimal number of this unit, in SI. Throws InputError.
double parse_number(std::string_view text, const Unit& unit);

/// "1:40" or a number. Throws InputError.
double parse_ratio(std::string_view text);

/// "0.14 mm" in SI. Throws InputError when the number or the unit is malformed, or the unit measures
/// something else; the message shows the number in `unit`, by default the SI unit, unless its own is unknown.
double parse_quantity(std::string_view text, const Quantity& expected, std::string_view unit = {});

/// The same for the value of a command line's option, which the message names.
double parse_option(std::string_view option, std::string_view text, const Quantity& expected);

/// `expected a length, such as "15.2 m" (units: m, cm, ...)`, for messages; `number` is the user's, and
/// empty for no example. Without `unit`, the SI unit.
std::string expectation(const Quantity& expected, const std::string& number, std::string_view unit = {});

/// The value `si` written in `unit` with six digits, "0.14 mm".
std::string format_quantity(double si, const std::string& unit);

}  // namespace tread
