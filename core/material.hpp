#pragma once
// Linear elastic isotropic material.

#include <string>

namespace tread {

struct Material {
  std::string name;
  double youngs_modulus = 0;  ///< E [Pa]
  double poissons_ratio = 0;  ///< nu [-]
  double density = 0;         ///< rho [kg/m3]
  /// Stiffness-proportional damping, stated in one of two ways; at most one is not zero.
  double rayleigh_beta = 0;            ///< classical [s]
  double high_frequency_fraction = 0;  ///< fraction of critical at the highest frequency of the mesh of this
                                       ///< material (LS-DYNA's positive COEF) [-]

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
  double lame_lambda() const {
    return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
};

}  // namespace tread
