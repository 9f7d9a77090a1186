#include "drivers/engine/simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "core/parallel/chunks.hpp"
#include "drivers/engine/energy_stop.hpp"
#include "drivers/engine/energy_sums.hpp"
#include "drivers/engine/start.hpp"
#include "drivers/engine/static_system.hpp"

namespace tread {

namespace {

constexpr std::int64_t kAnchorInterval = 256;  ///< steps between looks at the wheel's mean motion
/// Longest stretch of steps without a look at the energies: a motion whose step is 2 % too long grows by
/// e^0.4 in each.
constexpr std::int64_t kWatchInterval = 64;

/// Steps between looks at the energies: samples look at them anyway, and share the stretch between two of
/// them evenly.
std::int64_t watch_interval(std::int64_t sampling) {
  const std::int64_t looks = (sampling + kWatchInterval - 1) / kWatchInterval;
  return (sampling + looks - 1) / looks;
}
constexpr int kCreepageNodes = 28;  ///< [paper, section 4.2]

/// Of a rim at the speed `rim` against an axle at `speed`, over their mean. Without a rolling speed there is
/// none: at rest, or when the rim runs backwards as fast as the axle forwards. [paper, eq. (3)]
double creepage_of(double rim, double speed) {
  constexpr double kLeastSpeed = 1e-3;  // [m/s]
  const double rolling = 0.5 * (rim + speed);
  return std::abs(rolling) > kLeastSpeed ? (rim - speed) / rolling : 0.0;
}

/// Restrained unknowns less those that the update leaves alone.
std::vector<std::int64_t> held_unknowns(const Model& model) {
  std::vector<std::int64_t> held = model.restrained;
  for (const SweptBlock& block : model.mesh.blocks) {
    if (!block.vertical_only) continue;
    std::erase_if(held, [&](std::int64_t unknown) {
      return unknown >= 3 * block.base && unknown < 3 * (block.base + block.slots()) &&
             unknown / kLanes % 3 != 2;
    });
  }
  return held;
}

}  // namespace

Simulation::Simulation(Model& model, double patch_y, double dt)
    : model_(&model),
      held_(held_unknowns(model)),
      dt_(dt),
      fields_(make_node_fields(model)),
      u_(fields_->displacement()),
      v_(fields_->velocity()),
      force_(fields_->force()) {
  const Scene& scene = model.scene;
  if (model.wheelset) {
    if (model.contact) {
      surface_.emplace(model.contact->nodes().grid());
      rail_line_.emplace(model.mesh.blocks[static_cast<std::size_t>(model.contact->options().rail_block)],
                         patch_y);
    }
    if (scene.motion && scene.motion->traction_torque) max_torque_ = *scene.motion->traction_torque;
    if (scene.motion && scene.motion->traction_mu) {
      const double mass = model.wheelset->mass() + (scene.vehicle ? scene.vehicle->unsprung_mass : 0.0);
      const double radius = model.wheel_radius();
      max_torque_ = *scene.motion->traction_mu * model.wheel_load() * radius;
      if (!model.guide) max_torque_ *= 1 + model.wheelset->inertia() / (mass * radius * radius);
    }
    choose_creepage_nodes(patch_y);
  }
  if (scene.vehicle) {
    const VehicleSpec& vehicle = *scene.vehicle;
    sprung_.mass = vehicle.sprung_mass;
    sprung_.stiffness = vehicle.suspension_stiffness;
    sprung_.damping = vehicle.suspension_damping;
    sprung_.free_length_height = sprung_.mass * scene.gravity / sprung_.stiffness;
  }
}

Simulation::Simulation(Model& model, const Preload& preload, double dt)
    : Simulation(model, preload.contact.centre.y, dt) {
  start(preload);
}

/// Nodes of the tread's section nearest to the patch, spread evenly around; the first starts in the patch.
void Simulation::choose_creepage_nodes(double patch_y) {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(model_->index.tread)];
  int nearest = block.section.surface.front().node[0];
  for (const SurfaceEdge& edge : block.section.surface)
    for (const int node : edge.node)
      if (std::abs(block.section.p[static_cast<std::size_t>(node)] - patch_y) <
          std::abs(block.section.p[static_cast<std::size_t>(nearest)] - patch_y))
        nearest = node;
  const StationFinder finder(block);
  for (int k = 0; k < (model_->guide ? 1 : kCreepageNodes); ++k) {
    const int station = finder.find(2 * M_PI * k / kCreepageNodes).station;
    creepage_nodes_.push_back({block.base + block.slot(nearest, station),
                               block.stations[static_cast<std::size_t>(station)],
                               block.section.q[static_cast<std::size_t>(nearest)]});
  }
}

