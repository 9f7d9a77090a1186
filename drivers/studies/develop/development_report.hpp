#pragma once
// Tables, figures and report of a development.

#include <string>

#include "drivers/report/provenance.hpp"
#include "drivers/studies/develop/development.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Depth by place after each passage, and of the start.
std::string profiles_csv(const Development& development);

/// Table with a row for each passage and band: depth, work over it, growth.
std::string spectra_csv(const Development& development);

/// Table with a row for each band's outcome.
std::string growth_csv(const Development& development);

/// Outcomes of the bands and the passages as JSON.
std::string development_json(const Development& development);

Table growth_table(const Development& development);

/// Report of a development that begins with the scene.
Report development_report(const Development& development, const ResolvedScene& resolved,
                          const Provenance& provenance);

/// One sentence that says if the work feeds or alleviates the deepest waves.
std::string verdict(const Development& development);

}  // namespace tread
