#include <fmt/core.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string>

#include "drivers/results/root_attributes.hpp"
#include "drivers/run/result_listing.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

Json file_json(const ResultFile& file) {
  Json json = {{"name", file.name}, {"bytes", file.bytes}, {"content", file.content}};
  if (!file.problem.empty()) json["problem"] = file.problem;
  json["datasets"] = Json::array();
  for (const ResultItem& item : file.items)
    json["datasets"].push_back({{"name", item.name},
                                {"shape", item.shape},
                                {"type", item.type},
                                {"unit", item.unit},
                                {"description", item.description}});
  return json;
}

void print_json(const ResultListing& listing) {
  Json json = {{"state", listing.state},
               {"complete", listing.complete},
               {"attributes", Json::object()},
               {"files", Json::array()},
               {"runs", Json::array()}};
  add_attributes(listing.attributes, json["attributes"]);
  for (const ResultFile& file : listing.files) json["files"].push_back(file_json(file));
  for (const ResultRun& run : listing.runs)
    json["runs"].push_back({{"name", run.name}, {"state", run.state}});
  fmt::print("{}", json_text(json));
}

Table item_table(const ResultFile& file) {
  Table table{"", {{"dataset"}, {"shape", Align::right}, {"type"}, {"unit"}, {"meaning"}}, {}};
  if (file.name.ends_with(".csv")) table.columns[0].title = "column";
  for (const ResultItem& item : file.items)
    table.rows.push_back(
        {item.name, fmt::format("{}", fmt::join(item.shape, " x ")), item.type, item.unit, item.description});
  return table;
}

void print_text(const ResultListing& listing) {
  fmt::print("State: {}\n", listing.state);
  for (const auto& [name, value] : listing.attributes)
    std::visit([&, key = name](const auto& stated) { fmt::print("{}: {}\n", key, stated); }, value);
  bool apart = true;  // a table stands between empty lines
  for (const ResultFile& file : listing.files) {
    const bool table = !file.items.empty();
    fmt::print("{}{}  {}{}{}\n", apart || table ? "\n" : "", file.name, bytes_text(file.bytes),
               file.content.empty() ? "" : "  ", file.content);
    if (!file.problem.empty()) fmt::print("  {}\n", file.problem);
    if (table) fmt::print("{}", plain_text(item_table(file)));
    apart = table;
  }
  if (!listing.runs.empty()) fmt::print("\nRuns:\n");
  for (const ResultRun& run : listing.runs) fmt::print("  {}: {}\n", run.name, run.state);
}

}  // namespace

void list_results(const ResultsOptions& options) {
  const ResultListing listing = look_at_results(options.folder);
  (options.json ? print_json : print_text)(listing);
}

}  // namespace tread
