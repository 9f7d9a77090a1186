// patch.h5, surface.h5, the table of the axis, maps of depths: files can be read back and state units.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/depth_shape.hpp"
#include "core/error.hpp"
#include "drivers/report/patch_snapshots.hpp"
#include "drivers/results/patch_file.hpp"
#include "drivers/results/surface_map.hpp"
#include "drivers/results/surface_results.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/scene/surface_file.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

/// A grid of twelve stations of 2 mm by four rows of 3 mm.
SurfaceGrid plane() {
  SurfaceGrid grid;
  for (int i = 0; i < 12; ++i) grid.x.push_back(2e-3 * i);
  for (int i = 0; i < 4; ++i) grid.y.push_back(3e-3 * i - 4e-3);
  grid.length.assign(12, 2e-3);
  grid.width.assign(4, 3e-3);
  grid.quad = {0, 1, 2};
  return grid;
}

/// One point in the middle of a face, whose nodes get a quarter of its load each.
ContactPoint point_on(std::array<int, 2> face, double pressure) {
  ContactPoint point{};
  point.face = face;
  point.face_share = {0.25, 0.25, 0.25, 0.25};
  point.area = 6e-6;
  point.pressure = pressure;
  point.shear = point.shear_before = {-0.3 * pressure, 0.1 * pressure};
  point.slip_speed = {-0.5, 0.25};
  point.frictional_work = 2;
  point.slips = true;
  return point;
}

class SurfaceFiles : public testing::Test {
 protected:
  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
  SurfaceGrid grid_ = plane();

  /// Surface after four steps, each a sample, of a point that moves from station to station.
  SurfaceFields passed_surface() const {
    PatchNodes patch(grid_, 5);
    SurfaceFields fields(grid_);
    for (int station = 3; station < 7; ++station) {
      patch.average(station - 1, station + 2, {point_on({station, 1}, 4e8)});
      fields.add_step(patch);
      fields.add_sample(patch, 1e-5);
    }
    return fields;
  }
};

TEST_F(SurfaceFiles, PatchIsReadBackSampleBySample) {
  constexpr int kSamples = 150;  // more than two blocks, not a whole number of them
  PatchNodes patch(grid_, 5);
  {
    PatchFile file(folder_ / "patch.h5", patch, {});
    for (int i = 0; i < kSamples; ++i) {
      const int first = i * 7 / kSamples;
      patch.average(first, first + 3, {point_on({first + 1, 1}, 1e6 * (i + 1))});
      file.append(1e-5 * i, 1e-4 * i, patch);
      if (i == 70) {  // a run killed here leaves whole blocks
        EXPECT_EQ(Hdf5File::open_to_read(folder_ / "patch.h5").shape("/state")[0], PatchFile::kBlock);
      }
    }
    file.close();
  }
  const Hdf5File file = Hdf5File::open_to_read(folder_ / "patch.h5");
  EXPECT_EQ(file.shape("/pressure"), (std::vector<std::uint64_t>{kSamples, 5, 4}));
  EXPECT_EQ(file.read<double>("/x"), grid_.x);
  for (const PatchField& field : patch_fields())
    EXPECT_EQ(file.read_text_attribute(std::string("/") + field.name, "unit"), field.unit);
  EXPECT_EQ(file.read_text_attribute("/time", "unit"), "s");

  const std::vector<PatchSample> samples =
      read_patch(folder_ / "patch.h5", even_places({0, 1e-4 * kSamples}, 3));
  ASSERT_EQ(samples.size(), 3U);
  const PatchSample& last = samples[2];
  EXPECT_DOUBLE_EQ(last.wheel_x, 125e-4);
  EXPECT_EQ(last.first, 125 * 7 / kSamples);
  ASSERT_EQ(last.state.size(), 20U);
  ASSERT_EQ(last.fields.size(), 100U);
  const std::size_t node = grid_.node(1, 1);
  EXPECT_FLOAT_EQ(last.fields[node], 0.25F * 126e6F);
  EXPECT_FLOAT_EQ(last.fields[20 + node], -0.3F * 0.25F * 126e6F);
  EXPECT_FLOAT_EQ(last.fields[80 + node], 0.25F);
  EXPECT_EQ(last.state[node], static_cast<std::uint8_t>(PatchState::slip));
  EXPECT_EQ(last.state[0], static_cast<std::uint8_t>(PatchState::out));
}

TEST_F(SurfaceFiles, InstantsAreNotRepeated) {
  PatchNodes patch(grid_, 5);
  PatchFile file(folder_ / "patch.h5", patch, {});
  for (int i = 0; i < 3; ++i) {
    patch.average(0, 3, {});
    file.append(1e-5 * i, 1e-3 * i, patch);
  }
  file.close();
  EXPECT_EQ(read_patch(folder_ / "patch.h5", even_places({0, 2e-3}, 10)).size(), 3U);
}