void Simulation::start(const Preload& preload) {
  Model& model = *model_;
  const Scene& scene = model.scene;
  AlignedVector<double> u = preload.displacement;
  AlignedVector<double> v(u.size(), 0.0);
  frame_ = preload.wheel;
  if (rail_line_) rail_line_->note_static(u.data());
  if (model.guide) model.guide->settle(u.data());
  const std::optional<RunIn>& run_in = preload.run_in;
  const StartFields fields{u, v, frame_};
  if (run_in) place_run_in(model, *run_in, fields);
  if (model.wheelset) {
    anchor(u.data(), v.data());  // at rest: the wheel then spins about its own displaced axis
    if (model.contact) {
      model.contact->find_static({u.data(), nullptr, &frame_});
      model.contact->begin();
    }
    start_velocities(model, run_in, fields);
  }
  if (scene.pulse) {
    for (const SweptBlock& block : model.mesh.blocks)
      for (int station = 0; station < block.station_count(); ++station)
        if (block.stations[static_cast<std::size_t>(station)] < block.stations.front() + scene.pulse->length)
          for (int node = 0; node < block.section.nodes(); ++node)
            v[static_cast<std::size_t>(dof(block.base + block.slot(node, station), 0))] =
                scene.pulse->velocity;
  }
  fields_->set(u, v);
  if (scene.vehicle) {
    sprung_.height = (frame_.origin + model.journal.displacement(u_, frame_)).z;
    if (run_in) {
      sprung_.height -= run_in->stretch;
      sprung_.speed = -run_in->sprung_speed;
    }
  }
  if (model.hammer) struck_at_ = -model.hammer->value(u_, 2);
  start_momentum_ = vehicle_momentum();
}

StateList Simulation::state() {
  StateList list;
  list.add("time", time_);
  list.add("steps", steps_);
  fields_->list_state(list);
  list.add("wheel_frame", frame_);
  list.add_part("sprung_mass", sprung_);
  list.add("torque", torque_);
  list.add("torque_before", torque_before_);
  list.add("torque_work", torque_work_);
  list.add("guide_work", guide_work_);
  list.add("guide_before", guide_before_);
  list.add("impulse", impulse_);
  list.add("contact_impulse", contact_impulse_);
  list.add("start_momentum", start_momentum_);
  list.add("hammer/struck_at", struck_at_);
  list.add("hammer/force", hammer_force_);
  list.add("hammer/displacement", hammer_displacement_);
  list.add("hammer/work", hammer_work_);
  list.add_part("energy_watch", energy_watch_);
  list.add_records("sample", std::span(&sample_, 1));
  if (surface_) list.add_part("surface", *surface_);
  if (rail_line_) list.add_part("rail_line", *rail_line_);
  if (model_->has_branches()) list.add_part("branch_loss", branch_loss_);
  if (model_->contact) list.add_part("contact", *model_->contact);
  if (model_->guide) list.add_part("guided_bore", *model_->guide);
  if (model_->fastenings) list.add_part("fastenings", *model_->fastenings);
  return list;
}

double Simulation::torque_at(double time) const {
  if (!model_->scene.motion || max_torque_ == 0) return 0;
  return max_torque_ * model_->scene.motion->torque_share(time);
}

void Simulation::step() {
  sampled_ = steps_ % sampling_ == 0;
  measured_ = steps_ % sampling_ % watch_interval(sampling_) == 0;
  // 1  contact: search and gap
  enter(StepPhase::contact_search);
  search();
  // 2  internal force K (u + beta v) or K (u + g q) of every block, with which nodes move that nothing else
  // acts on; secondary nodes hand theirs to the primaries
  enter(StepPhase::deform);
  deform();
  enter(StepPhase::measured);
  if (measured_) begin_sample();
  enter(StepPhase::tied_forces);
  if (model_->ties) model_->ties->hand_over(force_);
  // 3  fastenings, primary suspension
  enter(StepPhase::connectors);
  connect();
  // 4  torque, hammer; the unsprung mass shares the journal's acceleration (gravity and spin terms: with the
  // update)
  enter(StepPhase::loads);
  drive();
  strike();
  carry();
  // 5  velocities, displacements of the rest, restraints; pressure and friction of the middle of the step;
  // ties, lag q of Maxwell branches, frames
  enter(StepPhase::update);
  move();
  enter(StepPhase::contact);
  roll();
  enter(StepPhase::tied_motion);
  finish();
  // 6  fields of the rail's surface, samples
  enter(StepPhase::surface_fields);
  record();
  enter(StepPhase::measured);
  if (measured_) end_sample();
  enter(StepPhase::anchor);
  if (steps_ % kAnchorInterval == 0) anchor(u_, v_);
}

