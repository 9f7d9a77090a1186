#pragma once
// Contents of a run's checkpoint: packing and unpacking.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/state_list.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/results/run_results.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/files/sealed_file.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Number of the names and meanings in a checkpoint. It rises whenever one of them changes: with Sample, with
/// StateList and with any list_state(). Checkpoints of another format are refused.
inline constexpr std::int64_t kCheckpointFormat = 7;
static_assert(sizeof(Sample) == 35 * sizeof(double), "a changed Sample raises kCheckpointFormat, too");

/// Everything that a run was asked for.
struct RunOrder {
  SceneSource scene;                   ///< scene with all files that it names
  std::vector<std::string> overrides;  ///< overrides of `tread run`, with which the model was made
  std::vector<std::string> later;      ///< overrides of `tread resume`
  std::string resolved;                ///< resolved scene, overrides included
  std::string command;                 ///< command as typed
  std::optional<ForkOrigin> origin;    ///< origin of a fork
};

SealedContent pack_order(const RunOrder& order);
/// InputError where something is missing or the format is not kCheckpointFormat.
RunOrder unpack_order(const SealedContent& content);

/// Scene of which the model is made. Throws InputError if this program reads other values from it than the
/// program that began the run in `folder`.
ResolvedScene resolve_order(const RunOrder& order, const std::filesystem::path& folder);

/// Copies the fields into entries "<group>/<name>".
void pack(const StateList& list, const std::string& group, SealedContent& content);
/// Copies the entries of the group into the fields. Throws InputError if an entry is missing, of another
/// size, or unknown.
void unpack(const SealedContent& content, const std::string& group, const StateList& list);

/// Content of a run between two steps. `patch`: the bytes of patch.h5, empty without contact.
SealedContent pack_run(const RunOrder& order, RunResults& results, Model& model, Simulation& simulation,
                       std::string patch);

/// Restores the entries that pack_run() took from `results`: all that Model and Simulation need to be made
/// again.
void unpack_results(const SealedContent& content, RunResults& results);

/// Puts measured values in the place of those in the content, if any.
void pack_measured(MeasuredRows::Kept measured, SealedContent& content);
/// The measured values of `results` as pack_run() took them; their columns are those of that run.
MeasuredRows::Kept unpack_measured(const SealedContent& content);

/// InputError where the state was made with other lanes or on another mesh.
void require_same_mesh(const SealedContent& content, const Model& model);

/// Restores the state of the simulation and of the model's parts. Throws InputError if the checkpoint was
/// made on another mesh.
void unpack_state(const SealedContent& content, const Model& model, Simulation& simulation);

/// Takes Simulation::unshared_state() out of a run's content.
void leave_to_spread(Simulation& simulation, SealedContent& content);
/// unpack_state() of the rest, on another rank.
void unpack_followed(const SealedContent& content, const Model& model, Simulation& simulation);

/// InputError where the file holds no state of a run, or that of another step than its name states. Another
/// format is left to unpack_order(), which says how to go on.
void require_state(const CheckpointFolder::Found& found);

/// InputError where the state is that of another run than the order: values that `tread resume` changes are
/// in neither scene. Other formats are left to unpack_order().
void require_same_order(const SealedContent& state, const SealedContent& order);

/// Reason why the bits may differ from those of the program that wrote the checkpoint; empty if they do not.
std::string other_origin(const SealedContent& content, const Model& model);

}  // namespace tread
