#pragma once
// Refusals of a run before it begins or goes on, while an earlier run is still there.

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/run/fork.hpp"
#include "drivers/run/run_session.hpp"

namespace tread {

/// InputError where the run's files need more than output.disk_limit. `dt`: time step [s]. `files`:
/// file_bytes() of the scene.
void require_disk(const Model& model, double dt, std::int64_t files);

/// ResourceError where the run's files need more, beyond those in its folder, than the disk has left. Nothing
/// without motion. `dt`: time step; 0: not known yet, and found only where the disk may be too small [s].
void require_free_disk(const RunSession& session, const Model& model, double dt);

/// Throws InputError for what a run of the model refuses although its mesh can be built: a patch that would
/// slide, a way beyond the rail, elements that the corrugation turns inside out, probes outside of their
/// bodies, files beyond output.disk_limit, a start too near for [forks]. `dt`: time step; 0: not known,
/// and what depends on it is left out [s]. `files`: file_bytes() of the scene.
void require_runnable(const Model& model, double dt, std::int64_t files);

/// InputError where results or states in the session's folder would be thrown away by mistake, or for a run
/// that cannot run: the session's, or the `fork` that it is. [nullptr: no fork]
void refuse_to_overwrite(const RunSession& session, const Fork* fork);

/// InputError for values of `tread resume` that would make another run.
void refuse_other_keys(const std::vector<std::string>& overrides);

}  // namespace tread
