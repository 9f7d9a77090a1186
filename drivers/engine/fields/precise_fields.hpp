#pragma once
// The fields of a run in one precision, moved by the processor. [drivers/engine/fields/node_fields.hpp]

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/index.hpp"
#include "core/page_vector.hpp"
#include "core/parallel/chunks.hpp"
#include "core/parallel/few_values.hpp"
#include "drivers/engine/fields/energy_sums.hpp"
#include "drivers/engine/fields/node_fields.hpp"
#include "drivers/engine/model/restraints.hpp"
#include "kernels/material/branch_lag.hpp"
#include "kernels/material/laws.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

/// The model's operator, in double.
class SharedOperator {
 public:
  explicit SharedOperator(const Model& model) : model_(&model) {}
  const InternalForce& operator*() const { return *model_->internal; }

 private:
  const Model* model_;
};

/// A copy of it in single precision.
template <class U>
class RoundedOperator {
 public:
  explicit RoundedOperator(const Model& model) : internal_(model.mesh) {
    for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b) {
      internal_.set_beta(b, model.internal->beta(b));
      internal_.set_branch(b, model.internal->branch(b));
      internal_.set_finite_rotation(b, model.internal->finite_rotation(b));
    }
  }
  const BasicInternalForce<float, U>& operator*() const { return internal_; }

 private:
  BasicInternalForce<float, U> internal_;
};

/// Fields that the processor moves. Real: velocities and forces, U: displacements.
template <class Real, class U>
class PreciseFields : public NodeFields {
 public:
  /// The derived class calls take_masses() before steps.
  explicit PreciseFields(const Model& model)
      : model_(&model),
        sums_(model, unforced_unknowns(model)),
        operator_(model),
        inverse_mass_(model.mass.size()),
        update_(model.mesh, inverse_mass_.data()),
        u_(static_cast<std::size_t>(3 * model.mesh.slots)),
        v_(u_.size()),
        f_(u_.size()) {
    displacement_ = u_.data();
    velocity_ = v_.data();
    force_ = f_.data();
    if (model.has_branches()) {
      q_.emplace(model.mesh, model.branches, branches_of_bodies(model));
      lag_ = q_->data();
    }
    if (has_laws(model.mesh)) laws_ = state_.emplace(model.mesh);
    for (const auto& body : model.body_forces) bodies_.emplace_back(*body, inverse_mass_.data());
  }

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override {
    std::copy(displacement.begin(), displacement.end(), u_.begin());
    std::copy(velocity.begin(), velocity.end(), v_.begin());
  }

  void internal_force_and_move(const StepLoads& loads, bool measured) override {
    force_bodies();
    if (measured)
      internal().internal_force(force_fields());
    else
      internal().move(update_, loads, force_fields());
  }
  void move_rest(const StepLoads& loads, bool measured) override {
    const BasicUpdateFields<Real, U> fields = {u_.data(), v_.data(), f_.data()};
    for (const BodyMotion<Real, U>& body : bodies_) body.move(loads, fields);
    if (measured)
      update_.move_all(loads, fields);
    else
      update_.move_rest(loads, fields, internal().unmoved_tiles());
  }
  void hold(std::span<const std::int64_t> unknowns) override {
    const std::int64_t touched = 2 * kLanes * std::ssize(unknowns);  // hardly two share a line of the cache
    ranges_of_values(std::ssize(unknowns), touched, [&](std::int64_t first, std::int64_t last) {
      for (const std::int64_t unknown : unknowns.subspan(index(first), index(last - first)))
        u_[index(unknown)] = v_[index(unknown)] = 0;
    });
  }

  void advance_lag(double dt) override {
    if (q_) q_->advance(v_.data(), dt);
  }

  DeformationEnergy energy(int part) const override {
    if (const BodyForce* body = model_->body_force_of(part)) return body->energy(displacement_);
    return internal().energy(part, u_.data(), state());
  }

