#include "io/text/json_lines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "io/text/text_file.hpp"

namespace tread {

std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path) {
  constexpr std::size_t kLimit = 64 << 20;
  return parse_json_lines(read_text_file(path, kLimit), path.string());
}

std::vector<JsonRecord> parse_json_lines(std::string_view text, const std::string& name) {
  std::vector<JsonRecord> records;
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view one = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    if (one.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    auto record = parse_json(one, JsonShape::flat);
    if (!record)
      throw InputError(
          fmt::format("{}:{}: expected one JSON object of numbers, texts and truths, without "
                      "objects or lists inside it",
                      name, line));
    records.push_back(std::move(*record));
  }
  return records;
}

}  // namespace tread
