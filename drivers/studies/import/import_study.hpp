#pragma once
// `tread import`: what a mesh file of another program holds, and its faults.

#include "drivers/studies/import/import_options.hpp"
#include "io/mesh/imported_mesh.hpp"

namespace tread {

/// Reads and checks the file. ProblemsError names the lines and elements at fault; InputError.
ImportedMesh read_mesh_file(const std::filesystem::path& file, const MeshWish& wish);

/// Prints counts, sizes, sets and stable step.
void import_mesh(const ImportOptions& options);

}  // namespace tread
