#pragma once
// Attributes at the root of every HDF5 file of results, so that a file says alone where it comes from.

#include "core/scene.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/text/json.hpp"

namespace tread {

/// Program, version and commit, title and quality of the scene, axes, units, speed [m/s] and coefficient of
/// friction. summary.json states the same. [docs/reference/results.md, Attributes]
Hdf5Attributes root_attributes(const Scene& scene);

/// Adds attributes to a JSON object, as members of their names.
void add_attributes(const Hdf5Attributes& attributes, Json& json);

}  // namespace tread
