#pragma once
// The cross-section of a beam: area, moments of inertia, Cowper's shear coefficient.

#include <vector>

#include "core/material.hpp"
#include "core/mesh/section.hpp"

namespace tread {

struct BeamSection {
  double area = 0;               ///< A [m2]
  double height = 0;             ///< z of the centroid [m]
  double depth = 0;              ///< from top to bottom [m]
  double foot = 0;               ///< distance from the centroid down to the bottom [m]
  double vertical = 0;           ///< I, integral of z^2 about the centroid: vertical bending [m4]
  double lateral = 0;            ///< integral of y^2 [m4]
  double shear_coefficient = 0;  ///< kappa, vertical bending [-]
  double foot_shear = 0;         ///< G times the foot's motion along x by a force per length on it [-]
  double foot_warping = 0;       ///< G times the foot's motion along x by a shear force [1/m]
};

/// Section of one or two plane quad meshes (y, z), the second tied to the first along both paths "tie". The
/// section has to be symmetric about a vertical line. kappa by the shear stresses of Saint-Venant's flexure,
/// the foot's motions beyond the plane section's by the same and by those of a force along the bottom.
/// [theory.md, eqs. B3, B6]
BeamSection beam_section(const std::vector<const Section*>& parts, double poissons_ratio);

/// Stiffnesses and masses per length of a beam.
struct BeamProperties {
  double bending_stiffness = 0;  ///< E I [N m2]
  double shear_stiffness = 0;    ///< kappa G A [N]; 0: rigid in shear (Euler)
  double mass = 0;               ///< rho A [kg/m]
  double rotary_inertia = 0;     ///< rho I [kg m]
  double depth = 0;              ///< of the section [m]; 0: a line
  double axial_stiffness = 0;    ///< E A [N]; 0: rigid along x, the foot does not move along
  double foot = 0;               ///< distance from the centroid down to the foot [m]
  double foot_warping = 0;       ///< by which the angle of shear moves the foot along x [m]
  /// Motion of the foot along x by a force per length on it, beyond that by rotation and shear [m2/N].
  double foot_compliance = 0;

  /// Has a foot whose motion along x the fastenings can hold.
  bool has_foot() const { return axial_stiffness > 0; }
};

BeamProperties timoshenko(const BeamSection& section, const Material& material);
BeamProperties euler(const BeamSection& section, const Material& material);

/// Standard deviation of the normal distribution by which a wave of load on the head, of the given wave
/// number [1/m], has to be spread so that Timoshenko's beam deflects like the bottom of an elastic strip as
/// deep as the section. [theory.md, eq. B4] [m]
double head_spread(double depth, double poissons_ratio, double wave_number);

/// Frequency of the waves of wave number k on the free beam, lower branch. [theory.md, eq. B2] [Hz]
double wave_frequency(const BeamProperties& beam, double wave_number);

/// The same of the upper branch, on which the section turns against its deflection; of a Timoshenko beam.
/// [Hz]
double upper_wave_frequency(const BeamProperties& beam, double wave_number);

/// Wave number of the waves of a frequency on the free beam. [1/m]
double wave_number(const BeamProperties& beam, double frequency);

}  // namespace tread
