#pragma once
// Refusals of a run before it begins or goes on, while an earlier run is still there.

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/engine/model.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/run/fork.hpp"
#include "drivers/run/run_session.hpp"

namespace tread {

/// InputError where the run's files need more than output.disk_limit. `results`: with the step. `files`:
/// file_bytes() of the scene.
void require_disk(const Model& model, const RunResults& results, std::int64_t files);

/// Throws InputError for what a run of the model refuses although its mesh can be built, as far as that shows
/// before the preload. `files`: file_bytes() of the scene.
void require_runnable(const Model& model, std::int64_t files = 0);

/// InputError where a run in the session's folder would be thrown away by mistake, or for one that cannot
/// run: the session's, or the `fork` that it is. [nullptr: no fork]
void refuse_to_overwrite(const RunSession& session, const Fork* fork);

/// InputError for values of `tread resume` that would make another run.
void refuse_other_keys(const std::vector<std::string>& overrides);

}  // namespace tread
