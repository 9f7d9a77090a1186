#include "drivers/engine/measurements.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "drivers/engine/model/attachments.hpp"
#include "drivers/engine/model/rail_foot.hpp"
#include "drivers/engine/sampling.hpp"
#include "kernels/blocks/internal_force.hpp"

namespace tread {

namespace {

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr std::array<const char*, 6> kStresses = {"xx", "yy", "zz", "yz", "zx", "xy"};

/// Place of a probe in words.
std::string place_of(const ProbeSpec& probe) {
  if (probe.body == "axle_box") return "axle box";
  return fmt::format("{}, x = {:g} m, y = {:g} mm, {:g} mm deep", probe.body, probe.x, 1e3 * probe.y,
                     1e3 * probe.depth);
}

/// Angle on the wheel of the point that rolls over x [m] first.
double angle_on_wheel(const Model& model, double x) {
  return -(x - model.scene.start_x()) / model.wheel_radius();
}

/// Throws InputError, which begins with `what`, where a part of a ring does not come to x [m].
void require_on_wheel(const Model& model, double x, const std::string& what) {
  const SweptBlock& tread = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  if (StationFinder(tread).find(angle_on_wheel(model, x)).station >= 0) return;
  const double start = model.scene.start_x(), radius = model.wheel_radius();
  throw InputError(
      fmt::format("{}: x = {:.4g} m lies beyond the part of the wheel that is there, {:.4g} to {:.4g} m; "
                  "state an x within it, or a longer wheel.overhang",
                  what, x, start - radius * tread.stations.back(), start - radius * tread.stations.front()));
}

}  // namespace

bool is_column_of(const std::string& probe, const std::string& column) {
  const auto among = [&](const char* quantity, const auto& components) {
    return std::ranges::any_of(components, [&](const char* component) {
      return column == fmt::format("{}_{}_{}", probe, quantity, component);
    });
  };
  return among("displacement", kAxes) || among("velocity", kAxes) || among("acceleration", kAxes) ||
         among("stress", kStresses) || column == probe + "_von_mises";
}

Measurements::Measurements(const Model& model, double patch_y) : model_(&model) {
  const OutputSpec& output = model.scene.output;
  for (const auto& [name, spec] : model.scene.probes) add_probe(name, spec);
  if (output.fastening_forces && model.fastenings) add_fastenings();
  if (output.stress_depth && model.contact) add_depths(patch_y, *output.stress_depth);
  values_.reserve(channels_.size());
}

void Measurements::add_column(const std::string& name, const std::string& unit,
                              const std::string& description) {
  channels_.push_back({{name, unit, description}});
}

void Measurements::add_probe(const std::string& name, const ProbeSpec& spec) {
  Probe probe{spec, std::nullopt};
  const std::string what = "probe." + name;
  const SectionPlace place{spec.y, spec.depth};
  if (spec.body == "rail") probe.point = find_point(model_->mesh, model_->index.rail(), spec.x, place, what);
  if (spec.body == "wheel") {
    require_on_wheel(*model_, spec.x, what);
    probe.point =
        find_point(model_->mesh, model_->index.wheel(), angle_on_wheel(*model_, spec.x), place, what);
  }
  probes_.push_back(probe);
  const std::string place_text = place_of(spec);
  if (spec.has_motion()) {
    for (const char* axis : kAxes)
      add_column(fmt::format("{}_displacement_{}", name, axis), "m",
                 "from the place without load; " + place_text);
    const std::size_t velocities = channels_.size();
    for (const char* axis : kAxes) add_column(fmt::format("{}_velocity_{}", name, axis), "m/s", place_text);
    for (std::size_t c = 0; c < kAxes.size(); ++c) {
      add_column(fmt::format("{}_acceleration_{}", name, kAxes[c]), "m/s2",
                 "mean over the interval before; " + place_text);
      channels_.back().rate_of = velocities + c;
    }
  }
  if (spec.has_stress()) {
    const char* axes = spec.body == "wheel" ? "x along the tread, z outwards; " : "";
    for (const char* component : kStresses)
      add_column(fmt::format("{}_stress_{}", name, component), "Pa", axes + place_text);
    add_column(name + "_von_mises", "Pa", place_text);
  }
}

void Measurements::add_fastenings() {
  fastenings_ = true;
  for (int i = 0; i < model_->scene.fastenings->count; ++i) {
    const double x = model_->scene.fastening_x(i);
    add_column(fmt::format("fastening_{:02}_force", i + 1), "N",
               fmt::format("of the fastening at x = {:.4f} m on the rail, upwards", x));
    channels_.back().at = x;
  }
}

void Measurements::add_depths(double patch_y, double deepest) {
  for (const QuadBelow& below : quads_below(model_->mesh, model_->index.rail(), {patch_y, deepest})) {
    depths_.push_back({below, StationFinder(model_->mesh.blocks[static_cast<std::size_t>(below.block)])});
    add_column(fmt::format("von_mises_below_{:02}", depths_.size()), "Pa",
               fmt::format("largest along the patch, in the rail {:.3f} mm below the running surface",
                           1e3 * below.depth));
    channels_.back().at = below.depth;
  }
}

std::vector<PhaseInfo> Measurements::phases() const {
  if (channels_.empty()) return {};
  return {{StepPhase::samples,
           "probes, fastenings, elements under the patch",
           {RunField::displacement, RunField::velocity, RunField::wheel_frame},
           {RunField::samples}}};
}

std::vector<FieldBytes> Measurements::fields() const {
  if (channels_.empty()) return {};
  const auto values = static_cast<std::int64_t>(channels_.size() * sizeof(double));
  return {{RunField::samples, sample_count(*model_) * values}};
}

void Measurements::apply(StepPhase /*phase*/, StepState& step) {
  if (!step.sampled) return;
  values_.clear();
  for (const Probe& probe : probes_) measure_probe(probe, step);
  if (fastenings_) measure_fastenings(step);
  for (const Depth& depth : depths_) measure_depth(depth, step);
}

void Measurements::measure_probe(const Probe& probe, const StepState& step) {
  if (probe.spec.has_motion()) {
    const Vec3 u = probe.point ? probe.point->value(step.displacement) : axle_box(step);
    const Vec3 v = probe.point ? probe.point->value(step.velocity)
                               : model_->journal.velocity(step.displacement, step.velocity, step.wheel);
    values_.insert(values_.end(), {u.x, u.y, u.z, v.x, v.y, v.z, 0, 0, 0});
  }
  if (probe.spec.has_stress()) {
    const BodyPoint& at = *probe.point;
    const std::array<double, 6> stress = stress_of(at.block, at.quad, at.station, step);
    values_.insert(values_.end(), stress.begin(), stress.end());
    values_.push_back(von_mises(stress));
  }
}

/// Place of the axle box from that over x = 0 with the undeformed wheel on the undeformed rail [m].
Vec3 Measurements::axle_box(const StepState& step) const {
  const double height = model_->contact ? model_->contact->touching_height() : 0;
  return step.wheel.origin + model_->journal.displacement(step.displacement, step.wheel) - Vec3{0, 0, height};
}

std::array<double, 6> Measurements::stress_of(int block, int quad, int station, const StepState& step) const {
  return model_->internal->stress(block, quad, station, step.displacement, step.lag, step.laws);
}

void Measurements::measure_fastenings(const StepState& step) {
  const std::vector<SpringDampers::Element>& elements = model_->fastenings->elements();
  const auto count = static_cast<std::size_t>(model_->scene.fastenings->count);
  const std::size_t group = elements_of_fastening(*model_->scene.fastenings);
  for (std::size_t i = 0; i < count; ++i) {
    double up = 0;
    for (std::size_t k = i * group; k < (i + 1) * group; ++k) {
      const SpringDampers::Element& e = elements[k];
      if (e.component == 2) up -= e.load(e.stretch(step.displacement), e.stretch(step.velocity));
    }
    values_.push_back(up);
  }
}

template <class Visit>
void Measurements::for_each_station(const Depth& depth, double wheel_x, const Visit& visit) const {
  const SweptBlock& block = model_->mesh.blocks[static_cast<std::size_t>(depth.below.block)];
  const double reach = std::max(model_->contact->reach(), depth.below.depth);
  const double first = std::max(wheel_x - reach, block.stations.front());
  const double last = std::min(wheel_x + reach, block.stations.back());
  if (last <= first) return;
  const int end = std::min(depth.finder.find(last).station, block.station_count() - 2);
  for (int station = depth.finder.find(first).station; station <= end; ++station) visit(station);
}

void Measurements::measure_depth(const Depth& depth, const StepState& step) {
  const QuadBelow& below = depth.below;
  double largest = 0;
  for_each_station(depth, step.wheel.origin.x, [&](int station) {
    largest = std::max(largest, von_mises(stress_of(below.block, below.quad, station, step)));
  });
  values_.push_back(largest);
}

void Measurements::watch(const StepState& step, WatchedNodes& nodes) const {
  if (!step.sampled) return;
  for (const Probe& probe : probes_)
    if (probe.point) nodes.add_element(probe.point->block, probe.point->quad, probe.point->station);
  for (const Depth& depth : depths_)
    for_each_station(depth, step.wheel.origin.x,
                     [&](int station) { nodes.add_element(depth.below.block, depth.below.quad, station); });
}

}  // namespace tread
