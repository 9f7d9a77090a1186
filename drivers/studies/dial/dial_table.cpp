#include "drivers/studies/dial/dial_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "io/files/share_folder.hpp"
#include "io/scene/scene_library.hpp"
#include "io/text/json.hpp"
#include "io/text/text.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

constexpr const char* kSeparator = "; ";  ///< between settings
constexpr double kAsCheap = 1.01;         ///< of the least cost: as cheap

DialRow row_of(const FinishedRun& run, const FinishedRun& reference) {
  const auto number = [&](const char* path) { return run.number(path).value_or(0); };
  DialRow row;
  row.point = run.label;
  row.elements = number("elements");
  row.steps = number("steps");
  row.minutes =
      (number("mesh_s") + number("preload_s") + number("rolling_s")) * std::max(1.0, number("threads")) / 60;
  for (const DialQuantity& quantity : dial_quantities())
    if (const auto difference = run_difference(run, reference, quantity))
      row.differences[quantity.name] =
          run.label == reference.label ? CurveDifference{.range = 0.0, .shift = 0.0} : *difference;
  return row;
}

std::vector<std::string> split(const std::string& text) {
  const std::string separator = kSeparator;
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + separator.size();
  }
  return parts;
}

double required_number(const JsonRecord& record, const std::string& key, const std::string& name) {
  const auto number = number_in(record, key);
  if (!number)
    throw InputError(fmt::format(
        "{}: a line has no number \"{}\"; expected the dial.jsonl that `tread dial` leaves", name, key));
  return *number;
}

/// Settings other than the element size and the quality, sorted.
std::vector<std::string> beside_size(const DialRow& row) {
  std::vector<std::string> settings = row.settings;
  std::erase_if(settings, [](const std::string& one) {
    return one.starts_with("scene.element_size=") || one.starts_with("scene.quality=");
  });
  std::sort(settings.begin(), settings.end());
  return settings;
}

DialRow row_of(const JsonRecord& record, const std::string& name) {
  DialRow row;
  row.point = text_in(record, "point");
  row.settings = split(text_in(record, "settings"));
  row.elements = required_number(record, "elements", name);
  row.steps = required_number(record, "steps", name);
  row.minutes = required_number(record, "minutes", name);
  for (const DialQuantity& quantity : dial_quantities()) {
    const auto error = number_in(record, quantity.name + "_error");
    if (!error) continue;
    CurveDifference& difference = row.differences[quantity.name];
    difference.error = *error;
    difference.mean = required_number(record, quantity.name + "_mean", name);
    difference.range = number_in(record, quantity.name + "_range");
    difference.fluctuation = number_in(record, quantity.name + "_fluctuation_error");
    difference.shift = number_in(record, quantity.name + "_shift_m");
  }
  return row;
}

Json row_json(const DialTable& table, const DialRow& row) {
  Json json = {
      {"scene", table.scene},     {"reference", table.reference},
      {"point", row.point},       {"settings", fmt::format("{}", fmt::join(row.settings, kSeparator))},
      {"elements", row.elements}, {"steps", row.steps},
      {"minutes", row.minutes}};
  for (const auto& [name, difference] : row.differences) {
    json[name + "_error"] = difference.error;
    json[name + "_mean"] = difference.mean;
    if (difference.range) json[name + "_range"] = *difference.range;
    if (difference.fluctuation) json[name + "_fluctuation_error"] = *difference.fluctuation;
    if (difference.shift) json[name + "_shift_m"] = *difference.shift;
  }
  return json;
}

std::string optional_cell(const std::optional<double>& value) {
  return value ? fmt::format(",{:.4g}", *value) : ",";
}

}  // namespace

DialCost dial_cost(const std::string& text) {
  if (text == "minutes") return DialCost::minutes;
  if (text == "element-steps") return DialCost::element_steps;
  throw InputError(fmt::format("--cost {}: expected minutes or element-steps", text));
}

double cost_of(const DialRow& row, DialCost cost) {
  return cost == DialCost::minutes ? row.minutes : row.element_steps();
}

void require_quantity(const std::string& option, const std::string& quantity) {
  std::string known = kAllQuantities;
  for (const DialQuantity& one : dial_quantities()) {
    if (one.name == quantity) return;
    known += ", " + one.name;
  }
  if (quantity != kAllQuantities)
    throw InputError(fmt::format("{} {}: not a quantity of the dial; known: {}", option, quantity, known));
}

std::optional<double> error_of(const DialRow& row, const std::string& quantity) {
  std::optional<double> largest;
  for (const auto& [name, difference] : row.differences)
    if (name == quantity || quantity == kAllQuantities)
      largest = std::max(largest.value_or(0), difference.fluctuation.value_or(difference.error));
  return largest;
}

std::vector<const DialRow*> compared_rows(const DialTable& table, const std::string& quantity) {
  std::size_t most = 0;
  for (const DialRow& row : table.rows) most = std::max(most, row.differences.size());
  std::vector<const DialRow*> rows;
  for (const DialRow& row : table.rows) {
    const bool whole = quantity != kAllQuantities || row.differences.size() == most;
    if (row.point != table.reference && whole && error_of(row, quantity)) rows.push_back(&row);
  }
  return rows;
}

bool has_fluctuation(const DialTable& table) {
  for (const DialRow& row : table.rows)
    for (const auto& [name, difference] : row.differences)
      if (difference.fluctuation) return true;
  return false;
}

