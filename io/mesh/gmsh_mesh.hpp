#pragma once
// Meshes of Gmsh, format MSH 4.0 and 4.1 as text.

#include <string_view>

#include "io/mesh/mesh_source.hpp"
#include "io/mesh/mesh_text.hpp"

namespace tread {

/// Volumes become parts, physical volumes sets of elements; physical surfaces, curves and points sets of
/// nodes.
MeshSource read_gmsh_mesh(std::string_view text, MeshFaults& faults);

}  // namespace tread