/// Energies want the forces of all nodes.
void Simulation::deform() {
  if (measured_)
    fields_->deform();
  else
    fields_->deform_and_move(loads());
}

void Simulation::connect() {
  if (model_->fastenings) model_->fastenings->apply(u_, v_, dt_, force_);
  if (sprung_.mass > 0) {
    const double height = frame_.origin.z + model_->journal.displacement(u_, frame_).z;
    const double speed = model_->journal.velocity(u_, v_, frame_).z;
    const double up = sprung_.force(height, speed);
    model_->journal.add(force_, frame_, {0, 0, up});
    const double rate = sprung_.speed - speed;
    sprung_.dissipated += sprung_.damping * rate * rate * dt_;
    sprung_.advance(up, model_->scene.gravity, dt_);
  } else if (model_->scene.load && !model_->journal.empty()) {
    model_->journal.add(force_, frame_, {0, 0, model_->scene.load->wheel_load});
  }
}

void Simulation::search() {
  if (!model_->contact) return;
  if (!std::isfinite(frame_.origin.x)) stop();
  model_->contact->search({u_, v_, &frame_}, time_, dt_);
}

void Simulation::roll() {
  if (!model_->contact) return;
  model_->contact->resolve({u_, v_, model_->inverse_mass.data()}, frame_, dt_);
  if (model_->contact->point_at_the_end(frame_)) {
    if (dt_ > stable_step_of(*model_)) stop();
    model_->contact->require_room(frame_);
  }
  if (measured_) model_->contact->add_forces(force_);
  const Vec3 on_wheel = -model_->contact->totals().force_on_rail;
  impulse_ += dt_ * on_wheel;
  contact_impulse_ += dt_ * Vec3{std::abs(on_wheel.x), std::abs(on_wheel.y), std::abs(on_wheel.z)};
}

void Simulation::record() {
  if (!surface_) return;
  const PatchNodes& patch = model_->contact->nodes();
  surface_->add_step(patch);
  if (!sampled_) return;
  surface_->add_sample(patch, static_cast<double>(sampling_) * dt_);
  surface_->add_stress(patch, *model_->internal, model_->contact->options().rail_block, u_, fields_->lag());
  const Scene& scene = model_->scene;
  if (frame_.origin.x <= scene.zone_start + 0.5 * scene.zone_length)
    rail_line_->note_rolling(u_, frame_.origin.x);
}

void Simulation::drive() {
  if (max_torque_ == 0) return;
  torque_ = torque_at(time_);
  const double spin = model_->guide ? frame_.spin + model_->guide->motion().spin
                                    : model_->torque.apply(torque_, u_, v_, frame_, force_);
  torque_work_ += 0.5 * (torque_before_ + torque_) * spin * dt_;
  torque_before_ = torque_;
}

void Simulation::strike() {
  if (!model_->hammer) return;
  const double force = model_->scene.hammer->force_at(time_);
  const double displacement = -model_->hammer->value(u_, 2) - struck_at_;
  hammer_work_ += 0.5 * (hammer_force_ + force) * (displacement - hammer_displacement_);
  hammer_force_ = force;
  hammer_displacement_ = displacement;
  model_->hammer->add(force_, 2, force);
}

void Simulation::carry() {
  if (!model_->scene.vehicle) return;
  const double added = model_->scene.vehicle->unsprung_mass;
  const Vec3 total = model_->journal.total(force_, frame_);
  model_->journal.add(force_, frame_, (-added / (model_->journal.mass() + added)) * total);
}

void Simulation::move() {
  if (measured_)
    fields_->move_all(loads());
  else
    fields_->move_rest(loads());
  if (model_->guide) guide();
  // Contact must not see restrained nodes move.
  for (const std::int64_t unknown : held_) u_[unknown] = v_[unknown] = 0;
}

