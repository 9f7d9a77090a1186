#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/studies/import/import_study.hpp"

namespace tread {

void add_import(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App& command = *app.add_subcommand(
      "import", "what a mesh file of another program holds: hexahedra, sets, sizes; its faults");
  command
      .add_option("file", options->file,
                  "LS-DYNA keyword deck (.k), Gmsh version 4 as text (.msh) or Abaqus input file (.inp)")
      ->required();
  command.add_option("--unit", options->unit, "length of the file's numbers, e.g. mm; it is never guessed")
      ->required();
  command.add_option("--part", options->parts,
                     "part or set of elements by name or number; several are possible (default: all)");
  command.add_option("--pieces", options->pieces, "bodies without a common face in the mesh (default: 1)")
      ->check(at_least(1));
  command.add_option("--youngs-modulus", options->youngs_modulus, "for the step (default: 205.9 GPa)");
  command.add_option("--poissons-ratio", options->poissons_ratio, "for the step (default: 0.3)");
  command.add_option("--density", options->density, "for mass and step (default: 7790 kg/m3)");
  add_thread_options(command, options->threads);
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { import_mesh(*options); }); });
}

}  // namespace tread
