#pragma once
// Meshes of other programs, from the files that scenes and commands name.

#include <filesystem>
#include <string>
#include <vector>

#include "core/body_spec.hpp"
#include "core/scene.hpp"
#include "io/mesh/imported_mesh.hpp"
#include "io/scene/problems.hpp"

namespace tread {

/// All bytes of a mesh file, without a byte-order mark. Throws InputError.
std::string read_mesh_text(const std::filesystem::path& path);

/// The mesh in a file's text. Every fault is added to `problems`; without any the mesh is of use.
ImportedMesh mesh_in(const std::string& text, const std::filesystem::path& name, const MeshWish& wish,
                     std::vector<Problem>& problems);

/// Takes the body's mesh, about its origin, from a file's text. Every fault is added to `problems`; the body
/// is then without a mesh. `table`: "body.disc".
void set_mesh(const std::string& text, const std::string& name, const std::string& table, BodySpec& body,
              std::vector<Problem>& problems);

/// Sentences on what the bodies' files hold beside the bodies, "body.disc: not read: *MAT_ELASTIC".
std::vector<std::string> body_notes(const Scene& scene);

}  // namespace tread
