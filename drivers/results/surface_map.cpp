#include "drivers/results/surface_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "io/files/hdf5_file.hpp"

namespace tread {

namespace {

std::vector<double> middles(const std::vector<double>& values) {
  std::vector<double> between;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) between.push_back(0.5 * (values[i] + values[i + 1]));
  return between;
}

}  // namespace

SurfaceMap read_surface_map(const std::filesystem::path& path, const std::string& field,
                            const Span& stretch) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  std::vector<double> x = file.read<double>("/x");
  std::vector<double> y = file.read<double>("/y");
  const std::vector<double> values = file.read<double>("/" + field);
  if (values.size() + x.size() + y.size() == x.size() * y.size() + 1) {
    x = middles(x);
    y = middles(y);
  }
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
  if (low > high || end < begin + 2)
    throw InputError(
        fmt::format("{}: {} is not there between x = {:g} and {:g} m; let the wheel roll over them",
                    path.string(), field, stretch.first, stretch.last));
  low -= low > 0 ? 1 : 0;
  high = std::min(high + 2, y.size());
  SurfaceMap map;
  map.column = fmt::format("{} [{}]", field, file.read_text_attribute("/" + field, "unit"));
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

Relief relief(const SurfaceMap& map, const SurfaceView& view) {
  Relief relief;
  relief.title = view.title;
  relief.x_label = "Position on the rail [m]";
  relief.y_label = "Across, + field side [mm]";
  relief.value_label = view.value_label;
  relief.x = map.x;
  for (const double y : map.y) relief.y.push_back(1e3 * y);
  for (std::size_t row = 0; row < map.y.size(); ++row)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      relief.values.push_back(view.scale * map.values[i * map.y.size() + row]);
  return relief;
}

std::string surface_maps_csv(const std::vector<SurfaceMap>& maps) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "field,x [m],y [m],value\n");
  for (const SurfaceMap& map : maps)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      for (std::size_t row = 0; row < map.y.size(); ++row)
        fmt::format_to(out, "{},{:.6g},{:.6g},{:.5g}\n", map.column, map.x[i], map.y[row],
                       map.values[i * map.y.size() + row]);
  return {text.data(), text.size()};
}

}  // namespace tread
