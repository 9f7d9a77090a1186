#pragma once
// The commands of the program. Each declares its options and the work that is called with them.

#include <array>
#include <string>

namespace CLI {
class App;
}

namespace tread {

/// Adds one command; `command_line` is what the user typed, for reports.
using AddCommand = void(CLI::App& app, const std::string& command_line);

AddCommand add_run;
AddCommand add_resume;
AddCommand add_ctl;
AddCommand add_results;
AddCommand add_cache;
AddCommand add_check;
AddCommand add_mesh;
AddCommand add_export;
AddCommand add_import;
AddCommand add_compare;
AddCommand add_multibody;
AddCommand add_roughness;
AddCommand add_profile;
AddCommand add_sweep;
AddCommand add_paper;
AddCommand add_develop;
AddCommand add_dial;
AddCommand add_verify;
AddCommand add_bench;
AddCommand add_manual;
AddCommand add_version;
AddCommand add_scene_reference;

/// In the order of `tread --help`.
inline constexpr std::array kCommands = {
    add_run,     add_resume, add_ctl,     add_results,        add_cache,     add_check,
    add_mesh,    add_export, add_import,  add_compare,        add_multibody, add_roughness,
    add_profile, add_sweep,  add_paper,   add_develop,        add_dial,      add_verify,
    add_bench,   add_manual, add_version, add_scene_reference};

}  // namespace tread