  ElementEnergy element_energy() override {
    auto sum = sum_tiles<ElementEnergy>(mesh(), sums_.all_blocks(), share(),
                                        [&](int block, int tile) { return element_energy(block, tile); });
    for (const auto& body : model_->body_forces) sum += ElementEnergy{whole(body->energy(displacement_)), 0};
    return sum;
  }

  BranchEnergy branch_energy() override {
    if (!q_) return {};
    const auto energy_of = [](const MaxwellBranch& branch, double linear_energy) {
      const double stored = branch.strength * linear_energy;
      return BranchEnergy{stored, 2 * stored / branch.time};
    };
    auto sum = sum_tiles<BranchEnergy>(mesh(), sums_.all_blocks(), share(), [&](int block, int tile) {
      const std::optional<MaxwellBranch>& branch = q_->branch(block);
      if (!branch) return BranchEnergy{};
      return energy_of(*branch, internal().linear_energy(block, tile, q_->data()));
    });
    for (const auto& body : model_->body_forces)
      if (body->branch()) sum += energy_of(*body->branch(), whole(body->linear_energy(q_->data())));
    return sum;
  }

  double fixed_kinetic_energy() override { return sums_.fixed_kinetic_energy(velocity_, share()); }
  double fixed_gravity_potential() override { return sums_.fixed_gravity_potential(displacement_, share()); }
  double half_step_excess(double dt) override { return sums_.half_step_excess(force_, dt, share()); }
  MeanMotion mean_motion(const SpinningBody& body, const BodyFrame& wheel) override {
    return body.mean_motion(displacement_, velocity_, wheel, share());
  }
  double kinetic_energy(const SpinningBody& body, const BodyFrame& wheel, double dt) override {
    return body.kinetic_energy(displacement_, velocity_, wheel.after(-0.5 * dt), share());
  }
  void anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel, double dt) override {
    body.anchor(mean, displacement_, velocity_, wheel, dt);
    this->changed();
  }

  bool finite() const override {
    std::atomic<bool> finite = true;
    const auto look_at = [&](const auto& field) {
      parallel_ranges(std::ssize(field), [&](std::int64_t first, std::int64_t last) {
        bool all = true;
        for (std::int64_t i = first; i < last; ++i) all &= std::isfinite(field[index(i)]);
        if (!all) finite = false;
      });
    };
    look_at(u_);
    look_at(v_);
    return finite;
  }

  void list_state(StateList& list) override {
    list.add("displacement", std::span(u_));
    list.add("velocity", std::span(v_));
    if (q_) list.add("lag", std::span(q_->values()));
    if (state_) list.add_part("law_state", *state_);
  }

 protected:
  const Model& model() const { return *model_; }
  const Mesh& mesh() const { return model_->mesh; }
  /// The tiles whose values the views hold; null: all.
  virtual const TileShare* share() const { return nullptr; }
  /// Unknowns that forces do not move.
  const std::vector<std::int64_t>& unforced() const { return sums_.unforced(); }
  const BasicInternalForce<Real, U>& internal() const { return *operator_; }
  const Real* inverse_masses() const { return inverse_mass_.data(); }
  /// For fields that nothing has touched and that steps use as a whole.
  void use_large_pages() {
    tread::use_large_pages(inverse_mass_);
    tread::use_large_pages(u_);
    tread::use_large_pages(v_);
    tread::use_large_pages(f_);
    if (q_) tread::use_large_pages(q_->values());
  }
  /// Gets the masses of nodes that steps move (groups_with_mass()); the memory of others stays untouched.
  /// Nodes on which more than elements acts then move after the elements. Returns inverse_masses().
  const Real* take_masses() {
    const std::span<const unsigned char> groups = groups_with_mass();
    const double* const mass = model_->mass.data();
    for_chunks(mesh().slots / kLanes, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t group = first; group < last; ++group) {
        if (!groups.empty() && groups[index(group)] == 0) continue;
        for (std::int64_t slot = group * kLanes; slot < (group + 1) * kLanes; ++slot)
          inverse_mass_[index(slot)] = static_cast<Real>(inverse_mass(mass[slot]));
      }
    });
    update_.defer(model_->loaded_slots());
    return inverse_masses();
  }

  /// By tile: the loop takes the tile behind it along.
  std::vector<unsigned char> joined_tiles() const {
    std::vector<unsigned char> joined;
    for (const SweptBlock& block : mesh().blocks)
      for (std::size_t tile = 0; tile < block.tiles.size(); ++tile)
        joined.push_back(internal().joined(joined.size()));
    return joined;
  }
  /// Searches columns of the aimed contact; solves it once all are searched.
  void search_contact(const StepLoads& loads, double time, std::int64_t first, std::int64_t last) {
    model_->contact->search_columns({displacement_, velocity_, &loads.frame}, time, static_cast<int>(first),
                                    static_cast<int>(last));
  }
  void solve_contact(const StepLoads& loads) {
    model_->contact->gather_points();
    model_->contact->resolve({displacement_, velocity_, model_->mass.data()}, loads.frame, loads.dt);
  }
  /// Forces of bodies from files.
  void force_bodies() {
    for (const auto& body : model_->body_forces) body->internal_force(u_.data(), v_.data(), lag(), f_.data());
  }
  BasicTimeUpdate<Real, U>& update() { return update_; }
  PageVector<U>& u() { return u_; }
  PageVector<Real>& v() { return v_; }
  PageVector<Real>& f() { return f_; }
  std::optional<BranchLag<Real>>& q() { return q_; }
  std::optional<LawState<Real>>& law_state() { return state_; }
  ForceFields<Real, U> force_fields() {
    return {u_.data(), v_.data(), f_.data(), lag(), state_ ? &*state_ : nullptr};
  }

 private:
  const Real* lag() const { return q_ ? q_->data() : nullptr; }
  const LawState<Real>* state() const { return state_ ? &*state_ : nullptr; }
  static double whole(const DeformationEnergy& energy) { return energy.strain + energy.hourglass; }
  static std::vector<std::optional<MaxwellBranch>> branches_of_bodies(const Model& model) {
    std::vector<std::optional<MaxwellBranch>> branches;
    for (const auto& body : model.body_forces) branches.push_back(body->branch());
    return branches;
  }
  static std::vector<std::int64_t> unforced_unknowns(const Model& model) {
    std::vector<std::int64_t> unknowns = held_unknowns(model.mesh, model.restrained);
    if (model.guide)
      unknowns.insert(unknowns.end(), model.guide->unknowns().begin(), model.guide->unknowns().end());
    return unknowns;
  }
  /// True where element_energy() of a block is u . K u / 2 by the force, which holds K u alone.
  bool energy_by_forces(int b) const {
    return std::is_same_v<Real, double> &&
           mesh().blocks[static_cast<std::size_t>(b)].sweep == Sweep::extruded &&
           internal().damping(b) == 0 && is_linear(internal().law(b));
  }
  ElementEnergy element_energy(int number, int tile) const {
    if constexpr (std::is_same_v<Real, double>)
      if (energy_by_forces(number)) {
        const SweptBlock& block = mesh().blocks[static_cast<std::size_t>(number)];
        const std::int64_t values = 3 * kLanes * std::int64_t{block.section.nodes()};
        const std::int64_t first = 3 * block.base + tile * values;
        return {0.5 * dot_of_range(first, first + values, u_.data(), f_.data()), 0};
      }
    const DeformationEnergy energy = internal().tile_energy(number, tile, u_.data(), state());
    return {whole(energy), energy.dissipated};
  }

  const Model* model_;
  EnergySums sums_;
  std::conditional_t<std::is_same_v<Real, double>, SharedOperator, RoundedOperator<U>> operator_;
  PageVector<Real> inverse_mass_;  ///< by slot [1/kg]
  BasicTimeUpdate<Real, U> update_;
  std::vector<BodyMotion<Real, U>> bodies_;
  PageVector<U> u_;
  PageVector<Real> v_, f_;
  std::optional<BranchLag<Real>> q_;
  std::optional<LawState<Real>> state_;
};

}  // namespace tread
