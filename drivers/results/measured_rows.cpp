#include "drivers/results/measured_rows.hpp"

#include <algorithm>
#include <limits>

namespace tread {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

MeasuredRows::MeasuredRows(std::vector<MeasuredChannel> channels, const Kept& kept, std::size_t count)
    : channels_(std::move(channels)), values_(count * columns(), kMissing) {
  const std::size_t width = kept.names.size();
  for (std::size_t c = 0; c < columns(); ++c) {
    const auto found = std::find(kept.names.begin(), kept.names.end(), channels_[c].channel.name);
    if (found == kept.names.end()) continue;
    const auto from = static_cast<std::size_t>(found - kept.names.begin());
    for (std::size_t i = 0; i < count && (i + 1) * width <= kept.values.size(); ++i)
      values_[i * columns() + c] = kept.values[i * width + from];
  }
}

void MeasuredRows::append(std::span<const double> values, double interval) {
  const std::size_t start = values_.size();
  values_.insert(values_.end(), values.begin(), values.end());
  for (std::size_t c = 0; c < columns(); ++c) {
    if (!channels_[c].rate_of) continue;
    const std::size_t source = start + *channels_[c].rate_of;
    values_[start + c] = start == 0 ? kMissing : (values_[source] - values_[source - columns()]) / interval;
  }
}

std::size_t MeasuredRows::column(const std::string& name) const {
  const auto named = [&](const MeasuredChannel& measured) { return measured.channel.name == name; };
  return static_cast<std::size_t>(std::find_if(channels_.begin(), channels_.end(), named) -
                                  channels_.begin());
}

MeasuredRows::Kept MeasuredRows::kept() const {
  Kept kept{{}, values_};
  for (const MeasuredChannel& measured : channels_) kept.names.push_back(measured.channel.name);
  return kept;
}

}  // namespace tread
