#pragma once
// Units of a keyword deck: mm, ms, kg, kN, GPa. A value in SI times its factor is the deck's value.

namespace tread::deck_unit {

inline constexpr const char* kNames = "mm, ms, kg, kN, GPa";

inline constexpr double kLength = 1e3;         ///< mm per m
inline constexpr double kTime = 1e3;           ///< ms per s
inline constexpr double kForce = 1e-3;         ///< kN per N
inline constexpr double kStress = 1e-9;        ///< GPa per Pa
inline constexpr double kDensity = 1e-9;       ///< kg/mm3 per kg/m3
inline constexpr double kStiffness = 1e-6;     ///< kN/mm per N/m
inline constexpr double kDamping = 1e-3;       ///< kN ms/mm per N s/m
inline constexpr double kAcceleration = 1e-3;  ///< mm/ms2 per m/s2
// A mass in kg, a speed in mm/ms and a torque in kN mm have their values in SI.

}  // namespace tread::deck_unit
