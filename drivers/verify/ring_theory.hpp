#pragma once
// In-plane natural frequencies of a free ring in plane strain.

namespace tread {

struct PlaneRing {
  double inner = 0, outer = 0;  ///< radii [m]
  double youngs_modulus = 0;    ///< [Pa]
  double poissons_ratio = 0;    ///< [-]
  double density = 0;           ///< [kg/m3]
};

/// Frequency [Hz] of the inextensional mode with `waves` >= 2 around, by thin-ring theory with the plane
/// strain modulus. [Love, A Treatise on the Mathematical Theory of Elasticity, sect. 293]
double thin_ring_frequency(const PlaneRing& ring, int waves);

/// Lowest frequency [Hz] with `waves` around by the equations of elasticity: potentials of Bessel functions,
/// both cylinders free of traction. [Gazis, Exact analysis of the plane-strain vibrations of thick-walled
/// hollow cylinders, JASA 30 (1958)]
double exact_ring_frequency(const PlaneRing& ring, int waves);

}  // namespace tread
