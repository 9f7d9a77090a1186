#pragma once
// Every number that the paper states in its text, as data, and ours beside it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/studies/paper/passage.hpp"
#include "io/report/report.hpp"

namespace tread {

struct PaperNumber {
  std::string figure;  ///< id of the figure that it belongs to; empty: none
  std::string place;   ///< in the paper: "section 4.2, Fig. 15"
  std::string quantity;
  std::string unit;
  double value = 0;  ///< the paper's
  std::function<std::optional<double>(const PassageRuns&)> ours;
  std::string remark;  ///< how ours is taken; why they differ
};

/// In the paper's order.
const std::vector<PaperNumber>& paper_numbers();

/// All of them beside ours; what has not been run, or not far enough, is left open.
Table number_table(const PassageRuns& runs);

/// Columns: figure, place, quantity, unit, paper, ours, difference in per cent.
std::string number_csv(const PassageRuns& runs);

}  // namespace tread
