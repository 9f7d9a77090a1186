#include "drivers/results/surface_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>

#include "io/files/output_file.hpp"

namespace tread {

namespace {

/// Stations [first, last) that have been in contact.
std::array<int, 2> touched(const SurfaceFields& fields) {
  const SurfaceGrid& grid = fields.grid();
  std::array<int, 2> range = {grid.stations(), 0};
  for (int station = 0; station < grid.stations(); ++station)
    for (int row = 0; row < grid.rows(); ++row)
      if (fields.max_pressure()[grid.node(station, row)] > 0)
        range = {std::min(range[0], station), station + 1};
  if (range[0] >= range[1]) range = {0, 0};
  return range;
}

/// The column with the largest sum of values [station][columns].
int strongest(std::span<const double> values, std::size_t columns) {
  std::vector<double> sum(columns, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) sum[i % columns] += values[i];
  return static_cast<int>(std::max_element(sum.begin(), sum.end()) - sum.begin());
}

/// Mean Von Mises stress of those surface elements before and behind a station that have been under pressure
/// [Pa].
double beside(const SurfaceFields& fields, int station, int cell_row) {
  double sum = 0;
  int count = 0;
  for (const int s : {station - 1, station}) {
    if (s < 0 || s + 1 >= fields.grid().stations()) continue;
    const double value = fields.max_von_mises()[fields.grid().cell(s, cell_row)];
    sum += value;
    if (value > 0) ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Largest of the values [station][columns] over the stations of the stretch.
double largest(const SurfaceFields& fields, const SurfaceResults& surface, std::span<const double> values,
               std::size_t columns) {
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = fields.grid().x[i / columns];
    if (x >= surface.first && x <= surface.last) most = std::max(most, values[i]);
  }
  return most;
}

/// A field of surface.h5.
struct SurfaceDataset {
  const char* name;
  const char* unit;
  const char* description;
  std::span<const double> values;  ///< values [station] or [station][column]
  std::size_t columns;             ///< number of columns; 1: by station alone
  int less = 0;                    ///< number of stations at the end without a value
};

void write_field(Hdf5File& file, const SurfaceDataset& field, int first, int last) {
  const auto count = static_cast<std::uint64_t>(std::max(0, last - field.less - first));
  const auto values = std::span<const double>(field.values)
                          .subspan(static_cast<std::size_t>(first) * field.columns, count * field.columns);
  std::vector<std::uint64_t> shape = {count};
  if (field.columns > 1 || field.less > 0) shape.push_back(field.columns);
  file.write<double>(field.name, values, std::move(shape));
  file.write_attribute(field.name, "unit", field.unit);
  file.write_attribute(field.name, "description", field.description);
}

}  // namespace

SurfaceResults surface_results(const SurfaceFields& fields, double first, double last) {
  SurfaceResults s;
  const SurfaceGrid& grid = fields.grid();
  const std::size_t rows = grid.y.size();
  const std::size_t cell_rows = grid.quad.size();
  s.axis_row = strongest(fields.max_pressure(), rows);
  const int cell_row = strongest(fields.max_von_mises(), cell_rows);
  s.axis_y = grid.y[static_cast<std::size_t>(s.axis_row)];
  s.first = first;
  s.last = std::max(first, last);
  const auto range = touched(fields);
  for (int station = range[0]; station < range[1]; ++station) {
    const std::size_t i = grid.node(station, s.axis_row);
    s.axis.push_back({grid.x[static_cast<std::size_t>(station)], fields.max_pressure()[i],
                      fields.max_shear()[i], beside(fields, station, cell_row), fields.frictional_work()[i],
                      fields.sampled_frictional_work()[i]});
  }
  if (std::none_of(s.axis.begin(), s.axis.end(), [&](const AxisNode& n) { return s.covers(n); }))
    s.last = s.first;  // shorter than an element, or not reached: no values
  s.max_pressure = largest(fields, s, fields.max_pressure(), rows);
  s.max_shear = largest(fields, s, fields.max_shear(), rows);
  s.max_von_mises = largest(fields, s, fields.max_von_mises(), cell_rows);
  s.max_work = largest(fields, s, fields.frictional_work(), rows);
  const auto inside = [&](const AxisNode& n) { return s.covers(n); };
  s.von_mises = statistics(s.axis, inside, [](const AxisNode& n) { return n.max_von_mises; });
  s.cell_work = statistics(s.axis, inside, [](const AxisNode& n) { return kWorkCell * n.work; });
  s.sampled_cell_work =
      statistics(s.axis, inside, [](const AxisNode& n) { return kWorkCell * n.sampled_work; });
  s.total_work = fields.sum(fields.frictional_work());
  s.total_sampled_work = fields.sum(fields.sampled_frictional_work());
  return s;
}

void write_surface(const std::filesystem::path& path, const SurfaceFields& fields,
                   const Hdf5Attributes& attributes) {
  const SurfaceGrid& grid = fields.grid();
  const std::size_t rows = grid.y.size();
  replace_file(path, [&](const std::filesystem::path& part) {
    Hdf5File file = Hdf5File::create(part);
    file.set_attributes("/", attributes);
    const auto [first, last] = touched(fields);
    write_field(file, {"/y", "m", "nodes across the rail, field side positive", grid.y, 1}, 0, grid.rows());
    write_field(file, {"/width", "m", "of the profile that a node stands for", grid.width, 1}, 0,
                grid.rows());
    for (const SurfaceDataset& field :
         {SurfaceDataset{"/x", "m", "nodes along the rail", grid.x, 1},
          SurfaceDataset{"/length", "m", "of the rail that a node stands for", grid.length, 1},
          SurfaceDataset{"/max_pressure", "Pa", "largest contact pressure at the node", fields.max_pressure(),
                         rows},
          SurfaceDataset{"/max_shear", "Pa", "largest surface shear stress at the node", fields.max_shear(),
                         rows},
          SurfaceDataset{"/max_von_mises", "Pa",
                         "largest Von Mises stress of the surface element between four nodes, at samples",
                         fields.max_von_mises(), rows - 1, 1},
          SurfaceDataset{"/frictional_work", "J/m2", "at the node, of every step", fields.frictional_work(),
                         rows},
          SurfaceDataset{"/frictional_work_sampled", "J/m2",
                         "at the node, shear stress times micro-slip times interval, at samples",
                         fields.sampled_frictional_work(), rows}})
      write_field(file, field, first, last);
    file.close();
  });
}

void write_axis(const std::filesystem::path& path, const SurfaceResults& surface) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "x [m],max_pressure [Pa],max_shear [Pa],max_von_mises [Pa],frictional_work [J/m2],"
                 "frictional_work_sampled [J/m2],frictional_work_in_1.1_mm_cell [J]\n");
  for (const AxisNode& n : surface.axis)
    fmt::format_to(out, "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", n.x, n.max_pressure,
                   n.max_shear, n.max_von_mises, n.work, n.sampled_work, kWorkCell * n.work);
  write_text_file(path, {text.data(), text.size()});
}

}  // namespace tread
