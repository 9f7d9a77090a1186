#include "core/math/elastic_pair.hpp"

namespace tread {

// Ratios of the bodies' moduli keep the result of alike bodies exact to the last bit.

double ElasticPair::contact_modulus() const {
  const double wheel_part = 1 - wheel.poissons_ratio * wheel.poissons_ratio;
  const double rail_part = 1 - rail.poissons_ratio * rail.poissons_ratio;
  return wheel.youngs_modulus / (wheel_part + rail_part * (wheel.youngs_modulus / rail.youngs_modulus));
}

ElasticConstants ElasticPair::alike() const {
  const double ratio = wheel.shear_modulus() / rail.shear_modulus();
  const double nu = (wheel.poissons_ratio + ratio * rail.poissons_ratio) / (1 + ratio);
  return {wheel.youngs_modulus * ((1 + nu) / (1 + wheel.poissons_ratio)) * (2 / (1 + ratio)), nu};
}

double ElasticPair::dundurs_constant() const {
  const double ratio = wheel.shear_modulus() / rail.shear_modulus();
  const double nu1 = wheel.poissons_ratio;
  const double nu2 = rail.poissons_ratio;
  return 0.5 * ((1 - 2 * nu1) - ratio * (1 - 2 * nu2)) / ((1 - nu1) + ratio * (1 - nu2));
}

}  // namespace tread
