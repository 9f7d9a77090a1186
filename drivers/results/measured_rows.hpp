#pragma once
// Rows of the values that a scene asks for, one a sample: probes, fastenings, stress under the patch.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "drivers/engine/measurements.hpp"

namespace tread {

class MeasuredRows {
 public:
  /// Rows read back: columns by name, values row by row.
  struct Kept {
    std::vector<std::string> names;
    std::vector<double> values;
  };

  MeasuredRows() = default;
  explicit MeasuredRows(std::vector<MeasuredChannel> channels) : channels_(std::move(channels)) {}
  /// Starts with the first `count` rows of another run, or of this one before it was stopped. Columns are
  /// found by name; NaN in those that it lacks.
  MeasuredRows(std::vector<MeasuredChannel> channels, const Kept& kept, std::size_t count);

  /// Adds the row of a sample, `interval` after the one before [s]. Rates are NaN in the first row.
  void append(std::span<const double> values, double interval);

  const std::vector<MeasuredChannel>& channels() const { return channels_; }
  std::size_t columns() const { return channels_.size(); }
  std::span<const double> row(std::size_t i) const { return {values_.data() + i * columns(), columns()}; }
  /// Index of the column of that name; columns() where there is none.
  std::size_t column(const std::string& name) const;
  Kept kept() const;

 private:
  std::vector<MeasuredChannel> channels_;
  std::vector<double> values_;  ///< row by row
};

}  // namespace tread
