#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/report/mesh_description.hpp"

namespace tread {

void add_mesh(CLI::App& app, const std::string& /*command_line*/) {
  auto state = std::make_shared<SceneCommand<MeshOptions>>();
  CLI::App& command =
      add_scene_command(app, "mesh", "report size, element sizes, masses and stable step of a scene's mesh",
                        describe_mesh, state);
  command.add_option("-o,--output", state->options.output, "directory for mesh.hdf (ParaView)");
}

}  // namespace tread
