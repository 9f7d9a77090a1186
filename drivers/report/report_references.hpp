#pragma once
// A run's results beside theory and beside values from the literature.

#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/report.hpp"
#include "io/scene/references.hpp"
#include "io/text/json.hpp"

namespace tread {

/// References of the library's scenes that hold for this scene, those of one file together; files that are
/// missing are left out. Throws InputError where a file does not read.
std::vector<References> library_references(const Scene& scene);

/// The run beside the references, or with `theory` beside those that belong to theory. `summary`: record of
/// the run's summary.json.
std::vector<Comparison> comparisons(const References& references, bool theory, const Model& model,
                                    const RunResults& results, const JsonRecord& summary);

/// Hertz for the static patch; empty without contact.
std::vector<Comparison> hertz_comparisons(const Model& model, const RunResults& results);

/// Lines of the references in the figure of the creepage [%].
std::vector<Marker> creepage_levels(const std::vector<References>& references);

}  // namespace tread
