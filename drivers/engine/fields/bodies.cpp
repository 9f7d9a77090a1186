#include "drivers/engine/fields/bodies.hpp"

#include <algorithm>

#include "drivers/engine/model/restraints.hpp"

namespace tread {

namespace {

// A node of std::map: key, value, colour and three links.
constexpr std::int64_t kMapNode = 64;

/// The run's fields are copies of the static state's, in another precision.
bool rounded(const Model& model) {
  return model.scene.precision != "double";
}

std::int64_t moved_nodes(const Model& model) {
  std::int64_t count = 0;
  for (const SweptBlock& block : model.mesh.blocks)
    count += static_cast<std::int64_t>(block.node_shift.size());
  return count;
}

std::int64_t bytes_of_bodies(const Model& model) {
  std::int64_t sum = 0;
  for (const auto& body : model.body_forces) sum += body->bytes();
  return sum;
}

template <class T>
std::int64_t bytes_of(const T& array) {
  return static_cast<std::int64_t>(array.size() * sizeof(array[0]));
}

const char* updated_blocks(const Model& model) {
  const bool wheel = model.wheelset.has_value();
  if (model.index.slab >= 0) return wheel ? "rail, slab (vertically), wheel" : "rail, slab (vertically)";
  if (!model.index.sleepers.empty()) return wheel ? "rail, sleepers, wheel" : "rail, sleepers";
  if (model.index.rail_cap < 0) return "wheel";
  return wheel ? "rail, wheel" : "rail";
}

}  // namespace

Bodies::Bodies(const Model& model) : model_(&model), held_(held_unknowns(model.mesh, model.restrained)) {}

std::vector<PhaseInfo> Bodies::phases() const {
  std::vector<RunField> reads = {RunField::coefficients, RunField::displacement, RunField::velocity};
  std::vector<RunField> moved = {RunField::velocity, RunField::displacement};
  if (model_->has_branches()) reads.push_back(RunField::branch_lag);
  if (rounded(*model_)) {
    reads.push_back(RunField::rounded_coefficients);
    moved.push_back(RunField::displacement_in_motion);
  }
  std::vector<RunField> forced = moved;
  forced.insert(forced.begin(), RunField::force);
  if (has_laws(model_->mesh)) {
    reads.push_back(RunField::law_state);
    forced.push_back(RunField::law_state);
  }
  std::vector<RunField> updates = {RunField::force, RunField::mass};
  if (!model_->restrained.empty()) updates.push_back(RunField::restrained);
  if (model_->wheelset) updates.push_back(RunField::wheel_frame);
  return {{StepPhase::internal_force, "all blocks; nodes on which nothing else acts move", reads, forced},
          {StepPhase::update, updated_blocks(*model_), updates, moved}};
}

std::vector<FieldBytes> Bodies::fields() const {
  const ValueBytes bytes = value_bytes(model_->scene);
  const std::int64_t components = 3 * model_->mesh.slots;
  const bool copied = rounded(*model_);
  std::vector<FieldBytes> list = {
      {RunField::coefficients, model_->internal->bytes() + bytes_of_bodies(*model_)},
      {RunField::mass, bytes_of(model_->mass) + model_->mesh.slots * bytes.other},
      {RunField::displacement, components * static_cast<std::int64_t>(sizeof(double)), !copied},
      {RunField::velocity, components * bytes.other, true},
      {RunField::force, components * bytes.other}};
  if (has_laws(model_->mesh))
    list.push_back({RunField::law_state, law_state_values(model_->mesh) * bytes.other, true});
  if (moved_nodes(*model_) > 0) list.push_back({RunField::moved_nodes, kMapNode * moved_nodes(*model_)});
  if (!model_->restrained.empty()) list.push_back({RunField::restrained, bytes_of(model_->restrained)});
  if (copied) {
    list.push_back({RunField::displacement_in_motion, components * bytes.displacement, true});
    list.push_back({RunField::rounded_coefficients, model_->internal->bytes() / 2});
  }
  return list;
}

void Bodies::apply(StepPhase phase, StepState& step) {
  if (phase == StepPhase::internal_force)
    internal_force(step);
  else
    update(step);
}

void Bodies::internal_force(StepState& step) const {
  if (step.contact_beside)
    step.fields.move_with_contact(loads(step), step.time);
  else
    step.fields.internal_force_and_move(loads(step), step.measured);
}

void Bodies::update(StepState& step) const {
  step.fields.move_rest(loads(step), step.measured);
  step.fields.hold(held_);  // contact must not see restrained nodes move
}

void Bodies::begin_sample(const StepState& step, Sample& sample) {
  const ElementEnergy elements = step.fields.element_energy();
  sample.energy.strain += elements.stored;
  sample.energy.plastic_work += elements.dissipated;
  sample.energy.gravity += step.whole.fixed_gravity_potential();
}

void Bodies::add_kinetic_energy(const Motion& motion, double& sum) const {
  sum += motion.whole.fixed_kinetic_energy();
}

}  // namespace tread
