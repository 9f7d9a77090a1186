#pragma once
// Meshes in input files of Abaqus.

#include <string_view>

#include "io/mesh/mesh_source.hpp"
#include "io/mesh/mesh_text.hpp"

namespace tread {

/// Reads *NODE, *ELEMENT of types C3D8..., *NSET, *ELSET and *SURFACE of a flat file or of one part with one
/// instance in its own axes, and counts the other keywords. The set named at *ELEMENT is the element's part.
MeshSource read_abaqus_mesh(std::string_view text, MeshFaults& faults);

}  // namespace tread
