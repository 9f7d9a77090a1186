#include "drivers/surface_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "io/hdf5_file.hpp"

namespace tread {

SurfaceMap read_surface_map(const std::filesystem::path& path, const std::string& field,
                            const Span& stretch) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  const std::vector<double> x = file.read<double>("/x");
  const std::vector<double> y = file.read<double>("/y");
  const std::vector<double> values = file.read<double>("/" + field);
  if (values.size() != x.size() * y.size())
    throw InputError(fmt::format("{}: {} has {} values for {} x {} nodes; run the scene again", path.string(),
                                 field, values.size(), x.size(), y.size()));
  const auto begin =
      static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), stretch.first) - x.begin());
  const auto end = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), stretch.last) - x.begin());
  std::size_t low = y.size(), high = 0;
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t row = 0; row < y.size(); ++row)
      if (values[i * y.size() + row] > 0) {
        low = std::min(low, row);
        high = std::max(high, row);
      }
  if (low > high)
    throw InputError(fmt::format("{}: nothing has been in contact between x = {:g} and {:g} m", path.string(),
                                 stretch.first, stretch.last));
  low -= low > 0 ? 1 : 0;
  high = std::min(high + 2, y.size());
  SurfaceMap map;
  const auto part = [](const std::vector<double>& all, std::size_t from, std::size_t to) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(from),
                               all.begin() + static_cast<std::ptrdiff_t>(to));
  };
  map.x = part(x, begin, end);
  map.y = part(y, low, high);
  for (std::size_t i = begin; i < end; ++i) {
    const std::vector<double> across = part(values, i * y.size() + low, i * y.size() + high);
    map.values.insert(map.values.end(), across.begin(), across.end());
  }
  return map;
}

Heatmap heatmap(const SurfaceMap& map, std::string title, std::string value_label, double scale) {
  Heatmap heat;
  heat.title = std::move(title);
  heat.x_label = "Position on the rail [m]";
  heat.y_label = "Across, field side positive [mm]";
  heat.value_label = std::move(value_label);
  heat.x = map.x;
  for (const double y : map.y) heat.y.push_back(1e3 * y);
  for (std::size_t row = 0; row < map.y.size(); ++row)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      heat.values.push_back(scale * map.values[i * map.y.size() + row]);
  return heat;
}

std::string surface_map_csv(const SurfaceMap& map, const std::string& column) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "x [m],y [m],{}\n", column);
  for (std::size_t i = 0; i < map.x.size(); ++i)
    for (std::size_t row = 0; row < map.y.size(); ++row)
      fmt::format_to(out, "{:.6g},{:.6g},{:.5g}\n", map.x[i], map.y[row], map.values[i * map.y.size() + row]);
  return {text.data(), text.size()};
}

}  // namespace tread
