#include "drivers/bench/bench_row.hpp"

#include <fmt/core.h>

#include "io/report/plain_text.hpp"
#include "io/text/json_writer.hpp"

namespace tread {

std::string json_line(const BenchRow& row) {
  const BenchKey& key = row.key;
  JsonWriter json(JsonWriter::Layout::line);
  json.begin_object()
      .member("kernel", std::string_view(key.kernel))
      .member("path", std::string_view(key.path))
      .member("precision", std::string_view(key.precision))
      .member("backend", std::string_view(key.backend))
      .member("lanes", std::string_view(key.lanes))
      .member("threads", key.threads)
      .member("elements", key.elements)
      .member("element_steps_per_s", row.rate())
      .member("gb_per_s", 1e-9 * row.rate() * row.work.bytes)
      .member("gflops", 1e-9 * row.rate() * row.work.flops)
      .member("fraction_of_limit", row.fraction_of_limit())
      .member("limited_by", row.limit.name())
      .member("unit", std::string_view(row.unit))
      .member("bytes_per_element_step", row.work.bytes)
      .member("flops_per_element_step", row.work.flops)
      .member("spread", row.measured.spread)
      .member("repetitions", row.measured.repetitions);
  if (row.instructions > 0) json.member("instructions_per_element_step", row.instructions);
  return json.end_object().text();
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
