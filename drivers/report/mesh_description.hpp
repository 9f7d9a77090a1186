#pragma once
// `tread mesh`: parts and measures of a scene's mesh, and a file to look at.

#include <filesystem>

#include "drivers/process/machine.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

struct MeshOptions {
  std::filesystem::path output;  ///< directory for mesh.hdf, created if missing; empty: no file
  ThreadOptions threads;
  bool json = false;  ///< the figures as JSON on stdout instead of tables
};

/// Prints counts, extreme elements, masses and inertias of the bodies and the stable step; writes the mesh.
/// Errors leave as Error.
void describe_mesh(const ResolvedScene& resolved, const MeshOptions& options);

}  // namespace tread
