#include "io/vtkhdf.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "io/hdf5_file.hpp"
#include "io/output_file.hpp"

namespace tread {

namespace {

constexpr std::uint8_t kHexahedron = 12;  ///< VTK_HEXAHEDRON

struct Cells {
  std::vector<std::int64_t> connectivity;
  std::vector<std::int32_t> block;
  std::vector<std::int32_t> material;
  std::vector<double> pitch;
  std::vector<std::string> material_names;
};

std::int32_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::int32_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return index;
}

/// Distance of a quad's centre from the axis. [m]
double mean_radius(const Section& section, const std::array<int, 4>& quad) {
  double sum = 0;
  for (const int node : quad) sum += section.q[static_cast<std::size_t>(node)];
  return sum / 4;
}

/// Appends the elements of one block, whose points start at `first_point`. The quad runs counter-clockwise
/// seen along the sweep, as VTK wants the first face of a hexahedron to be.
void add_cells(Cells& cells, const SweptBlock& block, std::int32_t block_index, std::int64_t first_point) {
  const Section& section = block.section;
  const std::int64_t stride = section.nodes();
  for (const Tile& tile : block.tiles) {
    const double pitch = block.classes[static_cast<std::size_t>(tile.pitch_class)].pitch;
    for (int element = 0; element < tile.elements; ++element) {
      const std::int64_t near = tile.first_station + element;
      const std::int64_t far = (near + 1) % block.station_count();
      for (std::size_t q = 0; q < section.quads.size(); ++q) {
        const std::array<int, 4>& quad = section.quads[q];
        for (const std::int64_t station : {near, far})
          for (const int node : quad) cells.connectivity.push_back(first_point + station * stride + node);
        cells.block.push_back(block_index);
        cells.material.push_back(
            index_of(cells.material_names, block.material(static_cast<int>(q), tile.pitch_class).name));
        cells.pitch.push_back(block.sweep == Sweep::extruded ? pitch : pitch * mean_radius(section, quad));
      }
    }
  }
}

Vec3 placed(const Placement& placement, const Vec3& at) {
  const double c = std::cos(placement.angle);
  const double s = std::sin(placement.angle);
  return placement.origin + Vec3{c * at.x + s * at.z, at.y, c * at.z - s * at.x};
}

/// Calls body(block index, section node, station) for all points in the order of the file.
template <class Body>
void for_points(const Mesh& mesh, const Body& body) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (int station = 0; station < mesh.blocks[b].station_count(); ++station)
      for (int node = 0; node < mesh.blocks[b].section.nodes(); ++node) body(b, node, station);
}

void write_points(Hdf5File& file, const Mesh& mesh, const std::vector<Placement>& placements) {
  std::vector<double> points;
  for_points(mesh, [&](std::size_t b, int node, int station) {
    const Vec3 at = placed(placements[b], position(mesh.blocks[b], node, station));
    points.insert(points.end(), {at.x, at.y, at.z});
  });
  const std::array<std::int64_t, 1> count = {static_cast<std::int64_t>(points.size() / 3)};
  file.write<std::int64_t>("/VTKHDF/NumberOfPoints", count);
  file.write<double>("/VTKHDF/Points", points, {points.size() / 3, 3});
}

void write_cells(Hdf5File& file, const Mesh& mesh) {
  Cells cells;
  std::vector<std::string> block_names;
  std::int64_t first_point = 0;
  for (const SweptBlock& block : mesh.blocks) {
    add_cells(cells, block, static_cast<std::int32_t>(block_names.size()), first_point);
    first_point += block.nodes();
    block_names.push_back(block.name);
  }
  const std::size_t count = cells.block.size();
  std::vector<std::int64_t> offsets(count + 1);
  for (std::size_t i = 0; i <= count; ++i) offsets[i] = static_cast<std::int64_t>(8 * i);
  const std::array<std::int64_t, 1> number = {static_cast<std::int64_t>(count)};
  const std::array<std::int64_t, 1> ids = {offsets.back()};

  file.write<std::int64_t>("/VTKHDF/NumberOfCells", number);
  file.write<std::int64_t>("/VTKHDF/NumberOfConnectivityIds", ids);
  file.write<std::int64_t>("/VTKHDF/Connectivity", cells.connectivity);
  file.write<std::int64_t>("/VTKHDF/Offsets", offsets);
  file.write<std::uint8_t>("/VTKHDF/Types", std::vector<std::uint8_t>(count, kHexahedron));
  file.write<std::int32_t>("/VTKHDF/CellData/block", cells.block);
  file.write_attribute("/VTKHDF/CellData/block", "names", fmt::format("{}", fmt::join(block_names, ",")));
  file.write<std::int32_t>("/VTKHDF/CellData/material", cells.material);
  file.write_attribute("/VTKHDF/CellData/material", "names",
                       fmt::format("{}", fmt::join(cells.material_names, ",")));
  file.write<double>("/VTKHDF/CellData/pitch", cells.pitch);
  file.write_attribute("/VTKHDF/CellData/pitch", "unit", "m");
}

void write_field(Hdf5File& file, const Mesh& mesh, const std::vector<Placement>& placements,
                 const VectorField& field) {
  if (static_cast<std::int64_t>(field.values.size()) != 3 * mesh.slots)
    throw std::logic_error(fmt::format("field '{}' has {} values, the mesh {} slots", field.name,
                                       field.values.size(), mesh.slots));
  std::vector<double> vectors;
  for_points(mesh, [&](std::size_t b, int node, int station) {
    const SweptBlock& block = mesh.blocks[b];
    const std::int64_t slot = block.base + block.slot(node, station);
    Vec3 local;
    for (int i = 0; i < 3; ++i) local[i] = field.values[static_cast<std::size_t>(dof(slot, i))];
    const Vec3 v = to_cartesian(block, station, placements[b].angle, local);
    vectors.insert(vectors.end(), {v.x, v.y, v.z});
  });
  const std::string name = "/VTKHDF/PointData/" + field.name;
  file.write<double>(name, vectors, {vectors.size() / 3, 3});
  file.write_attribute(name, "unit", field.unit);
}

}  // namespace

void write_vtkhdf(const std::filesystem::path& path, const Mesh& mesh,
                  const std::vector<Placement>& placements, const std::vector<VectorField>& fields) {
  if (!placements.empty() && placements.size() != mesh.blocks.size())
    throw std::logic_error("write_vtkhdf: one placement per block");
  const std::vector<Placement> places =
      placements.empty() ? std::vector<Placement>(mesh.blocks.size()) : placements;
  replace_file(path, [&](const std::filesystem::path& part) {
    Hdf5File file = Hdf5File::create(part);
    for (const char* group : {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData", "/VTKHDF/FieldData"})
      file.make_group(group);
    const std::array<std::int64_t, 2> version = {1, 0};
    file.write_attribute<std::int64_t>("/VTKHDF", "Version", version);
    file.write_attribute("/VTKHDF", "Type", "UnstructuredGrid");
    write_points(file, mesh, places);
    write_cells(file, mesh);
    for (const VectorField& field : fields) write_field(file, mesh, places, field);
    file.close();
  });
}

}  // namespace tread
