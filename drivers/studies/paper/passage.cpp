#include "drivers/studies/paper/passage.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace tread {

namespace {

constexpr double kWay = 3.02;     ///< end past the corrugation's at 2.96 m and the solution zone's at 3 m [m]
constexpr double kUsualRamp = 5;  ///< [ms]

std::string title_of(const Passage& p) {
  const std::string rail = p.wavelength > 0
                               ? fmt::format("Corrugation {:g} mm, {:g} mm deep", p.wavelength, p.depth)
                               : "Smooth rail";
  return fmt::format("{}, {:g} km/h, mu {:g}", rail, p.speed, p.mu);
}

}  // namespace

Passage smooth_rail(double speed, double mu) {
  return {.speed = speed, .mu = mu};
}

Passage corrugated(double wavelength, double depth) {
  return {.wavelength = wavelength, .depth = depth};
}

std::string name_of(const Passage& p) {
  const std::string rail = p.wavelength > 0 ? fmt::format("{:g}mm,{:g}mm", p.wavelength, p.depth) : "smooth";
  const std::string ramp = p.ramp == kUsualRamp ? "" : fmt::format(",T1={:g}ms", p.ramp);
  return fmt::format("{},{:g}km_h,mu={:g}{}", rail, p.speed, p.mu, ramp);
}

StudyPoint study_point(const Passage& p) {
  StudyPoint point{name_of(p), {}, {}};
  const auto vary = [&](const char* key, double value, const char* unit) {
    point.varied.push_back({key, fmt::format("{:g}{}", value, unit)});
  };
  vary("motion.speed", p.speed, " km/h");
  vary("motion.traction.mu", p.mu, "");
  vary("motion.traction.ramp", p.ramp, " ms");
  if (p.wavelength > 0) {
    vary("corrugation.wavelength", p.wavelength, " mm");
    vary("corrugation.depth", p.depth, " mm");
    point.own.push_back(
        {"corrugation.apply", "gap"});  // passages that differ in nothing else share their rolling
  }
  point.own.push_back({"motion.duration", fmt::format("{:.4g} ms", 1e3 * kWay / (p.speed / 3.6))});
  point.own.push_back({"scene.title", title_of(p)});
  return point;
}

std::string paper_scene() {
  return R"(# What all passages of the paper have in common; `tread paper` varies the rest.
[scene]
based_on = "highspeed-slab-2014"
quality = "draft"
precision = "mixed"

[output]
frames = 0
)";
}

const FinishedRun* PassageRuns::find(const Passage& passage) const {
  const auto found =
      std::find_if(runs_.begin(), runs_.end(), [&](const auto& known) { return known.first == passage; });
  return found == runs_.end() ? nullptr : &found->second;
}

}  // namespace tread
