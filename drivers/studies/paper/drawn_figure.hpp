#pragma once
// The paper's figures drawn from the finished passages.

#include <string>

#include "drivers/studies/paper/paper_figures.hpp"
#include "io/report/report.hpp"

namespace tread {

/// A figure for the report, as a table and as a separate picture. It is a mere text if none of the passages
/// that it needs has been run.
struct DrawnFigure {
  Block block;
  std::string csv, svg;
};

/// Draws the figure from those of its passages that have been run. Throws InputError if a file cannot be
/// read.
DrawnFigure draw(const PaperFigure& figure, const PassageRuns& runs);

}  // namespace tread
