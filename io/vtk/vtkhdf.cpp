#include "io/vtk/vtkhdf.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "io/files/output_file.hpp"

namespace tread {

namespace {

constexpr std::uint8_t kQuadrilateral = 9;  ///< VTK_QUAD
constexpr std::uint8_t kHexahedron = 12;    ///< VTK_HEXAHEDRON

/// Datasets that every frame takes from its mesh.
constexpr std::array<const char*, 9> kShared = {
    "NumberOfPoints", "NumberOfCells",  "NumberOfConnectivityIds", "Connectivity",      "Offsets",
    "Types",          "CellData/block", "CellData/material",       "CellData/pitch [m]"};

std::int32_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::int32_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return index;
}

/// Starts the file in memory: HDF5 recovers badly from a full disk.
Hdf5File begin(const Hdf5Attributes& attributes) {
  Hdf5File file = Hdf5File::create_in_memory();
  file.set_attributes("/", attributes);
  for (const char* group : {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData", "/VTKHDF/FieldData"})
    file.make_group(group);
  const std::array<std::int64_t, 2> version = {1, 0};
  file.write_attribute<std::int64_t>("/VTKHDF", "Version", version);
  file.write_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  return file;
}

void write_number(Hdf5File& file, const char* name, std::size_t number) {
  const std::array<std::int64_t, 1> value = {static_cast<std::int64_t>(number)};
  file.write<std::int64_t>(fmt::format("/VTKHDF/{}", name), value);
}

void write_points(Hdf5File& file, const Mesh& mesh, const VtkGrid& grid,
                  const std::vector<Placement>& placements) {
  std::vector<double> points;
  for (const VtkGrid::Point& point : grid.points) {
    const auto b = static_cast<std::size_t>(point.block);
    const Vec3 at = placed(placements[b], position(mesh, point));
    points.insert(points.end(), {at.x, at.y, at.z});
  }
  write_number(file, "NumberOfPoints", grid.points.size());
  file.write<double>("/VTKHDF/Points", points, {grid.points.size(), 3});
  file.write_attribute("/VTKHDF/Points", "unit", "m");
}

void write_topology(Hdf5File& file, const VtkGrid& grid) {
  const std::size_t count = grid.cells.size();
  std::vector<std::int64_t> offsets(count + 1);
  for (std::size_t i = 0; i <= count; ++i) offsets[i] = static_cast<std::int64_t>(i) * grid.corners();
  write_number(file, "NumberOfCells", count);
  write_number(file, "NumberOfConnectivityIds", grid.connectivity.size());
  file.write<std::int64_t>("/VTKHDF/Connectivity", grid.connectivity);
  file.write<std::int64_t>("/VTKHDF/Offsets", offsets);
  const std::uint8_t type = grid.kind == VtkCells::elements ? kHexahedron : kQuadrilateral;
  file.write<std::uint8_t>("/VTKHDF/Types", std::vector<std::uint8_t>(count, type));
}

void write_names(Hdf5File& file, const std::string& array, const std::vector<std::string>& names) {
  file.write_attribute(array, "names", fmt::format("{}", fmt::join(names, ",")));
}

void write_cell_arrays(Hdf5File& file, const Mesh& mesh, const VtkGrid& grid) {
  std::vector<std::int32_t> blocks, materials;
  std::vector<double> pitches;
  std::vector<std::string> block_names, material_names;
  for (int part = 0; part < mesh.parts(); ++part) block_names.push_back(mesh.part_name(part));
  for (const VtkGrid::Cell& cell : grid.cells) {
    blocks.push_back(cell.block);
    const Material* material = nullptr;
    if (const HexBody* body = mesh.body_of(cell.block)) {
      const auto element = static_cast<std::size_t>(cell.quad);
      material = &body->materials[static_cast<std::size_t>(body->mesh.part[element])];
      pitches.push_back(hex_shape(body->mesh.corners(element)).longest_edge);
    } else {
      const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(cell.block)];
      const int tile = block.tile_of_station[static_cast<std::size_t>(cell.station)];
      const double pitch = block.pitch(cell.station);
      material = &block.material(cell.quad, block.tiles[static_cast<std::size_t>(tile)].pitch_class);
      pitches.push_back(block.sweep == Sweep::extruded ? pitch
                                                       : pitch * quad_middle(block.section, cell.quad)[1]);
    }
    materials.push_back(index_of(material_names, material->name));
  }
  file.write<std::int32_t>("/VTKHDF/CellData/block", blocks);
  write_names(file, "/VTKHDF/CellData/block", block_names);
  file.write<std::int32_t>("/VTKHDF/CellData/material", materials);
  write_names(file, "/VTKHDF/CellData/material", material_names);
  file.write<double>("/VTKHDF/CellData/pitch [m]", pitches);
  file.write_attribute("/VTKHDF/CellData/pitch [m]", "unit", "m");
  if (!mesh.bodies.empty())
    file.write_attribute("/VTKHDF/CellData/pitch [m]", "of bodies", "longest edge of the element");
}

/// Writes the values in one chunk: coordinates repeat along the sweep, and most of a surface is out of
/// contact.
void write_compressed(Hdf5File& file, const std::string& name, std::span<const float> values,
                      int components) {
  const auto width = static_cast<std::uint64_t>(components);
  const std::uint64_t rows = std::max<std::uint64_t>(1, values.size() / width);
  file.make_extendible<float>(name, rows, width > 1 ? std::vector{width} : std::vector<std::uint64_t>{},
                              Hdf5File::Storage::compressed);
  file.append<float>(name, values);
}

void write_array(Hdf5File& file, const VtkArray& array) {
  const std::string name =
      fmt::format("/VTKHDF/{}/{}", array.of_cells ? "CellData" : "PointData", array.name);
  write_compressed(file, name, array.values, array.components);
  file.write_attribute(name, "unit", array.unit);
  file.write_attribute(name, "description", array.description);
}

}  // namespace

void write_vtk_mesh(const std::filesystem::path& path, const Mesh& mesh, const VtkGrid& grid,
                    const std::vector<Placement>& placements, const Hdf5Attributes& attributes) {
  if (!placements.empty() && placements.size() != static_cast<std::size_t>(mesh.parts()))
    throw std::logic_error("write_vtk_mesh: one placement per part");
  const std::vector<Placement> places =
      placements.empty() ? std::vector<Placement>(static_cast<std::size_t>(mesh.parts())) : placements;
  Hdf5File file = begin(attributes);
  write_points(file, mesh, grid, places);
  write_topology(file, grid);
  write_cell_arrays(file, mesh, grid);
  write_text_file(path, file.image());
}

void write_vtk_frame(const std::filesystem::path& path, const VtkFrame& frame) {
  Hdf5File file = begin(frame.attributes);
  for (const std::string name : kShared) file.link_external("/VTKHDF/" + name, frame.mesh, "/VTKHDF/" + name);
  write_compressed(file, "/VTKHDF/Points", frame.points, 3);
  file.write_attribute("/VTKHDF/Points", "unit", "m");
  for (const VtkArray& array : frame.arrays) write_array(file, array);
  const std::array<double, 1> time = {frame.time};
  file.write<double>("/VTKHDF/FieldData/time [s]", time);
  file.write_attribute("/VTKHDF/FieldData/time [s]", "unit", "s");
  write_text_file(path, file.image());
}

}  // namespace tread
