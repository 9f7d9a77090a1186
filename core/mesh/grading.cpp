#include "core/mesh/grading.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/index.hpp"

namespace tread {

namespace {

constexpr double kColumnGrowth = 0.22;  // d(size)/d(distance): neighbours grow by about exp(0.22)
constexpr double kRowGrowth = 1.45;     // largest growth from row to row

}  // namespace

double SectionSize::column(double p, double largest) const {
  const double outside = std::max(0.0, std::abs(p - band_centre) - band_half_width);
  return std::max(surface, std::min(largest, surface + kColumnGrowth * outside));
}

double SectionSize::layer_weight(double p, double left, double right) const {
  const double reach = p < band_centre ? band_centre - left : right - band_centre;
  const double full = std::clamp(reach - 10e-3, 0.0, band_half_width);
  if (reach <= full) return 0;
  return std::clamp((reach - std::abs(p - band_centre)) / (reach - full), 0.0, 1.0);
}

void check(const SectionSize& size, double depth, const std::string& name, const std::string& way_out) {
  if (!(size.surface > 0) || !(size.coarse > 0) || !(size.band_half_width > 0) || size.fine_layers < 1)
    throw InputError(
        fmt::format("{}: element sizes {} and {} m, band half width {} m, {} layers: all have to be positive",
                    name, size.surface, size.coarse, size.band_half_width, size.fine_layers));
  if (size.fine_layers * size.surface > depth)
    throw MeshSizeError(
        fmt::format(
            "{}: {} layers of {:.4g} mm do not fit into {:.4g} mm below the surface; an element_size of "
            "{:.4g} mm at most fits{}",
            name, size.fine_layers, 1e3 * size.surface, 1e3 * depth, 1e3 * depth / size.fine_layers, way_out),
        depth / size.fine_layers);
}

std::vector<double> graded(std::span<const double> breaks, const std::function<double(double)>& size) {
  constexpr int samples = 400;
  std::vector<double> result = {breaks.front()};
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const double a = breaks[k - 1], step = (breaks[k] - a) / samples;
    std::vector<double> elements(samples + 1, 0.0);  // wanted number of elements from a onwards
    for (int i = 1; i <= samples; ++i)
      elements[index(i)] = elements[index(i - 1)] + step / size(a + (i - 0.5) * step);
    const double wanted = elements.back();
    // The count is rounded down more readily than up: a smaller element costs time step, a larger one costs
    // little.
    const int count = std::max(1, static_cast<int>(std::min(wanted + 0.35, 1.09 * wanted + 0.1)));
    for (int i = 1; i < count; ++i) {
      const double target = wanted * i / count;
      const auto above = std::upper_bound(elements.begin(), elements.end(), target);
      const double part = (target - *(above - 1)) / (*above - *(above - 1));
      result.push_back(a + step * (static_cast<double>(above - elements.begin()) - 1 + part));
    }
    result.push_back(breaks[k]);
  }
  return result;
}

int element_count(double length, double size, int least) {
  return std::max(least, static_cast<int>(std::lround(length / size)));
}

std::vector<double> evenly(double first, double last, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / count);
  values.push_back(last);
  return values;
}

std::vector<double> layer_depths(const SectionSize& size, double depth) {
  const double fine = size.fine_layers * size.surface, rest = depth - fine;
  if (rest < 0.7 * size.surface) return evenly(0, depth, size.fine_layers);
  const double largest = std::max(size.surface, size.coarse);
  const auto rows_below = [&](double growth, int count) {
    std::vector<double> depths = {fine};
    double row = size.surface;
    for (int i = 0; i < count; ++i) depths.push_back(depths.back() + std::min(row *= growth, largest));
    return depths;
  };
  int count = 1;
  while (rows_below(kRowGrowth, count).back() < depth) ++count;
  double low = 0, high = kRowGrowth;
  for (int step = 0; step < 60; ++step) {
    const double growth = 0.5 * (low + high);
    (rows_below(growth, count).back() < depth ? low : high) = growth;
  }
  const auto below = rows_below(high, count);
  std::vector<double> depths = evenly(0, fine, size.fine_layers);
  depths.insert(depths.end(), below.begin() + 1, below.end());
  depths.back() = depth;
  return depths;
}

void append(std::vector<double>& line, std::span<const double> more) {
  line.insert(line.end(), more.begin() + 1, more.end());
}

std::vector<double> from_below(std::span<const double> depths) {
  std::vector<double> result;
  for (auto depth = depths.rbegin(); depth != depths.rend(); ++depth)
    result.push_back(1 - *depth / depths.back());
  result.back() = 1;
  return result;
}

std::vector<double> nested(std::span<const double> fine, std::span<const double> coarse,
                           const std::string& name) {
  const int edges = static_cast<int>(coarse.size()) - 1, last = static_cast<int>(fine.size()) - 1;
  if (edges > last)
    throw MeshSizeError(
        fmt::format("{}: {} coarse elements meet {} fine ones along the tie; give a larger coarse size or a "
                    "smaller element_size",
                    name, edges, last));
  std::vector<int> at(coarse.size());
  for (int k = 0; k <= edges; ++k) {
    const auto next = std::lower_bound(fine.begin(), fine.end(), coarse[index(k)]);
    int nearest = static_cast<int>(next - fine.begin());
    if (nearest > last || (nearest > 0 && coarse[index(k)] - fine[index(nearest - 1)] <
                                              fine[index(nearest)] - coarse[index(k)]))
      --nearest;
    at[index(k)] = k == 0 ? 0 : std::max(nearest, at[index(k - 1)] + 1);
  }
  at[index(edges)] = last;
  for (int k = edges - 1; k > 0; --k) at[index(k)] = std::min(at[index(k)], at[index(k + 1)] - 1);

  std::vector<double> result = {coarse.front()};
  for (int k = 0; k < edges; ++k) {
    const auto part = evenly(coarse[index(k)], coarse[index(k + 1)], at[index(k + 1)] - at[index(k)]);
    result.insert(result.end(), part.begin() + 1, part.end());
  }
  return result;
}

}  // namespace tread
