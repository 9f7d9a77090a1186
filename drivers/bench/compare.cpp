#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "drivers/bench/bench_row.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

/// The part of a row that a comparison needs.
struct Recorded {
  double value;   ///< value in the measure's unit
  double spread;  ///< [-]
};

constexpr const char* kRate = "element_steps_per_s";
constexpr const char* kInstructions = "instructions_per_element_step";
constexpr double kInstructionSpread = 0.03;  ///< calls of contact_search differ
constexpr double kLargestSpread = 0.1;       ///< a noisier row does not excuse a larger loss [-]

const char* unit_of(BenchMeasure measure) {
  if (measure == BenchMeasure::rate) return "1e6/s";
  return measure == BenchMeasure::fraction_of_limit ? "of limit" : "instructions";
}

template <class T>
T member(const JsonRecord& record, const std::string& name, const std::filesystem::path& path) {
  const auto found = record.find(name);
  if (found == record.end() || !std::holds_alternative<T>(found->second))
    throw InputError(
        fmt::format("{}: a line has no {} '{}'; expected what `tread bench kernels --json` prints",
                    path.string(), std::is_same_v<T, double> ? "number" : "text", name));
  return std::get<T>(found->second);
}

std::map<BenchKey, Recorded> read_rows(const std::filesystem::path& path, BenchMeasure measure) {
  std::map<BenchKey, Recorded> rows;
  for (const JsonRecord& record : read_json_lines(path)) {
    const auto text = [&](const char* name) { return member<std::string>(record, name, path); };
    const auto number = [&](const char* name) { return member<double>(record, name, path); };
    const BenchKey key{text("kernel"),
                       text("path"),
                       text("precision"),
                       text("backend"),
                       text("lanes"),
                       static_cast<int>(number("threads")),
                       static_cast<std::int64_t>(number("elements"))};
    if (measure != BenchMeasure::instructions && record.contains(kInstructions) && !record.contains(kRate))
      throw InputError(
          fmt::format("{} states instructions and no rates: compare it --by instructions", path.string()));
    Recorded& row = rows[key];
    if (measure == BenchMeasure::rate)
      row = {1e-6 * number(kRate), number("spread")};
    else if (measure == BenchMeasure::fraction_of_limit)
      row = {number("fraction_of_limit"), number("spread")};
    else if (record.contains(kInstructions))
      row = {number(kInstructions), kInstructionSpread};
    if (row.value <= 0) rows.erase(key);  // not counted
  }
  return rows;
}

}  // namespace

bool compare_benchmarks(const std::filesystem::path& before_path, const std::filesystem::path& after_path,
                        BenchMeasure measure, bool common) {
  const auto before = read_rows(before_path, measure);
  const auto after = read_rows(after_path, measure);
  const char* const unit = unit_of(measure);
  Table table{"", key_columns(), {}};
  table.columns.insert(table.columns.end(), {{fmt::format("Before, {}", unit), Align::right},
                                             {fmt::format("After, {}", unit), Align::right},
                                             {"Change", Align::right},
                                             {"Spread", Align::right},
                                             {""}});
  int regressions = 0, noisy = 0;
  for (const auto& [key, now] : after) {
    const auto then = before.find(key);
    if (then == before.end()) continue;
    const double ratio = now.value / then->second.value;
    const double change = (measure == BenchMeasure::instructions ? 1 / ratio : ratio) - 1;
    const double recorded = std::max(now.spread, then->second.spread);
    const double spread = std::min(recorded, kLargestSpread);
    const bool slower = change < -spread;
    regressions += slower;
    noisy += recorded > spread;
    std::vector<std::string>& cells = table.rows.emplace_back(key_cells(key));
    cells.insert(cells.end(),
                 {fmt::format("{:.4g}", then->second.value), fmt::format("{:.4g}", now.value),
                  fmt::format("{:+.1f} %", 100 * change), fmt::format("{:.1f} %", 100 * recorded),
                  slower ? "SLOWER" : (change > spread ? "faster" : "")});
  }
  if (table.rows.empty())
    throw InputError(fmt::format(
        "bench compare: no row of '{}' has a counterpart in '{}': same kernel, path, precision, backend, "
        "lanes, threads and elements, and what is compared counted in both",
        after_path.string(), before_path.string()));
  const std::size_t compared = table.rows.size();
  const std::size_t missing = before.size() - compared;
  for (const auto& [key, then] : before) {
    if (common || after.contains(key)) continue;
    std::vector<std::string>& cells = table.rows.emplace_back(key_cells(key));
    cells.insert(cells.end(), {fmt::format("{:.4g}", then.value), "", "", "", "MISSING"});
  }
  fmt::print(
      "{}{} rows compared, {} only before, {} only after, {} slower by more than the spread or {:g} %\n",
      plain_text(table), compared, missing, after.size() - compared, regressions, 100 * kLargestSpread);
  if (noisy > 0)
    fmt::print("{} rows spread by more than {:g} %, which excuses no larger loss: measure them again\n",
               noisy, 100 * kLargestSpread);
  return regressions == 0 && (common || missing == 0);
}

}  // namespace tread
