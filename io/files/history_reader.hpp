#pragma once
// Columns of a run's histories.csv.

#include <filesystem>
#include <string>
#include <vector>

namespace tread {

struct HistoryColumn {
  std::string name;  ///< name such as "wheel_x"
  std::string unit;  ///< unit as the header states it, such as "m"
};

/// Values of the columns, each as many as the file has whole rows. Throws InputError with file and line if a
/// column or unit is missing or a row cannot be read.
std::vector<std::vector<double>> read_history(const std::filesystem::path& csv,
                                              const std::vector<HistoryColumn>& columns);

}  // namespace tread
