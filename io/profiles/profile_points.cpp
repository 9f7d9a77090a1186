#include "io/profiles/profile_points.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace tread {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<double> leading_numbers(std::string_view line, std::size_t most) {
  std::vector<double> numbers;
  const auto between = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; };
  const char* at = line.data();
  const char* const end = at + line.size();
  while (numbers.size() < most) {
    while (at != end && between(*at)) ++at;
    if (at != end && *at == '+') ++at;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && !between(*next))) break;
    numbers.push_back(value);
    at = next;
  }
  return numbers;
}

bool has_decimal_commas(const std::string& row) {
  const std::string text = with_decimal_points(row);
  return text.find_first_of("; \t") != std::string::npos && text.find(", ") == std::string::npos &&
         leading_numbers(text, 2).size() == 2;
}

std::string comma_fault(const std::string& line) {
  return fmt::format("\"{}\": a comma separates columns: write decimal points, not commas",
                     line.substr(0, 60));
}

}  // namespace tread
