#pragma once
// The model of a scene: meshed bodies, their operators, connectors and loads. A part that the scene lacks is
// absent here too.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/aligned.hpp"
#include "core/math/hertz.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/page_vector.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/block_index.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/connectors/connectors.hpp"
#include "kernels/connectors/guided_bore.hpp"
#include "kernels/contact/contact.hpp"
#include "kernels/hexahedra/body_force.hpp"
#include "kernels/ties/body_tie.hpp"
#include "kernels/ties/tie.hpp"
#include "kernels/update/body_motion.hpp"

namespace tread {

/// Size of a mesh.
struct MeshCount {
  std::int64_t elements = 0;
  std::int64_t nodes = 0;
};

/// Looks at the size of a mesh before the fields of its nodes are made, and throws if it is too large.
using AcceptMesh = std::function<void(const MeshCount& count, const MeshSizes& sizes)>;

struct Model {
  /// The smooth rail without `corrugation_centre`; with it the rail as apply_corrugation() leaves it [m].
  /// InputError where the scene cannot be meshed, and what `accept` throws.
  explicit Model(const Scene& scene, std::optional<double> corrugation_centre = {},
                 const AcceptMesh& accept = {});
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  Scene scene;
  MeshSizes sizes;
  Mesh mesh;
  BlockIndex index;
  std::vector<TieSpec> tie_specs;
  std::vector<BodyTieSpec> body_ties;
  std::vector<BodyTie> made_ties;  ///< by body_ties, their nodes in `ties`
  std::optional<Ties> ties;
  std::unique_ptr<InternalForce> internal;              ///< of the blocks
  std::vector<std::unique_ptr<BodyForce>> body_forces;  ///< by Mesh::bodies
  std::vector<std::int64_t> restrained;                 ///< unknowns that stay zero
  PageVector<double> mass;  ///< lumped, ties gathered; scalar node field, 0: tied or unused [kg]

  std::vector<double> beta;  ///< by block: stiffness-proportional damping at all frequencies [s]
  std::vector<std::optional<MaxwellBranch>> branches;  ///< by block: damping up to a frequency

  std::optional<SpringDampers> fastenings;  ///< and behind them the bed of the sleepers
  std::optional<Attachment> hammer;         ///< the struck point of the rail's crown
  std::optional<SpinningBody> wheelset;
  std::optional<GuidedBore> guide;  ///< carries load and torque in place of journal and torque
  Journal journal;                  ///< carries vehicle or load; empty without either
  AxleTorque torque;                ///< empty without traction
  double web_thickness = 0;         ///< of a half wheelset [m]
  double brake_ring_thickness = 0;  ///< of each of the two plates on its web; 0: there are none [m]
  std::unique_ptr<Contact> contact;
  HertzPatch hertz_patch;     ///< of the undeformed surfaces at the touching point under wheel_load()
  double hertz_radius_y = 0;  ///< effective lateral radius used for it [m]
  double line_width = 0;      ///< of a line contact, for which hertz_patch is too long [m]; otherwise 0

  /// hertz_patch where the wheel has a load of 100 N or more; of 100 N where it has less, or none.
  HertzPatch scale_patch() const;
  bool has_branches() const;
  double wheel_load() const;                                      ///< static vertical contact force [N]
  double line_load() const { return wheel_load() / line_width; }  ///< of a line contact [N/m]
  double line_semi_axis() const;                                  ///< of a line contact [m]
  double hertz_pressure() const;  ///< largest of Hertz under wheel_load(), also of a line contact [Pa]
  double journal_load() const;    ///< the part of it that comes in at the journal: vehicle or load [N]
  double wheel_radius() const { return 0.5 * scene.wheel->diameter; }
  std::int64_t elements() const;
  std::int64_t nodes() const;

  /// Blocks and bodies of the wheel, of the rail (Mesh::parts).
  std::vector<int> wheel_parts() const;
  std::vector<int> rail_parts() const;
  const BodyForce* body_force_of(int part) const;             ///< null: a block
  DeformationEnergy energy(int part, const double* u) const;  ///< of a linear law's part [J]
  /// f = F(u) of all blocks and bodies at rest, and f = K u; vector fields of 3 * mesh.slots values [N].
  void internal_force(const double* u, double* f) const;
  void apply_stiffness(const double* u, double* f) const;
  void add_lumped_mass(double* mass) const;  ///< of elements alone; scalar node field [kg]

  /// Nodes to or from whose force a step adds more than their elements do. The force of others is not stored:
  /// a feature that adds to it needs its nodes here.
  std::vector<std::int64_t> loaded_slots() const;
  std::vector<std::int64_t> connected_slots() const;  ///< those of them that are not of ties

  /// Gives the memory of other nodes' masses back. `groups`: marks by slot / kLanes; empty: of all nodes.
  void keep_masses(std::span<const unsigned char> groups);

  /// Moves the surface nodes to the corrugated shape, or adds its depth to the contact gap. Coefficients,
  /// mass and damping are built again where nodes moved. `centre`: y of the deepest line [m].
  void apply_corrugation(double centre);

 private:
  int add(SweptBlock block);
  int add_body(const std::string& name, const BodySpec& spec, const Material& material);
  void build_blocks();
  void build_bodies();
  void tie_blocks();
  void build_operators();
  void build_connectors();
  Corrugation corrugate(double centre);
  double foot_height() const;  ///< of the lowest point of the rail's foot [m]
  void build_rail();
  void build_wheel();
  void build_slab();
  void build_sleepers();
  void build_internal();
  void build_mass();
  void set_damping();
  void build_wheel_parts();
  void build_contact(const Corrugation& shape);
  double penalty_stiffness(const ContactSpec& spec) const;  ///< per area [Pa/m]
};

}  // namespace tread
