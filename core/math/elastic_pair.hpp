#pragma once
// Elastic constants of one body and of two bodies in contact. [Johnson, Contact Mechanics, ch. 4 and 5]

namespace tread {

/// Constants of an isotropic elastic body.
struct ElasticConstants {
  double youngs_modulus = 0;  ///< E [Pa]
  double poissons_ratio = 0;  ///< nu [-]

  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }  ///< G [Pa]
};

/// Constants of the wheel and of the rail that it touches.
struct ElasticPair {
  ElasticConstants wheel;
  ElasticConstants rail;

  /// E* = 1 / ((1 - nu1^2) / E1 + (1 - nu2^2) / E2) [Pa]. [Johnson, sect. 4.2]
  double contact_modulus() const;

  /// The material of two alike half-spaces that are as compliant as the pair, under pressure and under shear:
  /// 1/G and nu/G are the bodies' means. It is exact but for dundurs_constant(), which it takes as zero.
  /// [Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, ch. 1]
  ElasticConstants alike() const;

  /// Dundurs' constant beta: pressure shears the surfaces against each other, and shear stress opens them, in
  /// proportion to it; zero for alike bodies, positive where the wheel is the more compliant. [Johnson,
  /// eq. 5.3]
  double dundurs_constant() const;
};

}  // namespace tread
