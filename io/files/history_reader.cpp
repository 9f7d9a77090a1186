#include "io/files/history_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "io/text/text_file.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

constexpr std::size_t kLargestHistory = 512 << 20;  // [bytes]

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

std::vector<std::vector<double>> read_history(const std::filesystem::path& csv,
                                              const std::vector<HistoryColumn>& columns) {
  std::istringstream text(read_text_file(csv, kLargestHistory));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = split(line);
  std::vector<std::size_t> places;
  for (const HistoryColumn& column : columns) {
    const std::string wanted = fmt::format("{} [{}]", column.name, column.unit);
    const auto found = std::find(header.begin(), header.end(), wanted);
    if (found == header.end())
      throw InputError(
          fmt::format("{}:1: no column \"{}\"; the histories of `tread run` with a wheel on a rail have it",
                      csv.string(), wanted));
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  std::vector<std::vector<double>> values(columns.size());
  for (int number = 2; std::getline(text, line); ++number) {
    if (line.empty()) continue;
    const std::vector<std::string> cells = split(line);
    if (cells.size() != header.size())
      throw InputError(fmt::format("{}:{}: {} values under {} columns", csv.string(), number, cells.size(),
                                   header.size()));
    try {
      for (std::size_t i = 0; i < places.size(); ++i) values[i].push_back(parse_number(cells[places[i]]));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: {}", csv.string(), number, error.what()));
    }
  }
  return values;
}

}  // namespace tread
