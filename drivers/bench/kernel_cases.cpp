#include "drivers/bench/kernel_cases.hpp"

#include <cmath>
#include <memory>
#include <type_traits>

#include "core/body_frame.hpp"
#include "core/mesh/hex_mesh.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/made_up_blocks.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/hexahedra/hex_force.hpp"

namespace tread {

namespace {

constexpr double kDisplacement = 1e-5;  ///< size of made-up displacements [m]
constexpr double kVelocity = 0.1;       ///< [m/s]
constexpr double kForce = 1;            ///< [N]
constexpr double kStep = 1e-10;         ///< step so short that repeated steps hardly change the data [s]

PreparedKernel prepare_empty(std::int64_t elements) {
  PreparedKernel kernel;
  kernel.units = elements;
  kernel.timed.call = [elements] { parallel_ranges(elements, [](std::int64_t, std::int64_t) {}); };
  return kernel;
}

/// A block with all data that a step needs.
template <class Real, class U>
struct BlockData {
  BlockData(const ElementVariant& variant, std::int64_t elements)
      : mesh(made_up_mesh(variant.sweep, variant.perturbed, elements)),
        internal(mesh),
        u(made_up_field<U>(mesh, kDisplacement)),
        v(made_up_field<Real>(mesh, kVelocity)),
        f(made_up_field<Real>(mesh, kForce)),
        inverse_mass(made_up_inverse_mass<Real>(mesh)),
        update(mesh, inverse_mass.data()) {
    mesh.blocks.front().vertical_only = variant.vertical_only;
    internal.set_finite_rotation(0, variant.finite_rotation);
    if (variant.damped) internal.set_beta(0, kDampedBeta);
    loads.dt = kStep;
    loads.gravity = 9.81;
    loads.frame.spin = 194;
  }
  void force() { internal.internal_force(u.data(), v.data(), f.data()); }
  void force_and_motion() {
    internal.move(update, loads, {u.data(), v.data(), f.data()});
    update.move_rest(loads, fields(), internal.unmoved_tiles());
  }
  void motion() { update.move_all(loads, fields()); }
  BasicUpdateFields<Real, U> fields() { return {u.data(), v.data(), f.data()}; }