/// Samples 0.5 mm apart: waves of 80 mm with crests of the pressure at 2.39 m and every wave behind, lower
/// from 2.6 to 2.68 m.
struct Waves {
  std::vector<double> x, pressure;
  Waves() {
    for (int i = 0; i < 2000; ++i) {
      x.push_back(2.2 + 5e-4 * i);
      const double phase = 2 * std::numbers::pi * (x.back() + 0.01 - 2.4) / 0.08;
      pressure.push_back(1e9 + 3e8 * std::cos(phase) - (x.back() > 2.6 && x.back() < 2.68 ? 1e8 : 0));
    }
  }
};

TEST(TypicalPlaces, ArePressuresLargestAndLeast) {
  const Waves waves;
  const std::vector<double> places = typical_places({2.44, 2.92}, 0.08, waves.x, waves.pressure);
  ASSERT_EQ(places.size(), 10U);
  EXPECT_NEAR(places[0], 2.63, 3e-4);
  EXPECT_NEAR(places[3], 2.67, 3e-4);
  EXPECT_NEAR(places[6], 2.71, 3e-4);
  EXPECT_NEAR(places[9], 2.75, 3e-4);
  for (std::size_t part : {0U, 3U, 6U}) {
    EXPECT_NEAR(places[part + 1], places[part] + (places[part + 3] - places[part]) / 3, 1e-12);
    EXPECT_NEAR(places[part + 2], places[part] + 2 * (places[part + 3] - places[part]) / 3, 1e-12);
  }
}

TEST(TypicalPlaces, OfFewWavesAreThoseOfTheLast) {
  const Waves waves;
  EXPECT_EQ(typical_places({2.44, 2.6}, 0.08, waves.x, waves.pressure), even_places({2.52, 2.6}, 10));
  EXPECT_EQ(typical_places({2.44, 2.92}, 0.08, {}, {}), even_places({2.84, 2.92}, 10));
  EXPECT_DOUBLE_EQ(even_places({2.0, 3.0}, 10).front(), 2.05);
}

TEST_F(SurfaceFiles, InstantsBecomeRowsOfTheAxis) {
  PatchNodes patch(grid_, 5);
  PatchFile file(folder_ / "patch.h5", patch, {});
  patch.average(2, 5, {point_on({3, 1}, 4e8)});
  file.append(0, 6e-3, patch);
  file.close();
  PatchSnapshots snapshots{
      read_patch_axes(folder_ / "patch.h5"), 1, ContactSpec{}, {}, read_patch(folder_ / "patch.h5", {6e-3})};
  const std::string csv = snapshots_csv(snapshots);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "instant,wheel_x [m],x [m],pressure [Pa],shear [Pa],friction_limit [Pa]");
  EXPECT_NE(csv.find("\nt1,0.006,0.006,1e+08,3.1623e+07,5e+07\n"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);  // two nodes, one beside each
  EXPECT_EQ(snapshots_figure(snapshots).panels.size(), 2U);
  snapshots.surfaces.rail.add(dip(1e-3, 4e-3, false), 6e-3);
  EXPECT_EQ(snapshots_figure(snapshots).panels.size(), 3U);
}

TEST_F(SurfaceFiles, MapShowsWhatWasInContact) {
  write_surface(folder_ / "surface.h5", passed_surface());
  const SurfaceMap map = read_surface_map(folder_ / "surface.h5", "max_pressure", {7e-3, 12.5e-3});
  EXPECT_EQ(map.x, (std::vector<double>{grid_.x[4], grid_.x[5], grid_.x[6]}));
  EXPECT_EQ(map.y, grid_.y);  // two rows and one more on either side
  ASSERT_EQ(map.values.size(), 12U);
  EXPECT_EQ(map.values[0], 0);
  EXPECT_NEAR(map.values[1], 1e8, 1e-6);
  const Relief shown = relief(map, {"max_pressure", "Title", "[MPa]", 1e-6});
  EXPECT_NEAR(shown.values[1 * 3 + 2], 100, 1e-9);
  EXPECT_EQ(shown.values[0 * 3 + 2], 0);
  EXPECT_TRUE(
      surface_maps_csv({map}).starts_with("field,x [m],y [m],value\nmax_pressure [Pa],0.008,-0.004,0\n"));
  EXPECT_THROW(read_surface_map(folder_ / "surface.h5", "max_pressure", {1, 2}), InputError);
  EXPECT_THROW(read_surface_map(folder_ / "surface.h5", "max_pressure", {8e-3, 8e-3}), InputError);
  EXPECT_THROW(read_surface_map(folder_ / "surface.h5", "width", {7e-3, 12.5e-3}), InputError);
}