void Simulation::guide() {
  GuidedBore& carrier = *model_->guide;
  const MeanMotion before = carrier.motion();
  const double balance = carrier.counterweight(frame_.spin + before.spin, frame_.angle + before.rotation);
  carrier.move({u_, v_}, frame_, dt_, {balance - model_->journal_load(), torque_});
  const double impulse = carrier.guide_impulse();
  guide_work_ += 0.5 * (guide_before_ + impulse) * frame_.velocity.x;
  guide_work_ += dt_ * balance * (frame_.velocity.z + carrier.motion().velocity.z);
  guide_before_ = impulse;
  impulse_ += Vec3{impulse, 0, dt_ * balance};
}

void Simulation::finish() {
  follow_ties(u_, v_);
  fields_->follow(dt_);
  frame_.advance(dt_);
  time_ += dt_;
  ++steps_;
}

void Simulation::anchor(NodeField u, NodeField v) {
  if (!model_->wheelset) return;
  model_->wheelset->anchor(wheel_motion(u, v), u, v, frame_, dt_);
  if (model_->guide) model_->guide->anchored();
  follow_ties(u, v);
}

MeanMotion Simulation::wheel_motion(ConstNodeField u, ConstNodeField v) const {
  return model_->guide ? model_->guide->motion() : model_->wheelset->mean_motion(u, v, frame_);
}

double Simulation::axle_height() const {
  return frame_.origin.z + (model_->guide ? model_->guide->motion().displacement.z
                                          : model_->journal.displacement(u_, frame_).z);
}

void Simulation::follow_ties(NodeField u, NodeField v) const {
  if (model_->ties) model_->ties->follow({u, v});
}

/// Where the wheel's frame was at the time of the velocities.
BodyFrame Simulation::half_step_frame() const {
  BodyFrame frame = frame_;
  frame.advance(-0.5 * dt_);
  return frame;
}

double Simulation::kinetic_energy() const {
  double sum = fixed_kinetic_energy(*model_, v_);
  if (model_->wheelset) sum += model_->wheelset->kinetic_energy(u_, v_, half_step_frame());
  if (model_->scene.vehicle) {
    const Vec3 v = model_->journal.velocity(u_, v_, frame_);
    sum += 0.5 * model_->scene.vehicle->unsprung_mass * dot(v, v) +
           0.5 * sprung_.mass * sprung_.speed * sprung_.speed;
  }
  return sum;
}

double Simulation::gravity_potential() const {
  const double g = model_->scene.gravity;
  double sum = fixed_gravity_potential(*model_, u_);
  if (model_->wheelset) {
    const double height = frame_.origin.z + model_->wheelset->mean_motion(u_, v_, frame_).displacement.z;
    sum += g * model_->wheelset->mass() * height;
  }
  if (!model_->journal.empty() || model_->guide) {
    const double height = axle_height();
    if (model_->scene.vehicle)
      sum += g * model_->scene.vehicle->unsprung_mass * height + g * sprung_.mass * sprung_.height;
    if (model_->scene.load) sum += model_->scene.load->wheel_load * height;
  }
  return sum;
}

Vec3 Simulation::vehicle_momentum() const {
  Vec3 sum;
  if (model_->wheelset) sum += model_->wheelset->momentum(u_, v_, half_step_frame());
  if (model_->scene.vehicle) {
    sum += model_->scene.vehicle->unsprung_mass * model_->journal.velocity(u_, v_, frame_);
    sum.z += sprung_.mass * sprung_.speed;
  }
  return sum;
}

void Simulation::watch(double excess) {
  if (!energy_watch_.started())
    energy_watch_.start(sample_.energy, excess, fixed_kinetic_energy(*model_, v_));
  if (!energy_watch_.sound(sample_.energy, excess)) stop();
}

void Simulation::stop() const {
  throw NumericalError(
      energy_stop_text(*model_, {time_, steps_, dt_, energy_watch_.missed(), energy_watch_.supplied(), v_}));
}

bool Simulation::finite() const {
  return fields_->finite();
}

MomentumCheck Simulation::momentum_check() const {
  const Vec3 weight = {0, 0, -model_->wheel_load()};
  return {impulse_ + time_ * weight, vehicle_momentum() - start_momentum_, contact_impulse_};
}

