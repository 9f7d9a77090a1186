// Mass, inertia and natural modes of the free half wheelset under refinement.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/natural_modes.hpp"
#include "io/scene_reader.hpp"

namespace tread {

namespace {

Scene free_wheelset(double element_size) {
  const std::string text = fmt::format(R"([scene]
based_on = "highspeed-slab-2014"
element_size = "{} m"
[solution_zone]
start = "0 m"
length = "0.01 m"
[rail]
present = false
[fastenings]
present = false
[slab]
present = false
[vehicle]
present = false
[contact]
present = false
[motion]
present = false
)",
                                       element_size);
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

CaseResult wheelset_modes(const VerifyInputs& inputs, const ProgressText& progress) {
  CaseResult result;
  const int count = static_cast<int>(std::lround(inputs["modes"]));
  for (const char* name : {"coarse_element_size", "element_size"}) {
    const Model model(free_wheelset(inputs[name]));
    natural_modes(model, count, progress);
  }
  return result;
}

}  // namespace

VerifyCase wheelset_modes_case() {
  return {"wheelset_modes",
          "mass, inertia and natural modes of the free half wheelset under refinement",
          {{"element_size", &kLength, "mm", 5e-3, {1e-3, 0.02}, "the elements' size of the fine mesh"},
           {"coarse_element_size", &kLength, "mm", 8e-3, {1e-3, 0.02}, "that of the coarse mesh"},
           {"modes", nullptr, "", 16, {4, 100}, "how many modes are computed"}},
          wheelset_modes};
}

}  // namespace tread
