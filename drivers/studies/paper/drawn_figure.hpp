#pragma once
// The paper's figures drawn from the passages that have been run.

#include <string>

#include "drivers/studies/paper/paper_figures.hpp"
#include "io/report/report.hpp"

namespace tread {

/// A figure for the report, as a table and as a picture of its own; a text and nothing else where none of its
/// passages has been run that it cannot be drawn without.
struct DrawnFigure {
  Block block;
  std::string csv, svg;
};

/// From those of its passages that have been run. InputError where a file does not read.
DrawnFigure draw(const PaperFigure& figure, const PassageRuns& runs);

}  // namespace tread