/// `mean`: the wheel's motion relative to its frame.
double Simulation::creepage(std::size_t index, const MeanMotion& mean) const {
  const CreepageNode& node = creepage_nodes_[index];
  const double carried = cartesian_to_cylindrical(node.angle + frame_.angle, mean.velocity).x;
  const double speed = v_[dof(node.slot, 0)] - carried + frame_.spin * (node.radius + u_[dof(node.slot, 2)]);
  return creepage_of(speed, frame_.velocity.x + mean.velocity.x);
}

void Simulation::begin_sample() {
  EnergyLedger& energy = sample_.energy;
  energy.strain = fields_->strain_energy();
  if (fields_->lag()) {
    const BranchEnergy branches = fields_->branch_energy();
    energy.strain += branches.stored;
    branch_loss_.look(time_, branches.power);
    energy.material_loss = branch_loss_.work;
  }
  kinetic_before_ = kinetic_energy();
  energy.gravity = gravity_potential();
  energy.connectors = model_->fastenings ? model_->fastenings->energy(u_) : 0.0;
  if (sprung_.mass > 0) {
    const double stretch = sprung_.height - frame_.origin.z - model_->journal.displacement(u_, frame_).z -
                           sprung_.free_length_height;
    energy.connectors += 0.5 * sprung_.stiffness * stretch * stretch;
  }
  sample_.time = time_;
  sample_.wheel_x = frame_.origin.x;
  sample_.wheel_z = frame_.origin.z;
}

void Simulation::end_sample() {
  EnergyLedger& energy = sample_.energy;
  const double excess = half_step_excess(*model_, held_, force_, dt_);
  energy.kinetic = 0.5 * (kinetic_before_ + kinetic_energy()) - excess;
  energy.torque_work = torque_work_;
  energy.guide_work = guide_work_;
  energy.hammer_work = hammer_work_;
  sample_.hammer_force = hammer_force_;
  sample_.hammer_displacement = hammer_displacement_;
  energy.connector_loss = (model_->fastenings ? model_->fastenings->dissipated() : 0.0) + sprung_.dissipated;
  if (model_->contact) {
    const ContactTotals& totals = model_->contact->totals();
    energy.penalty = totals.penalty_energy;
    energy.frictional_work = model_->contact->frictional_work();
    energy.damping_loss = model_->contact->damping_work();
    sample_.vertical_force = -totals.force_on_rail.z;
    sample_.longitudinal_force = -totals.force_on_rail.x;
    sample_.lateral_force = -totals.force_on_rail.y;
    sample_.patch_area = totals.area;
    sample_.slip_area = totals.slip_area;
    sample_.max_pressure = model_->contact->nodes().max_pressure();
    sample_.max_shear = model_->contact->nodes().max_shear();
    sample_.max_penetration = totals.max_penetration;
    const Corrugation& corrugation = model_->contact->corrugation();
    sample_.corrugation_depth = corrugation.depth(sample_.wheel_x, corrugation.centre());
  }
  if (model_->wheelset) {
    const MeanMotion mean = wheel_motion(u_, v_);
    sample_.wheel_speed = frame_.velocity.x + mean.velocity.x;
    sample_.wheel_spin = frame_.spin + mean.spin;
    double sum = 0;
    for (std::size_t k = 0; k < creepage_nodes_.size(); ++k) sum += creepage(k, mean);
    sample_.creepage_node = creepage(0, mean);
    sample_.creepage_mean = sum / static_cast<double>(creepage_nodes_.size());
    if (model_->guide)
      sample_.creepage_mean =
          creepage_of(sample_.wheel_spin * creepage_nodes_.front().radius, sample_.wheel_speed);
    sample_.torque = torque_;
  }
  watch(excess);
  energy.residual = energy.total() - energy_watch_.start_energy();
}

std::uint64_t Simulation::state_hash() const {
  Hash hash;
  for (const ConstNodeField field : {ConstNodeField(u_), ConstNodeField(v_), fields_->lag()})
    for (std::int64_t i = 0; field && i < 3 * model_->mesh.slots; ++i) hash.add(field[i]);
  for (const double value : {frame_.origin.x, frame_.origin.y, frame_.origin.z, frame_.angle, frame_.spin,
                             frame_.velocity.x, sprung_.height, sprung_.speed})
    hash.add(value);
  return hash.value();
}

}  // namespace tread
