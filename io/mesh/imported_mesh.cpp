#include "io/mesh/imported_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/mesh/abaqus_mesh.hpp"
#include "io/mesh/gmsh_mesh.hpp"
#include "io/mesh/keyword_mesh.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

enum class MeshFormat { keyword_deck, gmsh, abaqus, unknown };

/// By content: the first line that tells one; else by the name's suffix.
MeshFormat format_of(std::string_view text, const std::filesystem::path& name) {
  if (text.starts_with("$MeshFormat")) return MeshFormat::gmsh;
  const std::string suffix = lower_case(name.extension().string());
  if (suffix == ".msh") return MeshFormat::gmsh;
  if (suffix == ".inp") return MeshFormat::abaqus;
  if (suffix == ".k" || suffix == ".key" || suffix == ".dyn") return MeshFormat::keyword_deck;
  MeshLines lines(text);
  while (lines.next()) {
    const std::string line = lower_case(lines.line().substr(0, 40));
    if (line.starts_with("*keyword") || line.starts_with("*element_solid")) return MeshFormat::keyword_deck;
    if (line.starts_with("*heading") || line.starts_with("*element,") || line.starts_with("*node,"))
      return MeshFormat::abaqus;
  }
  return MeshFormat::unknown;
}

MeshSource source_of(std::string_view text, const std::filesystem::path& name, MeshFaults& faults) {
  switch (format_of(text, name)) {
    case MeshFormat::gmsh:
      return read_gmsh_mesh(text, faults);
    case MeshFormat::abaqus:
      return read_abaqus_mesh(text, faults);
    case MeshFormat::keyword_deck:
      return read_keyword_mesh(text, faults);
    case MeshFormat::unknown:
      break;
  }
  faults.add(
      0, "unknown formats",
      "is no mesh that can be read: expected an LS-DYNA keyword deck (.k), Gmsh version 4 as text (.msh) "
      "or an Abaqus input file (.inp)");
  return {};
}

void check_unit(const MeshSource& source, const MeshWish& wish, MeshFaults& faults) {
  if (source.stated_unit == 0 || std::abs(source.stated_unit / wish.unit - 1) < 1e-9) return;
  faults.add(
      0, "units that differ",
      fmt::format("the file states a unit of {:g} m (*CONTROL_UNITS), {} one of {:g} m; state the file's",
                  source.stated_unit, wish.unit_key, wish.unit));
}

}  // namespace

ImportedMesh mesh_of(std::string_view text, const std::filesystem::path& name, const MeshWish& wish,
                     MeshFaults& faults) {
  const bool binary_gmsh = text.starts_with("$MeshFormat");  // whose reader knows the way out
  if (!binary_gmsh && text.find('\0') != std::string_view::npos) {
    faults.add(0, "binary files", "it is a binary file; save the mesh as text");
    return {};
  }
  if (trimmed(text.substr(0, 4096)).empty()) {
    faults.add(0, "empty files", "the file is empty");
    return {};
  }
  const MeshSource source = source_of(text, name, faults);
  if (faults.empty()) check_unit(source, wish, faults);
  if (!faults.empty()) return {};
  std::vector<int> lines;
  ImportedMesh imported = numbered_mesh(source, wish, faults, lines);
  if (faults.empty()) check_mesh(imported.mesh, wish.pieces, lines, faults);
  return imported;
}

}  // namespace tread