  Mesh mesh;
  BasicInternalForce<Real, U> internal;
  AlignedVector<U> u;
  AlignedVector<Real> v, f, inverse_mass;
  BasicTimeUpdate<Real, U> update;
  StepLoads loads;
};

void set_work(PreparedKernel& kernel, std::int64_t units, const Work& work) {
  kernel.units = units;
  kernel.work = work;
  kernel.working_set = static_cast<std::int64_t>(work.bytes * static_cast<double>(units));
}

template <class Real, class U>
PreparedKernel prepare_element(const ElementVariant& variant, std::int64_t elements) {
  const auto data = std::make_shared<BlockData<Real, U>>(variant, elements);
  PreparedKernel kernel;
  if (variant.moves)
    kernel.timed.call = [data] { data->force_and_motion(); };
  else
    kernel.timed.call = [data] { data->force(); };
  const SweptBlock& block = data->mesh.blocks.front();
  set_work(kernel, block.elements(), element_work(variant, block, {sizeof(U), sizeof(Real)}));
  kernel.lanes = data->internal.instruction_sets();
  kernel.use_lanes = [data](const char* name) { data->internal.use_instruction_set(name); };
  return kernel;
}

std::string path_of(const ElementVariant& variant) {
  std::string path = variant.sweep == Sweep::revolved ? "revolved" : "extruded";
  if (variant.perturbed) path += " perturbed";
  if (variant.vertical_only) path += ", vertical only";
  path += variant.finite_rotation ? ", finite rotation" : ", linear";
  return variant.damped ? path + ", damped" : path;
}

template <class Real, class U>
const char* precision() {
  if (std::is_same_v<Real, double>) return "double";
  return std::is_same_v<U, double> ? "mixed" : "single";
}

template <class Real, class U>
void add_element(std::vector<KernelCase>& cases, const ElementVariant& variant) {
  cases.push_back({variant.moves ? "force_and_motion" : "internal_force", path_of(variant),
                   precision<Real, U>(), "element",
                   [variant](std::int64_t elements) { return prepare_element<Real, U>(variant, elements); }});
}

/// Instruction set of code that runs with the widest one alone.
std::vector<const char*> widest() {
  return {InternalForce::instruction_sets().front()};
}

template <class Real, class U>
void add_update(std::vector<KernelCase>& cases, const char* path, Sweep sweep, bool vertical_only) {
  cases.push_back(
      {"update", path, precision<Real, U>(), "node", [=](std::int64_t elements) {
         ElementVariant variant;
         variant.sweep = sweep;
         variant.vertical_only = vertical_only;
         const auto data = std::make_shared<BlockData<Real, U>>(variant, elements);
         PreparedKernel kernel;
         kernel.timed.call = [data] { data->motion(); };
         set_work(kernel, data->mesh.slots, update_work(sweep, vertical_only, {sizeof(U), sizeof(Real)}));
         kernel.lanes = widest();
         return kernel;
       }});
}

template <class Real, class U>
void add_updates(std::vector<KernelCase>& cases) {
  add_update<Real, U>(cases, "fixed", Sweep::extruded, false);
  add_update<Real, U>(cases, "fixed, vertical only", Sweep::extruded, true);
  add_update<Real, U>(cases, "spinning", Sweep::revolved, false);
}

template <class Real, class U>
struct TieData {
  explicit TieData(std::int64_t elements)
      : blocks(made_up_tie(elements)),
        ties(blocks.mesh, {blocks.tie}),
        u(made_up_field<U>(blocks.mesh, kDisplacement)),
        v(made_up_field<Real>(blocks.mesh, kVelocity)),
        f(u.size(), 0) {}
  MadeUpTie blocks;
  Ties ties;
  AlignedVector<U> u;
  AlignedVector<Real> v, f;
};

template <class Real, class U>
PreparedKernel prepare_tie(bool hand_over, std::int64_t elements) {
  const auto data = std::make_shared<TieData<Real, U>>(elements);
  constexpr ValueBytes bytes{sizeof(U), sizeof(Real)};
  PreparedKernel kernel;
  if (hand_over)
    kernel.timed.call = [data] { data->ties.hand_over(data->f.data()); };
  else
    kernel.timed.call = [data] { data->ties.follow({data->u.data(), data->v.data()}); };
  set_work(kernel, data->ties.secondary_count(),
           hand_over ? tie_hand_over_work(bytes) : tie_follow_work(bytes));
  kernel.lanes = widest();
  return kernel;
}

template <class Real, class U>
void add_ties(std::vector<KernelCase>& cases) {
  for (const bool hand_over : {true, false})
    cases.push_back(
        {hand_over ? "tie_hand_over" : "tie_follow", "1:3", precision<Real, U>(), "tied node",
         [hand_over](std::int64_t elements) { return prepare_tie<Real, U>(hand_over, elements); }});
}

/// The elements of a straight block one by one, as if another program had meshed it.
PreparedKernel prepare_hexahedra(bool finite_rotation, bool damped, std::int64_t elements) {
  struct Data {
    Data(const SweptBlock& block) : mesh(hexahedra_of(block)), force(mesh, block.materials) {}
    HexMesh mesh;
    HexForce force;
    std::vector<double> u, v, f;
  };
  const Mesh swept = made_up_mesh(Sweep::extruded, false, elements);
  const auto data = std::make_shared<Data>(swept.blocks.front());
  data->force.set_finite_rotation(finite_rotation);
  if (damped) data->force.set_damping(kDampedBeta);
  data->f.resize(kHexNodeValues * data->mesh.nodes.size());
  for (std::size_t i = 0; i < data->f.size(); ++i)
    data->u.push_back(i % kHexNodeValues == 3 ? 0.0
                                              : kDisplacement * std::sin(0.37 * static_cast<double>(i)));
  PreparedKernel kernel;
  data->v.assign(data->f.size(), 0.0);
  kernel.timed.call = [data] { data->force.internal_force(data->u.data(), data->v.data(), data->f.data()); };
  // Coefficients are read; rows of displacements, forces and velocities too, and forces are written.
  const std::int64_t rows = (damped ? 4 : 3) * static_cast<std::int64_t>(data->f.size() * sizeof(double));
  const auto units = static_cast<std::int64_t>(data->mesh.elements.size());
  set_work(kernel, units, {0, static_cast<double>(data->force.bytes() + rows) / static_cast<double>(units)});
  kernel.lanes = HexForce::instruction_sets();
  kernel.use_lanes = [data](const char* name) { data->force.use_instruction_set(name); };
  return kernel;
}

void add_hexahedra(std::vector<KernelCase>& cases) {
  for (const bool finite_rotation : {false, true})
    for (const bool damped : {false, true}) {
      const char* const law = finite_rotation ? "general, finite rotation" : "general, linear";
      cases.push_back({"hexahedra", std::string(law) + (damped ? ", damped" : ""), "double", "element",
                       [finite_rotation, damped](std::int64_t elements) {
                         return prepare_hexahedra(finite_rotation, damped, elements);
                       }});
    }
}

void add_elements(std::vector<KernelCase>& cases, ElementVariant variant) {
  for (const bool moves : {false, true}) {
    variant.moves = moves;
    add_element<double, double>(cases, variant);
    add_element<float, double>(cases, variant);
    add_element<float, float>(cases, variant);
  }
}

}  // namespace

std::vector<KernelCase> kernel_cases() {
  std::vector<KernelCase> cases;
  cases.push_back({"empty", "harness", "double", "element", prepare_empty});
  for (const Sweep sweep : {Sweep::extruded, Sweep::revolved})
    for (const bool perturbed : {false, true})
      for (const bool finite_rotation : {false, true})
        for (const bool damped : {false, true}) {
          if (perturbed && damped) continue;
          add_elements(cases, {sweep, damped, finite_rotation, perturbed});
        }
  for (const bool damped : {false, true}) add_elements(cases, {.damped = damped, .vertical_only = true});
  add_hexahedra(cases);
  add_updates<double, double>(cases);
  add_updates<float, double>(cases);
  add_updates<float, float>(cases);
  add_ties<double, double>(cases);
  add_ties<float, double>(cases);
  add_ties<float, float>(cases);
  add_contact_cases(cases);
  return cases;
}

}  // namespace tread
