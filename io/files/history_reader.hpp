#pragma once
// Columns of a run's histories.csv.

#include <filesystem>
#include <string>
#include <vector>

namespace tread {

struct HistoryColumn {
  std::string name;  ///< "wheel_x"
  std::string unit;  ///< "m", as the header states it
};

/// The values of the columns, each as many as the file has whole rows. Throws InputError with file and line
/// where a column or unit is missing or a row does not read.
std::vector<std::vector<double>> read_history(const std::filesystem::path& csv,
                                              const std::vector<HistoryColumn>& columns);

}  // namespace tread
