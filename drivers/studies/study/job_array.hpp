#pragma once
// The points of a study as a job array for Slurm.

#include <filesystem>
#include <string>

#include "drivers/studies/study/planned_point.hpp"

namespace tread {

/// Writes a shell script for sbatch: one element a point that is to run, at most plan.jobs at once. The
/// plan's launcher starts the run of an element, which goes on from its last checkpoint where it has one and
/// is queued again if it was stopped in time, but not by a request of a user's. A failure is noted in the
/// point's folder as note_end() does. The points must not share rolling. `command`: that has asked for the
/// script; without --slurm it collects the results afterwards. Throws InputError if no point is left,
/// ResourceError.
void write_job_array(const StudyPlan& plan, const std::filesystem::path& script, bool retry,
                     const std::string& command);

}  // namespace tread
