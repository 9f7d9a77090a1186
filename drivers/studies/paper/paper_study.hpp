#pragma once
// `tread paper`: the passages of the paper's figures, ours beside theirs.

#include <string>
#include <vector>

#include "drivers/studies/study/run_study.hpp"

namespace tread {

struct PaperOptions {
  std::vector<std::string> figures;  ///< ids, "26"; empty: all
  StudyOptions common;
};

/// Runs the passages that the figures need and that are not done, each once, and leaves figNN.csv and
/// figNN.svg, numbers.csv, results.md, sweep.csv and report.html; prints the paper's numbers beside ours.
/// Throws and returns what run_study() does; InputError for a figure that is not known.
std::optional<Error> reproduce_paper(const PaperOptions& options);

}  // namespace tread
