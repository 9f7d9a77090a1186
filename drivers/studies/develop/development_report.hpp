#pragma once
// What a development leaves: tables, figures, a report.

#include <string>

#include "drivers/studies/develop/development.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Depth by place after each passage, and that of the start.
std::string profiles_csv(const Development& development);

/// A row for each passage and band: depth, work over it, growth.
std::string spectra_csv(const Development& development);

/// A row a band: what became of it.
std::string growth_csv(const Development& development);

/// The same and the passages as JSON.
std::string development_json(const Development& development);

Table growth_table(const Development& development);

/// Growth rate by wavelength: by the work of the first and the last passage, and from the profiles.
Figure growth_figure(const Development& development);

Figure profile_figure(const Development& development);

/// `scene`: that begins it; `command`: as typed.
Report development_report(const Development& development, const Scene& scene, const std::string& command);

/// One sentence: whether the work feeds or alleviates the deepest waves.
std::string verdict(const Development& development);

}  // namespace tread
