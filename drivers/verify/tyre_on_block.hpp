#pragma once
// The bodies that most verification cases share: a crowned ring, loaded at its bore, on a block.

#include <string>
#include <vector>

#include "core/math/hertz.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/verify/verify_case.hpp"

namespace tread {

/// The half-space that theory means has the pair's contact modulus and, under friction, ElasticPair::alike().
/// Friction between unequal bodies depends on Dundurs' constant too, which these references leave out;
/// without friction they hold for any pair.
struct TyreOnBlock {
  double radius = 0.43;  ///< radius of the rolling circle [m]
  double crown_radius =
      0.3;                  ///< across; 0: a slice, one element wide, of a wide cylinder in plane strain [m]
  double load = 87564.06;   ///< F_N [N]
  ElasticPair elastic{};    ///< of wheel and block
  double friction = 0;      ///< coefficient f [-]
  double element_size = 0;  ///< in the contact [m]
  double grid_offset = 0;   ///< by which the meshes are shifted, along and across, in elements [-]
  double roll = 0;          ///< way that the wheel rolls [m]
  Span fine{};              ///< stretch of fine elements; empty: two semi-axes on either side of x = 0 [m]
  double thickness = 0;     ///< of the ring; 0: 12 semi-axes, as the block [m]
  /// The bore is led forward, and only the part of the ring that rolls is there, with ten semi-axes of tread
  /// before and behind it.
  bool guided = false;
  int points = 3;                      ///< points of contact per face and direction
  bool facets = false;                 ///< true for contact on facets in place of exact profiles
  double penetration = 0;              ///< penetration over Hertz's approach; 0: program's own penalty [-]
  std::string more;                    ///< further tables of the scene
  std::vector<std::string> overrides;  ///< overrides of keys, as on the command line

  /// Hertz patch. For a slice semi_axis_y is 0 and the load that of one element's width.
  HertzPatch hertz_patch() const;
  /// Element size over the patch's smaller semi-axis, 1 for 1.1 mm and the paper's 5.25 mm: bounds grow with
  /// it [-].
  double fineness() const;
  /// Makes the wheel roll the distance `way` [m], whose last part `observed` [m] has fine elements. `keys`
  /// are further ones of the table [motion].
  void roll_on(double speed, double way, double observed, const std::string& keys);
  /// The scene, as a file would state it. The block is 16 semi-axes wide, the bodies 12 semi-axes thick, in
  /// place of the theory's half-space.
  Scene scene() const;
};

/// Inputs: radius, crown_radius (where `sphere` is false), load, youngs_modulus, poissons_ratio,
/// wheel_youngs_modulus, wheel_poissons_ratio, element_size (its default is given, [m]), grid_offset, points,
/// facets, penetration.
std::vector<VerifyInput> tyre_inputs(bool sphere, double element_size = 1.1e-3);
TyreOnBlock tyre_of(const VerifyInputs& inputs, bool sphere);

/// A tyre with a guided bore and friction, which a torque drives. Inputs: those of tyre_inputs(false),
/// friction, mu. driven_tyre() throws InputError unless mu is below 0.95 of friction and not zero.
std::vector<VerifyInput> driven_inputs(double element_size = 1.1e-3);
TyreOnBlock driven_tyre(const VerifyInputs& inputs);

/// The key of [motion] for a torque that grows to mu F_N within `ramp` [s].
std::string smooth_traction(double mu, double ramp);

/// States Dundurs' constant where the bodies are not alike: the reference leaves it out.
void add_dundurs(const TyreOnBlock& bodies, CaseResult& result);

/// Largest sizes that a case of plane strain allows.
struct SliceLimits {
  double semi_axis;     ///< semi-axis of the patch over the radius [-]
  double element_size;  ///< element size over the patch's semi-axis [-]
};

/// A slice under the load that gives the patch its semi-axis. Inputs: radius, semi_axis, youngs_modulus,
/// poissons_ratio, element_size, friction. Throws InputError beyond the limits.
TyreOnBlock slice_of(const VerifyInputs& inputs, const SliceLimits& limits);

/// Cartesian displacement [m] at the point (p, q) of an extruded or revolved block's section and the station
/// coordinate s.
Vec3 displacement_at(const Model& model, int block, double p, double q, double s, ConstNodeField u);

}  // namespace tread
