#pragma once
// Tables, figures and report of a development.

#include <string>

#include "drivers/studies/develop/development.hpp"
#include "io/report/report.hpp"

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

/// Growth rate by wavelength: by the work of the first and the last passage, and from the profiles.
Figure growth_figure(const Development& development);

Figure profile_figure(const Development& development);

/// Report of a development. `scene`: scene that begins it; `command`: as typed.
Report development_report(const Development& development, const Scene& scene, const std::string& command);

/// One sentence that says if the work feeds or alleviates the deepest waves.
std::string verdict(const Development& development);

}  // namespace tread
