#include "drivers/beam/run_in.hpp"

#include <algorithm>
#include <cmath>

namespace tread {

BeamVehicle beam_vehicle(const Model& model) {
  BeamVehicle vehicle;
  vehicle.gravity = model.scene.gravity;
  vehicle.unsprung_mass = model.wheelset->mass();
  if (model.scene.vehicle) {
    const VehicleSpec& spec = *model.scene.vehicle;
    vehicle.unsprung_mass += spec.unsprung_mass;
    vehicle.sprung_mass = spec.sprung_mass;
    vehicle.stiffness = spec.suspension_stiffness;
    vehicle.damping = spec.suspension_damping;
  }
  if (model.scene.load) vehicle.pressed = model.scene.load->wheel_load;
  vehicle.contact = model.wheel_load() / std::pow(model.hertz_patch.approach, 1.5);
  return vehicle;
}

RunIn::Section RunIn::at(double x) const {
  const double along = std::clamp((x - left) / pitch, 0.0, static_cast<double>(sections.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(along), sections.size() - 2);
  const double share = along - static_cast<double>(i);
  const Section& a = sections[i];
  const Section& b = sections[i + 1];
  const auto between = [&](double Section::*value) { return (1 - share) * a.*value + share * b.*value; };
  return {between(&Section::deflection), between(&Section::rotation), between(&Section::deflection_rate),
          between(&Section::rotation_rate)};
}

RunIn run_in(const Model& model) {
  constexpr double kTime = 0.08;  // ten times what the overdamped wheel on the paper's track takes [s]
  constexpr int kLeastSpans = 4;
  constexpr int kStepsOfSpan = 400;
  const Scene& scene = model.scene;
  const double speed = scene.motion->speed;
  const double spacing = scene.fastenings->spacing;
  const int spans = std::max(kLeastSpans, static_cast<int>(std::ceil(speed * kTime / spacing)));
  const TrackBeam beam = rail_beam(scene, timoshenko(rail_beam_section(scene), scene.steel), spans);
  const BeamVehicle vehicle = beam_vehicle(model);
  const double step = spacing / kStepsOfSpan;
  BeamPassage passage(beam, vehicle, -spans * spacing, step / speed);
  for (int i = spans * kStepsOfSpan - 1; i >= 0; --i) passage.step(-i * step);

  RunIn out;
  out.force = passage.force();
  out.wheel_speed = passage.wheel_speed();
  out.stretch = passage.sprung() - passage.wheel() - vehicle.static_stretch();
  out.sprung_speed = passage.sprung_speed();
  out.left = beam.left();
  out.pitch = beam.pitch();
  const std::vector<double> rest = beam.static_state(0, out.force);
  const std::vector<double>& state = passage.beam_state();
  const std::vector<double>& rate = passage.beam_rate();
  const auto last = static_cast<std::size_t>(beam.nodes()) - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    // What stays under the wheel has the rate -v d/dx.
    const auto seen = [&](std::size_t component) {
      const std::size_t after = std::min(i + 1, last);
      const std::size_t before = i == 0 ? 0 : i - 1;
      const double slope = (state[2 * after + component] - state[2 * before + component]) /
                           (static_cast<double>(after - before) * out.pitch);
      return rate[2 * i + component] + speed * slope;
    };
    out.sections.push_back(
        {state[2 * i] - rest[2 * i], state[2 * i + 1] - rest[2 * i + 1], seen(0), seen(1)});
  }
  return out;
}

}  // namespace tread
