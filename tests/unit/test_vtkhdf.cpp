#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "io/files/hdf5_file.hpp"
#include "io/vtk/vtkhdf.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using Integers = std::vector<std::int64_t>;

Section rectangle(double p, double q, double width, double height) {
  Section section;
  section.p = {p, p + width, p + 2 * width, p, p + width, p + 2 * width};
  section.q = {q, q, q, q + height, q + height, q + height};
  section.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  section.quad_material = {0, 1};
  return section;
}

/// A bar of two quads and 11 elements along x in two pitches, and a ring of 12 sectors in one full turn.
Mesh bar_and_ring() {
  Material steel;
  steel.name = "steel";
  Material filler;
  filler.name = "filler";
  Mesh mesh;
  mesh.add(make_swept_block("bar", Sweep::extruded, rectangle(-0.01, 0, 0.01, 0.02), {steel, filler}, 0,
                            {{9, 0.01, 0}, {2, 0.02, 0}}));
  mesh.add(make_swept_block("ring", Sweep::revolved, rectangle(-0.01, 0.4, 0.01, 0.03), {filler, steel}, 0,
                            {{12, std::numbers::pi / 6, 0}}));
  return mesh;
}

class VtkhdfTest : public testing::Test {
 protected:
  Vec3 point(const std::vector<double>& xyz, std::int64_t i) const {
    const auto at = static_cast<std::size_t>(3 * i);
    return {xyz[at], xyz[at + 1], xyz[at + 2]};
  }

  samples::TemporaryFolder folder_;
  fs::path path_ = folder_.path / "mesh.hdf";
  Mesh mesh_ = bar_and_ring();
};

