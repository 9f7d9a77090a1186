#pragma once
// Meshes of hexahedra from files of other programs, checked.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/hex_mesh.hpp"
#include "io/mesh/mesh_source.hpp"
#include "io/mesh/mesh_text.hpp"

namespace tread {

/// Statements of the user beside the file.
struct MeshWish {
  double unit = 0;                  ///< length of the file's numbers [m]
  std::vector<std::string> parts;   ///< parts or sets of elements by name or number; empty: all elements
  int pieces = 1;                   ///< bodies without a common face that the mesh consists of
  std::string unit_key = "--unit";  ///< key or option that states the unit
};

struct ImportedMesh {
  HexMesh mesh;
  std::string format;              ///< "Gmsh 4.1"
  std::vector<std::string> notes;  ///< things left out
};

/// Largest file that is read [B].
inline constexpr std::size_t kLargestMeshFile = std::size_t{4} << 30U;

/// The mesh in a file's bytes; `name` tells the format where the content does not. Its value is of use if
/// there are no faults: numbers without an object, elements that are no proper hexahedra (inverted, flat,
/// repeated, without nodes), nodes on nodes, faces with three elements, more pieces than stated.
ImportedMesh mesh_of(std::string_view text, const std::filesystem::path& name, const MeshWish& wish,
                     MeshFaults& faults);

/// Numbers into indices, of the wanted parts. Nodes without elements are left out, with a note.
/// `lines`: of the file, by element.
ImportedMesh numbered_mesh(const MeshSource& source, const MeshWish& wish, MeshFaults& faults,
                           std::vector<int>& lines);

/// Finds faults of shape, neighbourhood and cohesion. `lines`: of the file, by element.
void check_mesh(const HexMesh& mesh, int pieces, const std::vector<int>& lines, MeshFaults& faults);

}  // namespace tread
