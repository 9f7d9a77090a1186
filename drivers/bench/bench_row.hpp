#pragma once
// One measured result of `tread bench`.

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "drivers/bench/limits.hpp"
#include "drivers/bench/measurement.hpp"
#include "drivers/bench/work.hpp"
#include "io/report/report.hpp"

namespace tread {

/// The measured work; rows of two files with the same key are compared.
struct BenchKey {
  std::string kernel;
  std::string path;  ///< version of the kernel
  std::string precision;
  std::string backend;  ///< library that runs the threads
  std::string lanes;    ///< instruction set
  int threads = 1;
  std::int64_t elements = 0;

  bool operator<(const BenchKey& other) const {
    const auto all = [](const BenchKey& k) {
      return std::tie(k.kernel, k.path, k.precision, k.backend, k.lanes, k.threads, k.elements);
    };
    return all(*this) < all(other);
  }
};

/// The first columns of a table, and a row's cells in them.
std::vector<Column> key_columns();
std::vector<std::string> key_cells(const BenchKey& key);

struct BenchRow {
  BenchKey key;
  std::string unit;  ///< unit that `elements` counts: "element", "node", ...
  Measurement measured;
  Work work;                ///< work per unit
  Limit limit;              ///< limit of a step over all units
  double instructions = 0;  ///< instructions per unit, by the hardware's counter; 0: not counted
  int counted_calls = 0;    ///< calls made for such counters, or for callgrind

  double rate() const { return static_cast<double>(key.elements) / measured.seconds; }  ///< units a second
  /// Share of the rate that the binding limit allows; 0 where nothing is counted.
  double fraction_of_limit() const { return limit.seconds / measured.seconds; }
};

/// The row as one JSON object in a line.
std::string json_line(const BenchRow& row);

Table bench_table(const std::vector<BenchRow>& rows);

}  // namespace tread