TEST_F(VtkhdfTest, HoldsWhatTheReaderAsksFor) {
  write_vtk_mesh(path_, mesh_, make_vtk_grid(mesh_, VtkCells::elements));
  const Hdf5File file = Hdf5File::open_to_read(path_);
  EXPECT_EQ(file.read_text_attribute("/VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_EQ(file.read_attribute<std::int64_t>("/VTKHDF", "Version"), (Integers{1, 0}));
  constexpr std::int64_t kCells = 2 * 11 + 2 * 12;
  constexpr std::int64_t kPoints = 6 * 12 + 6 * 12;
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfCells"), Integers{kCells});
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfPoints"), Integers{kPoints});
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfConnectivityIds"), Integers{8 * kCells});
  EXPECT_EQ(file.shape("/VTKHDF/Points"), (std::vector<std::uint64_t>{kPoints, 3}));
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/Points", "unit"), "m");
  EXPECT_EQ(file.shape("/VTKHDF/Connectivity"), (std::vector<std::uint64_t>{8 * kCells}));
  const Integers offsets = file.read<std::int64_t>("/VTKHDF/Offsets");
  ASSERT_EQ(offsets.size(), std::size_t{kCells + 1});
  EXPECT_EQ(offsets.back(), 8 * kCells);
  EXPECT_EQ(file.read<std::uint8_t>("/VTKHDF/Types"), std::vector<std::uint8_t>(kCells, 12));
  EXPECT_TRUE(file.contains("/VTKHDF/PointData"));
  EXPECT_FALSE(fs::exists(path_.string() + ".part"));
}

TEST_F(VtkhdfTest, HexahedraArePositiveAndFillTheVolume) {
  write_vtk_mesh(path_, mesh_, make_vtk_grid(mesh_, VtkCells::elements));
  const Hdf5File file = Hdf5File::open_to_read(path_);
  const std::vector<double> xyz = file.read<double>("/VTKHDF/Points");
  const Integers ids = file.read<std::int64_t>("/VTKHDF/Connectivity");
  const std::vector<std::int32_t> block = file.read<std::int32_t>("/VTKHDF/CellData/block");
  double volume[2] = {0, 0};
  for (std::size_t cell = 0; cell < block.size(); ++cell) {
    const auto corner = [&](std::size_t i) { return point(xyz, ids[8 * cell + i]); };
    // In VTK, corners 1, 3 and 4 are the neighbours of corner 0. These elements are prisms, so the mean face
    // area along the sweep times the length is exact.
    const Vec3 along = 0.5 * (corner(4) + corner(6) - corner(0) - corner(2));
    const Vec3 area = 0.25 * (cross(corner(1) - corner(0), corner(3) - corner(0)) +
                              cross(corner(5) - corner(4), corner(7) - corner(4)) +
                              cross(corner(2) - corner(1), corner(3) - corner(2)) +
                              cross(corner(6) - corner(5), corner(7) - corner(6)));
    EXPECT_GT(dot(along, area), 0) << "cell " << cell;
    volume[block[cell]] += dot(along, area);
  }
  EXPECT_NEAR(volume[0], 0.02 * 0.02 * 0.13, 1e-12);
  EXPECT_NEAR(volume[1], 0.02 * 6 * std::sin(std::numbers::pi / 6) * (0.43 * 0.43 - 0.40 * 0.40), 1e-12);
}

TEST_F(VtkhdfTest, CellArraysNameBlockMaterialAndLength) {
  write_vtk_mesh(path_, mesh_, make_vtk_grid(mesh_, VtkCells::elements));
  const Hdf5File file = Hdf5File::open_to_read(path_);
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/CellData/block", "names"), "bar,ring");
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/CellData/material", "names"), "steel,filler");
  const std::vector<std::int32_t> material = file.read<std::int32_t>("/VTKHDF/CellData/material");
  const std::vector<double> pitch = file.read<double>("/VTKHDF/CellData/pitch [m]");
  EXPECT_EQ(material[0], 0);
  EXPECT_EQ(material[1], 1);
  EXPECT_EQ(material[22], 1);  // material of the ring's first quad: filler
  EXPECT_DOUBLE_EQ(pitch[0], 0.01);
  EXPECT_DOUBLE_EQ(pitch[21], 0.02);
  EXPECT_DOUBLE_EQ(pitch[22], std::numbers::pi / 6 * 0.415);
}

TEST_F(VtkhdfTest, FacesPointOutwardsAndEncloseTheVolume) {
  const VtkGrid grid = make_vtk_grid(mesh_, VtkCells::faces);
  write_vtk_mesh(path_, mesh_, grid);
  const Hdf5File file = Hdf5File::open_to_read(path_);
  const std::vector<double> xyz = file.read<double>("/VTKHDF/Points");
  const Integers ids = file.read<std::int64_t>("/VTKHDF/Connectivity");
  const std::vector<std::int32_t> block = file.read<std::int32_t>("/VTKHDF/CellData/block");
  // Bar: 6 edges around, 11 elements along, 2 ends of 2 quads. Ring: 6 edges around, no ends.
  ASSERT_EQ(block.size(), 6U * 11 + 2 * 2 + 6 * 12);
  EXPECT_EQ(file.read<std::uint8_t>("/VTKHDF/Types"), std::vector<std::uint8_t>(block.size(), 9));
  EXPECT_EQ(grid.points.size(), 6U * 12 + 6 * 12);  // every node of these sections lies on the outside
  double volume[2] = {0, 0};
  Vec3 sum[2];
  for (std::size_t cell = 0; cell < block.size(); ++cell) {
    const auto corner = [&](std::size_t i) { return point(xyz, ids[4 * cell + i]); };
    for (const std::array<std::size_t, 3>& t : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      const Vec3 area = 0.5 * cross(corner(t[1]) - corner(t[0]), corner(t[2]) - corner(t[0]));
      sum[block[cell]] += area;
      volume[block[cell]] += dot(area, corner(t[0])) / 3;
    }
  }
  EXPECT_NEAR(norm(sum[0]) + norm(sum[1]), 0, 1e-12);
  EXPECT_NEAR(volume[0], 0.02 * 0.02 * 0.13, 1e-12);
  EXPECT_NEAR(volume[1], 0.02 * 6 * std::sin(std::numbers::pi / 6) * (0.43 * 0.43 - 0.40 * 0.40), 1e-12);
}

TEST_F(VtkhdfTest, TheElementBehindAFaceHoldsItsCorners) {
  const VtkGrid grid = make_vtk_grid(mesh_, VtkCells::faces);
  for (std::size_t cell = 0; cell < grid.cells.size(); ++cell) {
    const VtkGrid::Cell& element = grid.cells[cell];
    const SweptBlock& block = mesh_.blocks[static_cast<std::size_t>(element.block)];
    const std::array<int, 4>& quad = block.section.quads[static_cast<std::size_t>(element.quad)];
    for (std::size_t i = 0; i < 4; ++i) {
      const VtkGrid::Point& corner = grid.points[static_cast<std::size_t>(grid.connectivity[4 * cell + i])];
      EXPECT_EQ(corner.block, element.block);
      EXPECT_NE(std::find(quad.begin(), quad.end(), corner.node), quad.end());
      EXPECT_TRUE(corner.station == element.station ||
                  corner.station == (element.station + 1) % block.station_count());
    }
  }
}

TEST_F(VtkhdfTest, AFrameShowsTheCellsOfItsMesh) {
  const VtkGrid grid = make_vtk_grid(mesh_, VtkCells::faces);
  write_vtk_mesh(path_, mesh_, grid);
  const fs::path frame = path_.parent_path() / fmt::format("tread_frame_{}.hdf", ::getpid());
  const std::vector<float> points(3 * grid.points.size(), 1.5F);
  const std::vector<float> stress(grid.cells.size(), 2.5F);
  write_vtk_frame(frame,
                  {path_.filename(), 0.25, points, {{"stress [Pa]", "Pa", "made up", 1, true, stress}}});
  {
    const Hdf5File file = Hdf5File::open_to_read(frame);
    EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/Connectivity"), grid.connectivity);
    EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfCells"),
              Integers{static_cast<std::int64_t>(grid.cells.size())});
    EXPECT_EQ(file.read<std::int32_t>("/VTKHDF/CellData/block").size(), grid.cells.size());
    EXPECT_EQ(file.read<float>("/VTKHDF/Points"), points);
    EXPECT_EQ(file.read<float>("/VTKHDF/CellData/stress [Pa]"), stress);
    EXPECT_EQ(file.read_text_attribute("/VTKHDF/CellData/stress [Pa]", "unit"), "Pa");
    EXPECT_EQ(file.read<double>("/VTKHDF/FieldData/time [s]"), std::vector{0.25});
    EXPECT_EQ(file.read_text_attribute("/VTKHDF/FieldData/time [s]", "unit"), "s");
    EXPECT_EQ(file.read_text_attribute("/VTKHDF/Points", "unit"), "m");
  }
  fs::remove(frame);
}

TEST_F(VtkhdfTest, ABodyIsPlacedTurnedAndLifted) {
  const Placement lifted{{1.0, 0.0, 0.43}, std::numbers::pi / 2};
  const VtkGrid grid = make_vtk_grid(mesh_, VtkCells::elements);
  write_vtk_mesh(path_, mesh_, grid, {Placement{}, lifted});
  const std::vector<double> xyz = Hdf5File::open_to_read(path_).read<double>("/VTKHDF/Points");
  const auto first = std::find_if(grid.points.begin(), grid.points.end(), [](const VtkGrid::Point& at) {
    return at.block == 1 && at.station == 0 && at.node == 0;
  });
  ASSERT_NE(first, grid.points.end());
  // phi = 0 points down; turned by a quarter about +y it points backwards, along -x.
  EXPECT_NEAR(norm(point(xyz, first - grid.points.begin()) - Vec3{1.0 - 0.4, -0.01, 0.43}), 0, 1e-12);
  EXPECT_THROW(write_vtk_mesh(path_, mesh_, grid, {Placement{}}), std::logic_error);
}

}  // namespace
}  // namespace tread
