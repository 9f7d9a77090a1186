#include "drivers/engine/energy_stop.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "drivers/engine/start/step_limit.hpp"

namespace tread {

namespace {

struct Place {
  std::string part;
  Vec3 at;            ///< of its undeformed shape [m]
  double speed = -1;  ///< against its body's frame [m/s]
};

/// Returns the fastest node. A speed that is not finite exceeds all others.
Place fastest_node(const Model& model, ConstNodeField velocity) {
  Place fastest;
  const auto look_at = [&](const std::string& part, std::int64_t slot, const auto& place) {
    const double speed = norm(velocity.at(slot));
    if (speed > fastest.speed || !std::isfinite(speed)) fastest = {part, place(), speed};
    return std::isfinite(speed);
  };
  for (const SweptBlock& block : model.mesh.blocks)
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        if (!look_at(block.name, block.base + block.slot(node, station),
                     [&] { return position(block, node, station); }))
          return fastest;
  for (const HexBody& body : model.mesh.bodies)
    for (std::int64_t node = 0; node < body.nodes(); ++node)
      if (!look_at(body.name, body.slot(node),
                   [&] { return body.mesh.nodes[static_cast<std::size_t>(node)]; }))
        return fastest;
  return fastest;
}

std::string instant(double time, std::int64_t steps) {
  return fmt::format("stopped at t = {:.6e} s (step {}): ", time, steps);
}

/// And the way out.
std::string cause(double dt, double stable) {
  constexpr double kMargin = 0.01;
  if (dt > stable)
    return fmt::format(
        "The time step of {:.4e} s exceeds the stable step of {:.4e} s by {:.2g} %; lower motion.step_safety",
        dt, stable, 100 * (dt / stable - 1));
  if (dt > (1 - kMargin) * stable)
    return fmt::format(
        "The time step of {:.4e} s lies within {:g} % of the stable step of {:.4e} s, where the highest "
        "frequencies "
        "grow large; lower motion.step_safety",
        dt, 100 * kMargin, stable);
  return fmt::format(
      "The time step of {:.4e} s is {:.3g} of the stable one of the undeformed bodies, so deformation or "
      "contact is "
      "the cause: look at the last samples before; check load, speed and the materials' units, and try "
      "motion.step_safety = {:.2g}",
      dt, dt / stable, 0.5 * dt / stable);
}

}  // namespace

std::string energy_stop_text(const Model& model, const EnergyStop& stop) {
  std::string text = instant(stop.time, stop.steps);
  if (std::isfinite(stop.missed))
    text += fmt::format("{:.3g} J have {}, but only {:.3g} J were supplied", std::abs(stop.missed),
                        stop.missed > 0 ? "appeared from nothing" : "vanished", stop.supplied);
  else
    text += "the motion is no longer finite";
  const Place place = fastest_node(model, stop.velocity);
  text +=
      fmt::format("; fastest: part '{}' at ({:.4f}, {:.4f}, {:.4f}) m of its undeformed shape, {:.3g} m/s. ",
                  place.part, place.at.x, place.at.y, place.at.z, place.speed);
  return text + cause(stop.dt, stable_step_of(model));
}

std::string unstable_patch_text(const Model& model, double wheel_x, double time, std::int64_t steps,
                                double dt) {
  const double stable = stable_step_of(model);
  if (dt <= stable) return "";
  return instant(time, steps) +
         fmt::format(
             "the patch reaches the end of the surface that is searched, with the wheel at x = {:.4f} m. ",
             wheel_x) +
         cause(dt, stable);
}

}  // namespace tread
