#pragma once
// Meshes and fields for ParaView: static VTKHDF 1.0 files of one unstructured grid. ParaView 5.11 opens them
// if their name ends in .hdf. [VTKHDF 1.0]

#include <filesystem>
#include <string>
#include <vector>

#include "io/files/hdf5_file.hpp"
#include "io/vtk/vtk_grid.hpp"

namespace tread {

/// Writes a grid of the mesh with cell arrays `block` and `material` (indices; the arrays' attribute `names`
/// lists the names, comma-separated) and `pitch [m]`, the length of the element along the sweep. `placements`
/// holds one placement per block or is empty (all at the origin). `attributes` are those of the root. Throws
/// ResourceError; an older file stays until the new one is complete.
void write_vtk_mesh(const std::filesystem::path& path, const Mesh& mesh, const VtkGrid& grid,
                    const std::vector<Placement>& placements = {}, const Hdf5Attributes& attributes = {});

/// Values at the points of a grid, or at its cells.
struct VtkArray {
  std::string name;  ///< name shown in ParaView, with its unit, such as "velocity [m s-1]"; without '/',
                     ///< which would split it
  std::string unit;
  std::string description;
  int components = 1;
  bool of_cells = false;
  std::vector<float> values;  ///< values [point or cell][component]
};

/// State of a grid at one instant.
struct VtkFrame {
  std::filesystem::path mesh;  ///< path of the file of write_vtk_mesh(), relative to the frame's folder
  double time = 0;             ///< [s]
  std::vector<float> points;   ///< coordinates [point][3] [m]
  std::vector<VtkArray> arrays;
  Hdf5Attributes attributes = {};  ///< attributes of the root
};

/// Writes a frame: a file that shows its mesh's cells and materials by links, with points and arrays of its
/// own and array `time [s]` beside the fields. Throws as write_vtk_mesh().
void write_vtk_frame(const std::filesystem::path& path, const VtkFrame& frame);

}  // namespace tread
