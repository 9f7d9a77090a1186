#pragma once
// Every number that the paper states in its text, as data, and our value beside it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/studies/paper/passage.hpp"
#include "io/report/report.hpp"

namespace tread {

struct PaperNumber {
  std::string figure;  ///< id of the figure to which it belongs; empty: none
  std::string place;   ///< place in the paper: "section 4.2, Fig. 15"
  std::string quantity;
  std::string unit;
  double value = 0;  ///< value of the paper
  std::function<std::optional<double>(const PassageRuns&)> ours;
  std::string remark;  ///< measure of our value and reason of a difference
};

/// All numbers, in the paper's order.
const std::vector<PaperNumber>& paper_numbers();

/// Table of all numbers beside our values. A value is left open if its passage has not been run, or not far
/// enough.
Table number_table(const PassageRuns& runs);

/// Table with the columns figure, place, quantity, unit, paper, ours, difference in per cent.
std::string number_csv(const PassageRuns& runs);

}  // namespace tread
