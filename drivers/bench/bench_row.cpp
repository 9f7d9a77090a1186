#include "drivers/bench/bench_row.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"

namespace tread {

std::string json_line(const BenchRow& row) {
  const BenchKey& key = row.key;
  Json json = {{"kernel", key.kernel},
               {"path", key.path},
               {"precision", key.precision},
               {"backend", key.backend},
               {"lanes", key.lanes},
               {"threads", key.threads},
               {"elements", key.elements},
               {"element_steps_per_s", row.rate()},
               {"gb_per_s", 1e-9 * row.rate() * row.work.bytes},
               {"gflops", 1e-9 * row.rate() * row.work.flops},
               {"fraction_of_limit", row.fraction_of_limit()},
               {"limited_by", row.limit.name()},
               {"unit", row.unit},
               {"bytes_per_element_step", row.work.bytes},
               {"flops_per_element_step", row.work.flops},
               {"spread", row.measured.spread},
               {"repetitions", row.measured.repetitions},
               {"processor_share", row.measured.processor_share}};
  if (row.counted_calls > 0) json["counted_calls"] = row.counted_calls;
  if (row.instructions > 0) json["instructions_per_element_step"] = row.instructions;
  return json_line(json);
}

std::vector<Column> key_columns() {
  return {{"Kernel"},
          {"Path"},
          {"Precision"},
          {"Backend"},
          {"Lanes"},
          {"Threads", Align::right},
          {"Units", Align::right}};
}

std::vector<std::string> key_cells(const BenchKey& key) {
  return {key.kernel,           key.path, key.precision, key.backend, key.lanes, std::to_string(key.threads),
          grouped(key.elements)};
}

Table bench_table(const std::vector<BenchRow>& rows) {
  Table table{"", key_columns(), {}};
  table.columns.insert(table.columns.end(), {{""},
                                             {"ns/unit", Align::right},
                                             {"GB/s", Align::right},
                                             {"GFLOP/s", Align::right},
                                             {"Of limit", Align::right},
                                             {""},
                                             {"Spread", Align::right}});
  for (const BenchRow& row : rows) {
    const bool counted = row.limit.seconds > 0;
    std::vector<std::string>& cells = table.rows.emplace_back(key_cells(row.key));
    cells.insert(cells.end(),
                 {row.unit, fmt::format("{:.3g}", 1e9 / row.rate()),
                  row.work.bytes > 0 ? fmt::format("{:.3g}", 1e-9 * row.rate() * row.work.bytes) : "",
                  row.work.flops > 0 ? fmt::format("{:.3g}", 1e-9 * row.rate() * row.work.flops) : "",
                  counted ? fmt::format("{:.2f}", row.fraction_of_limit()) : "",
                  counted ? row.limit.name() : "", fmt::format("{:.0f} %", 100 * row.measured.spread)});
  }
  return table;
}

}  // namespace tread
