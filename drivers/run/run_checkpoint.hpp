#pragma once
// What a checkpoint of a run holds, and the way back.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/state_list.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/results/run_results.hpp"
#include "io/files/sealed_file.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// What a run was asked for.
struct RunOrder {
  SceneSource scene;                   ///< with all files that it names
  std::vector<std::string> overrides;  ///< that the model was made with
  std::vector<std::string> later;      ///< of `tread resume`
  std::string resolved;                ///< what scene and overrides came to
  std::string command;                 ///< as typed
  std::optional<ForkOrigin> origin;    ///< of a fork
};

SealedContent pack_order(const RunOrder& order);
/// InputError where something is missing.
RunOrder unpack_order(const SealedContent& content);

/// The scene that the model is made of. InputError where this program reads other values from it than the one
/// that began the run in `folder`.
ResolvedScene resolve_order(const RunOrder& order, const std::filesystem::path& folder);

/// Copies the fields into entries "<group>/<name>".
void pack(const StateList& list, const std::string& group, SealedContent& content);
/// Copies the entries of the group into the fields. InputError where one is missing, of another size, or
/// unknown.
void unpack(const SealedContent& content, const std::string& group, const StateList& list);

/// A run between two steps. `patch`: the bytes of patch.h5, empty without contact.
SealedContent pack_run(const RunOrder& order, RunResults& results, Model& model, Simulation& simulation,
                       std::string patch);

/// What pack_run() took from `results`: all that Model and Simulation need to be made again.
void unpack_results(const SealedContent& content, RunResults& results);

/// The state of the simulation, and of the model's parts. InputError where the checkpoint was made on another
/// mesh.
void unpack_state(const SealedContent& content, const Model& model, Simulation& simulation);

/// Why the bits may differ from those of the program that wrote the checkpoint; empty: they do not.
std::string other_origin(const SealedContent& content, const Model& model);

}  // namespace tread
