#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "core/aligned.hpp"
#include "io/hdf5_file.hpp"
#include "io/vtkhdf.hpp"

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
  void TearDown() override { fs::remove(path_); }

  Vec3 point(const std::vector<double>& xyz, std::int64_t i) const {
    const auto at = static_cast<std::size_t>(3 * i);
    return {xyz[at], xyz[at + 1], xyz[at + 2]};
  }

  fs::path path_ = fs::path(testing::TempDir()) / fmt::format("tread_mesh_{}.hdf", ::getpid());
  Mesh mesh_ = bar_and_ring();
};

TEST_F(VtkhdfTest, HoldsWhatTheReaderAsksFor) {
  write_vtkhdf(path_, mesh_);
  const Hdf5File file = Hdf5File::open_to_read(path_);
  EXPECT_EQ(file.read_text_attribute("/VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_EQ(file.read_attribute<std::int64_t>("/VTKHDF", "Version"), (Integers{1, 0}));
  constexpr std::int64_t kCells = 2 * 11 + 2 * 12;
  constexpr std::int64_t kPoints = 6 * 12 + 6 * 12;
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfCells"), Integers{kCells});
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfPoints"), Integers{kPoints});
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/NumberOfConnectivityIds"), Integers{8 * kCells});
  EXPECT_EQ(file.shape("/VTKHDF/Points"), (std::vector<std::uint64_t>{kPoints, 3}));
  EXPECT_EQ(file.shape("/VTKHDF/Connectivity"), (std::vector<std::uint64_t>{8 * kCells}));
  const Integers offsets = file.read<std::int64_t>("/VTKHDF/Offsets");
  ASSERT_EQ(offsets.size(), std::size_t{kCells + 1});
  EXPECT_EQ(offsets.back(), 8 * kCells);
  EXPECT_EQ(file.read<std::uint8_t>("/VTKHDF/Types"), std::vector<std::uint8_t>(kCells, 12));
  EXPECT_TRUE(file.contains("/VTKHDF/PointData"));
  EXPECT_FALSE(fs::exists(path_.string() + ".part"));
}

TEST_F(VtkhdfTest, HexahedraArePositiveAndFillTheVolume) {
  write_vtkhdf(path_, mesh_);
  const Hdf5File file = Hdf5File::open_to_read(path_);
  const std::vector<double> xyz = file.read<double>("/VTKHDF/Points");
  const Integers ids = file.read<std::int64_t>("/VTKHDF/Connectivity");
  const std::vector<std::int32_t> block = file.read<std::int32_t>("/VTKHDF/CellData/block");
  double volume[2] = {0, 0};
  for (std::size_t cell = 0; cell < block.size(); ++cell) {
    const auto corner = [&](std::size_t i) { return point(xyz, ids[8 * cell + i]); };
    // VTK: corners 1, 3 and 4 are the neighbours of corner 0; these elements are prisms, so the mean face
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
  write_vtkhdf(path_, mesh_);
  const Hdf5File file = Hdf5File::open_to_read(path_);
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/CellData/block", "names"), "bar,ring");
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/CellData/material", "names"), "steel,filler");
  const std::vector<std::int32_t> material = file.read<std::int32_t>("/VTKHDF/CellData/material");
  const std::vector<double> pitch = file.read<double>("/VTKHDF/CellData/pitch");
  EXPECT_EQ(material[0], 0);
  EXPECT_EQ(material[1], 1);
  EXPECT_EQ(material[22], 1);  // the ring's first quad is of filler
  EXPECT_DOUBLE_EQ(pitch[0], 0.01);
  EXPECT_DOUBLE_EQ(pitch[21], 0.02);
  EXPECT_DOUBLE_EQ(pitch[22], std::numbers::pi / 6 * 0.415);
}

TEST_F(VtkhdfTest, FieldsTurnWithTheirBody) {
  // A radial unit vector at every node of the ring, whose frame is turned by a quarter and lifted.
  AlignedVector<double> radial(static_cast<std::size_t>(3 * mesh_.slots), 0.0);
  const SweptBlock& ring = mesh_.blocks[1];
  for (int station = 0; station < ring.station_count(); ++station)
    for (int node = 0; node < ring.section.nodes(); ++node)
      radial[static_cast<std::size_t>(dof(ring.base + ring.slot(node, station), 2))] = 1;
  const Placement lifted{{1.0, 0.0, 0.43}, std::numbers::pi / 2};
  write_vtkhdf(path_, mesh_, {Placement{}, lifted}, {{"displacement", "m", radial}});

  const Hdf5File file = Hdf5File::open_to_read(path_);
  const std::vector<double> xyz = file.read<double>("/VTKHDF/Points");
  const std::vector<double> field = file.read<double>("/VTKHDF/PointData/displacement");
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/PointData/displacement", "unit"), "m");
  for (std::int64_t i = mesh_.blocks[0].nodes(); i < mesh_.blocks[0].nodes() + ring.nodes(); ++i) {
    Vec3 arm = point(xyz, i) - lifted.origin;
    arm.y = 0;
    const Vec3 outwards = 1 / norm(arm) * arm;
    EXPECT_NEAR(norm(outwards - point(field, i)), 0, 1e-12);
  }
  // phi = 0 points down; turned by a quarter about +y it points backwards, along -x.
  EXPECT_NEAR(point(xyz, mesh_.blocks[0].nodes()).x, 1.0 - 0.4, 1e-12);
}

TEST_F(VtkhdfTest, RefusesFieldsOfAnotherMesh) {
  const std::vector<double> values(7);
  EXPECT_THROW(write_vtkhdf(path_, mesh_, {}, {{"u", "m", values}}), std::logic_error);
  EXPECT_THROW(write_vtkhdf(path_, mesh_, {Placement{}}), std::logic_error);
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_FALSE(fs::exists(path_.string() + ".part"));
}

}  // namespace
}  // namespace tread
