#include "drivers/engine/simulation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/engine/chosen_fields.hpp"
#include "drivers/engine/energy_stop.hpp"
#include "drivers/engine/fields/featured_nodes.hpp"
#include "drivers/engine/start/start.hpp"

namespace tread {

namespace {

/// Longest stretch of steps without a look at the energies: a motion whose step is 2 % too long grows by
/// e^0.4 in each.
constexpr std::int64_t kWatchInterval = 64;

/// Steps between looks at the energies: samples look at them anyway, and share the stretch between two of
/// them evenly.
std::int64_t watch_interval(std::int64_t sampling) {
  const std::int64_t looks = (sampling + kWatchInterval - 1) / kWatchInterval;
  return (sampling + looks - 1) / looks;
}

/// The model, if it can be moved by such a step [s].
const Model& movable(const Model& model, double dt) {
  if (!(dt > 0 && std::isfinite(dt)))
    throw InputError(fmt::format(
        "the step is {:g} s: no time would pass; state a share of step_limit()'s stable step", dt));
  if (model.scene.corrugation && model.contact && model.contact->corrugation().smooth())
    throw InputError(
        fmt::format("corrugation.kind = \"{}\": the model's rail is smooth still; call "
                    "Model::apply_corrugation() with the "
                    "deepest line's y after the preload, or take the corrugation out of the scene",
                    model.scene.corrugation->kind));
  return model;
}

}  // namespace

Simulation::Simulation(const Model& model, double patch_y, double dt)
    : model_(&movable(model, dt)),
      dt_(dt),
      fields_(make_node_fields(model)),
      u_(fields_->displacement()),
      v_(fields_->velocity()),
      force_(fields_->force()),
      features_(model, patch_y),
      watched_(model.mesh) {}

Simulation::Simulation(const Model& model, const Preload& preload, double dt)
    : Simulation(model, preload.contact.centre.y, dt) {
  start(preload);
}

void Simulation::start(const Preload& preload) {
  AlignedVector<double> u = preload.displacement;
  AlignedVector<double> v(u.size(), 0.0);
  frame_ = preload.wheel;
  const StartFields fields{u, v, frame_};
  const StaticStart at{u.data(), v.data(), frame_, dt_, preload.traction, preload.rail_rise};
  for (const auto& feature : features_.all()) feature->settle(at);
  place_run_in(*model_, preload.run_in, fields);
  for (const auto& feature : features_.all()) feature->meet(at);
  start_velocities(*model_, preload, fields);
  fields_->set(u, v);
  for (const auto& feature : features_.all()) feature->begin(motion(), sprung_start(preload.run_in));
  start_momentum_ = features_.momentum(motion());
}

StateList Simulation::state() {
  StateList list;
  list.add("time", time_);
  list.add("steps", steps_);
  fields_->list_state(list);
  list.add("wheel_frame", frame_);
  list.add("impulse", impulse_.total);
  list.add("contact_impulse", impulse_.contact);
  list.add("start_momentum", start_momentum_);
  features_.list_state(list);
  return list;
}

StateList Simulation::unshared_state() {
  StateList list;
  fields_->list_state(list);
  features_.list_unshared_state(list);
  return list;
}

void Simulation::step() {
  using enum StepPhase;
  StepState s = begin_step();
  // 1  gap of the points that touch or may touch. Where nothing else acts on the patch, search and tractions
  // go on beside the elements away from it, in 2
  apply(contact_search, s);
  // 2  internal force K (u + beta v) or K (u + g q) of every block, and motion of nodes on which nothing else
  // acts; tied nodes hand their forces to the primary nodes
  apply(internal_force, s);
  apply(energies, s);
  apply(tied_forces, s);
  // 3  connectors
  apply(fastenings, s);
  apply(suspension, s);
  apply(wheel_load, s);
  // 4  loads; the unsprung mass shares the journal's acceleration
  apply(torque, s);
  apply(hammer, s);
  apply(unsprung_mass, s);
  // 5  velocities and displacements of the other nodes, restraints; pressure and friction of the middle of
  // the step; followers: tied nodes, lag q of Maxwell branches, frame
  apply(update, s);
  apply(guided_bore, s);
  apply(contact_tractions, s);
  fields_->spread_patch(s.measured);
  apply(tied_motion, s);
  apply(branch_lag, s);
  apply(frame, s);
  advance_time();
  // 6  records
  show_watched(s);
  apply(surface_fields, s);
  apply(samples, s);
  apply(anchor, s);
}

StepState Simulation::begin_step() {
  sampled_ = steps_ % sampling_interval_ == 0;
  const bool measured = steps_ % sampling_interval_ % watch_interval(sampling_interval_) == 0;
  return {.fields = *fields_,
          .whole = *fields_,
          .displacement = u_,
          .velocity = v_,
          .force = force_,
          .lag = fields_->lag(),
          .laws = fields_->laws(),
          .wheel = frame_,
          .impulse = impulse_,
          .end = *this,
          .time = time_,
          .dt = dt_,
          .steps = steps_,
          .sampling = sampling_interval_,
          .sampled = sampled_,
          .measured = measured,
          .contact_beside = contact_beside(measured)};
}

bool Simulation::contact_beside(bool measured) const {
  const bool apart = fields_->follow_patch(frame_, dt_);
  return apart && !measured;
}

/// One virtual call for each feature that the phase has.
void Simulation::apply(StepPhase phase, StepState& step) {
  const bool timed = clock_ != nullptr && !features_.in(phase).empty();
  if (timed) clock_->enter(phase);
  for (Feature* feature : features_.in(phase)) feature->apply(phase, step);
  if (!timed || phase != StepPhase::internal_force || !step.contact_beside) return;
  clock_->had_beside(StepPhase::contact_search, WorkBeside::kFirst);
  clock_->had_beside(StepPhase::contact_tractions, WorkBeside::kThen);
}

void Simulation::advance_time() {
  time_ += dt_;
  ++steps_;
}

void Simulation::show_watched(StepState& step) {
  if (!step.measured || !step.whole.elsewhere()) return;
  if (clock_) clock_->enter(StepPhase::samples);
  watched_.clear();
  for (const auto& feature : features_.all()) feature->watch(step, watched_);
  step.whole.show(watched_);
}

void Simulation::stop() const {
  const EnergyWatch& watch = energy_watch();
  throw NumericalError(
      energy_stop_text(*model_, {time_, steps_, dt_, watch.missed(), watch.supplied(), velocity()}));
}

void Simulation::stop_if_unstable() const {
  if (const std::string text = unstable_patch_text(*model_, wheel().origin.x, time_, steps_, dt_);
      !text.empty())
    throw NumericalError(text);
}

MomentumCheck Simulation::momentum_check() const {
  const Vec3 weight = {0, 0, -model_->wheel_load()};
  return {impulse_.total + time_ * weight, features_.momentum(motion()) - start_momentum_, impulse_.contact};
}

MeanMotion Simulation::wheel_motion() const {
  return features_.wheel() ? features_.wheel()->relative_to_frame(motion()) : MeanMotion{};
}

const SurfaceFields* Simulation::surface() const {
  fields_->fetch();
  return features_.record() ? &features_.record()->surface() : nullptr;
}

const RailLine* Simulation::rail_line() const {
  return features_.record() ? &features_.record()->line() : nullptr;
}

std::uint64_t Simulation::state_hash() const {
  Hash hash;
  for (const ConstNodeField field : {displacement(), velocity(), fields().lag()})
    for (std::int64_t i = 0; field && i < 3 * model_->mesh.slots; ++i) hash.add(field[i]);
  const SprungMass sprung = features_.vehicle() ? features_.vehicle()->sprung_mass() : SprungMass{};
  for (const double value : {frame_.origin.x, frame_.origin.y, frame_.origin.z, frame_.angle, frame_.spin,
                             frame_.velocity.x, sprung.height, sprung.speed, sprung.speed_along})
    hash.add(value);
  return hash.value();
}

}  // namespace tread
