#pragma once
// Size and cost of a scene, before anything runs.

#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/estimate.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json.hpp"

namespace tread {

/// resolution_warnings(), and a sentence each where the machine has less memory, or the working directory's
/// disk less space, than the estimate.
std::vector<std::string> check_warnings(const Model& model, const Estimate& estimate);

/// Counts, wheel load, stable step with its reason, steps, memory, disk, time and check_warnings(); with
/// `verbose` the phases and fields that the scene pays for, too.
std::string check_text(const Model& model, const ResolvedScene& resolved, const Estimate& estimate,
                       bool verbose);

/// The figures of check_text(), phases and fields included, as an object; `problems` is empty.
Json check_json(const Model& model, const Estimate& estimate);

}  // namespace tread