std::vector<const DialRow*> pareto_front(const DialTable& table, const std::string& quantity, DialCost cost) {
  std::vector<const DialRow*> rows = compared_rows(table, quantity);
  std::sort(rows.begin(), rows.end(), [&](const DialRow* a, const DialRow* b) {
    return std::pair(cost_of(*a, cost), *error_of(*a, quantity)) <
           std::pair(cost_of(*b, cost), *error_of(*b, quantity));
  });
  std::vector<const DialRow*> front;
  for (const DialRow* row : rows)
    if (front.empty() || *error_of(*row, quantity) < *error_of(*front.back(), quantity)) front.push_back(row);
  return front;
}

const DialRow* cheapest(const DialTable& table, const std::string& quantity, double wanted, DialCost cost) {
  std::vector<const DialRow*> rows = compared_rows(table, quantity);
  std::vector<const DialRow*> too_far = rows;
  std::erase_if(too_far, [&](const DialRow* row) { return *error_of(*row, quantity) <= wanted; });
  std::erase_if(rows, [&](const DialRow* row) {
    const std::vector<std::string> settings = beside_size(*row);
    return std::any_of(too_far.begin(), too_far.end(), [&](const DialRow* finer) {
      const std::vector<std::string> fewer = beside_size(*finer);
      return finer->elements >= row->elements &&
             std::includes(settings.begin(), settings.end(), fewer.begin(), fewer.end());
    });
  });
  const auto first = [&](const auto& rank) {
    const auto found = std::min_element(
        rows.begin(), rows.end(), [&](const DialRow* x, const DialRow* y) { return rank(*x) < rank(*y); });
    return found == rows.end() ? nullptr : *found;
  };
  const DialRow* least = first([&](const DialRow& row) { return cost_of(row, cost); });
  if (!least) return nullptr;
  const double most = kAsCheap * cost_of(*least, cost);
  std::erase_if(rows, [&](const DialRow* row) { return cost_of(*row, cost) > most; });
  return first([&](const DialRow& row) { return std::pair(row.settings.size(), *error_of(row, quantity)); });
}

DialTable dial_table(const std::vector<FinishedRun>& runs, const FinishedRun& reference) {
  DialTable table;
  table.scene = reference.scene.title;
  table.reference = reference.label;
  for (const FinishedRun& run : runs) table.rows.push_back(row_of(run, reference));
  return table;
}

std::string dial_csv(const DialTable& table) {
  std::string text = "point,settings,elements [-],steps [-],element_steps [-],core_time [min]";
  for (const DialQuantity& quantity : dial_quantities())
    text += fmt::format(",{0}_error [-],{0}_mean [-],{0}_range [-],{0}_fluctuation_error [-],{0}_shift [m]",
                        quantity.name);
  text += ",reference\n";
  for (const DialRow& row : table.rows) {
    text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.4g}", csv_cell(row.point),
                        csv_cell(fmt::format("{}", fmt::join(row.settings, kSeparator))), row.elements,
                        row.steps, row.element_steps(), row.minutes);
    for (const DialQuantity& quantity : dial_quantities()) {
      const auto found = row.differences.find(quantity.name);
      const bool known = found != row.differences.end();
      text += known ? fmt::format(",{:.4g},{:.4g}", found->second.error, found->second.mean) : ",,";
      text += optional_cell(known ? found->second.range : std::nullopt);
      text += optional_cell(known ? found->second.fluctuation : std::nullopt);
      text += optional_cell(known ? found->second.shift : std::nullopt);
    }
    text += fmt::format(",{}\n", csv_cell(table.reference));
  }
  return text;
}

std::string dial_lines(const DialTable& table) {
  std::string text;
  for (const DialRow& row : table.rows) text += json_line(row_json(table, row));
  return text;
}

std::string dial_json(const DialTable& table) {
  Json list = Json::array();
  for (const DialRow& row : table.rows) list.push_back(row_json(table, row));
  return json_text(list);
}

DialTable parse_dial(const std::string& text, const std::string& name) {
  DialTable table;
  for (const JsonRecord& record : parse_json_lines(text, name)) {
    table.scene = text_in(record, "scene");
    table.reference = text_in(record, "reference");
    table.rows.push_back(row_of(record, name));
  }
  if (table.rows.empty()) throw InputError(fmt::format("{}: it holds no run of a dial", name));
  return table;
}

DialTable read_dial(const std::filesystem::path& path) {
  constexpr std::size_t kLargest = 16 << 20;  // [B]
  const bool folder = std::filesystem::is_directory(path);
  const std::filesystem::path file = folder ? path / "dial.jsonl" : path;
  return parse_dial(read_text_file(file, kLargest), file.string());
}

DialTable measured_dial() {
  for (const LibraryEntry& entry : scene_library()) {
    const std::filesystem::path file = find_share_file(fmt::format("dial/{}.jsonl", entry.name));
    if (!file.empty()) return read_dial(file);
  }
  std::vector<std::string> folders;
  for (const std::filesystem::path& folder : share_folders()) folders.push_back((folder / "dial").string());
  throw InputError(
      fmt::format("there is no table of measured settings in {}: name one with --dial, or the folder of the "
                  "program's data files in TREAD_SHARE",
                  fmt::join(folders, ", ")));
}

}  // namespace tread
