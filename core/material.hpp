#pragma once
// Isotropic materials.

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace tread {

/// A spring of `strength` times the elasticity in series with a dashpot, beside the elasticity.
/// [theory.md, Maxwell branch]
struct MaxwellBranch {
  double strength;  ///< g [-]
  double time;      ///< of relaxation, tau [s]
};

struct Material {
  std::string name;
  double youngs_modulus = 0;  ///< E [Pa]
  double poissons_ratio = 0;  ///< nu [-]
  double density = 0;         ///< rho [kg/m3]
  /// Stiffness-proportional damping, stated in one of two ways; at most one is not zero.
  double rayleigh_beta = 0;            ///< classical [s]
  double high_frequency_fraction = 0;  ///< fraction of critical at the highest frequency of the mesh of this
                                       ///< material (LS-DYNA's positive COEF) [-]
  /// rayleigh_beta holds below this frequency, by a Maxwell branch; none: at all frequencies. [Hz]
  std::optional<double> damping_up_to = {};
  std::string law = "elastic";     ///< name of one of kernels/material/laws.hpp
  double yield_stress = 0;         ///< initial, in uniaxial tension (law "j2") [Pa]
  double isotropic_hardening = 0;  ///< slope of the yield stress over the equivalent plastic strain [Pa]
  double kinematic_hardening = 0;  ///< slope of the backstress over the uniaxial plastic strain [Pa]

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
  double lame_lambda() const {
    return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }
  /// Its loss is beta w / (1 + (w tau)^2), nine tenths of beta w at damping_up_to. [theory.md, eq. 12d]
  std::optional<MaxwellBranch> branch() const {
    if (!damping_up_to || rayleigh_beta == 0) return std::nullopt;
    const double time = 1 / (6 * std::numbers::pi * *damping_up_to);
    return MaxwellBranch{rayleigh_beta / time, time};
  }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
  /// Speed of a pressure wave [m/s].
  double pressure_wave_speed() const { return std::sqrt((lame_lambda() + 2 * shear_modulus()) / density); }
};

}  // namespace tread