TEST_F(SurfaceFiles, FieldsOfElementsStandBetweenTheNodes) {
  Hdf5File file = Hdf5File::create(folder_ / "surface.h5");
  file.write<double>("/x", std::vector<double>{0, 2, 4, 8});
  file.write<double>("/y", std::vector<double>{-1, 1, 2});
  file.write<double>("/max_von_mises", std::vector<double>{1, 2, 3, 4, 5, 6}, {3, 2});
  file.write_attribute("/max_von_mises", "unit", "Pa");
  file.close();
  const SurfaceMap map = read_surface_map(folder_ / "surface.h5", "max_von_mises", {2, 8});
  EXPECT_EQ(map.column, "max_von_mises [Pa]");
  EXPECT_EQ(map.x, (std::vector<double>{3, 6}));
  EXPECT_EQ(map.y, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(map.values, (std::vector<double>{3, 4, 5, 6}));
}

TEST_F(SurfaceFiles, SurfaceHoldsTheStretchInContact) {
  const SurfaceFields fields = passed_surface();
  write_surface(folder_ / "surface.h5", fields);
  const Hdf5File file = Hdf5File::open_to_read(folder_ / "surface.h5");
  EXPECT_EQ(file.shape("/max_pressure"), (std::vector<std::uint64_t>{5, 4}));
  EXPECT_EQ(file.shape("/max_von_mises"), (std::vector<std::uint64_t>{4, 3}));
  EXPECT_DOUBLE_EQ(file.read<double>("/x").front(), 6e-3);
  EXPECT_EQ(file.read<double>("/y"), grid_.y);
  EXPECT_NEAR(file.read<double>("/max_pressure")[1], 1e8, 1e-6);
  EXPECT_NEAR(file.read<double>("/frictional_work")[1], 0.5, 1e-12);
  EXPECT_NEAR(file.read<double>("/frictional_work")[5], 1.0, 1e-12);
  EXPECT_EQ(file.read_text_attribute("/frictional_work", "unit"), "J/m2");
  EXPECT_EQ(file.read_text_attribute("/max_pressure", "unit"), "Pa");

  const SurfaceResults surface = surface_results(fields, 7e-3, 13e-3);
  EXPECT_EQ(surface.axis.size(), 5U);
  EXPECT_NEAR(surface.max_pressure, 1e8, 1e-6);
  EXPECT_NEAR(surface.total_work, 4 * 2 * 6e-6, 1e-18);
  EXPECT_NEAR(surface.total_sampled_work, 4 * 1e-5 * 4e8 * (0.15 + 0.025) * 6e-6, 1e-12);
  EXPECT_NEAR(surface.cell_work.mean, kWorkCell * 1.0, 1e-15);
  EXPECT_NEAR(surface.cell_work.range(), 0, 1e-15);

  write_axis(folder_ / "axis.csv", surface);
  std::ifstream csv(folder_ / "axis.csv");
  std::string header;
  std::getline(csv, header);
  EXPECT_EQ(header.substr(0, 27), "x [m],max_pressure [Pa],max");
  int rows = 0;
  for (std::string line; std::getline(csv, line);) ++rows;
  EXPECT_EQ(rows, 5);
}

/// A string of variable length, as h5py writes one.
void write_variable_text(const fs::path& path, const char* object, const char* name, const char* text) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute =
      H5Acreate_by_name(file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, static_cast<const void*>(&text));
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(file);
}

TEST(MapFile, StatesTheUnitOfEachDataset) {
  const samples::TemporaryFolder folder;
  const fs::path path = folder.path / "map.h5";
  {
    Hdf5File file = Hdf5File::create(path);
    file.write<double>("/x", std::vector<double>{0, 1});
    file.write<double>("/y", std::vector<double>{0});
    file.write<double>("/depth", std::vector<double>{5, 6}, {1, 2});
    file.write_attribute("/x", "unit", "mm");
    file.write_attribute("/y", "unit", "cm");
  }
  EXPECT_THROW(read_map_text(path), InputError);
  write_variable_text(path, "depth", "unit", "um");
  EXPECT_EQ(read_map_text(path), "# x [mm]  y [cm]  d [um]\n0 0 5\n1 0 6\n");
}

/// A file of two kilobytes may state any size.
TEST(MapFile, ItsStatedSizesAreNotBelieved) {
  const samples::TemporaryFolder folder;
  const fs::path path = folder.path / "map.h5";
  for (const std::vector<hsize_t>& size : {std::vector<hsize_t>{40000, 100000}, {3, hsize_t{1} << 62}}) {
    Hdf5File::create(path).write<double>("/x", std::vector<double>{0, 1});
    Hdf5File::open_to_extend(path).write<double>("/y", std::vector<double>{0});
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(2, size.data(), nullptr);
    const hid_t chunked = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(chunked, 2, std::vector<hsize_t>{1, 1000}.data());
    const hid_t data = H5Dcreate2(file, "depth", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, chunked, H5P_DEFAULT);
    H5Dclose(data);
    H5Pclose(chunked);
    H5Sclose(space);
    H5Fclose(file);
    try {
      read_map_text(path);
      ADD_FAILURE() << size[0];
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(),
                path.string() +
                    ": dataset 'depth' has more than 10000000 values, a map at most; state fewer places");
    }
  }
}

}  // namespace
}  // namespace tread
