#pragma once
// Size and cost of a scene, before anything runs.

#include <string>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/estimate.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json.hpp"

namespace tread {

/// Counts, stable step with its reason, steps, memory, disk, time and warnings; with `verbose` the phases and
/// fields that the scene pays for, too.
std::string check_text(const Model& model, const ResolvedScene& resolved, const Estimate& estimate,
                       bool verbose);

/// The figures of check_text(), phases and fields included, as an object; `problems` is empty.
Json check_json(const Model& model, const Estimate& estimate);

}  // namespace tread
