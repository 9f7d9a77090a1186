// A wheel that slides: the contact force is f F_N, and friction turns all lost mechanical energy into heat.

#include <fmt/core.h>

#include <cmath>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/roll_tyre.hpp"

namespace tread {

namespace {

CaseResult sliding(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  bodies.friction = inputs["friction"];
  if (inputs["creepage"] == 0) throw InputError("verify: creepage is zero: the wheel does not slide");
  const double speed = inputs["speed"];
  const double way = inputs["way"];
  bodies.roll_on(speed, way, way, fmt::format("creepage = {}", inputs["creepage"]));
  const double observed = 0.5 * way;
  const Rolled rolled = roll_tyre(bodies, observed, progress);
  const EnergyLedger& first = rolled.samples.front().energy;
  const EnergyLedger& last = rolled.samples.back().energy;
  const auto mechanical = [](const EnergyLedger& e) {
    return e.kinetic + e.strain + e.penalty + e.gravity + e.connectors;
  };
  const double rubbed = last.frictional_work - first.frictional_work;
  const double wanted = std::copysign(bodies.friction, inputs["creepage"]);
  CaseResult result;
  result.findings = {
      {"F_L / F_N", "-", rolled.force / rolled.normal_force, wanted, 1e-3},
      {"lost mechanical energy / frictional work", "-", (mechanical(first) - mechanical(last)) / rubbed, 1,
       1e-3},
      {"lost kinetic energy / frictional work", "-", (first.kinetic - last.kinetic) / rubbed, 1, {}},
      {"slip area / patch area", "-", rolled.slip_fraction, 1, 1e-3}};
  return result;
}

}  // namespace

VerifyCase sliding_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false, 2.2e-3);
  inputs.push_back({"friction", nullptr, "", 0.3, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"creepage", nullptr, "", -2, {-2, 1.9}, "the creepage at the start; -2: a locked wheel"});
  inputs.push_back({"speed", &kSpeed, "m/s", 10, {1, 150}, "the speed at the start"});
  inputs.push_back({"way", &kLength, "mm", 8e-3, {1e-3, 1}, "the way of the wheel"});
  return {"sliding", "a wheel slides on a block: force and energy", std::move(inputs), sliding};
}

}  // namespace tread
