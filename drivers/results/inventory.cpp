#include "drivers/results/inventory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/engine/fields/node_fields.hpp"
#include "drivers/engine/step_features.hpp"
#include "drivers/results/frame_files.hpp"
#include "io/report/plain_text.hpp"
#include "kernels/solver/aggregates.hpp"

namespace tread {

namespace {

/// Program, libraries, histories and report, as measured on scenes whose fields are small.
constexpr std::int64_t kProgramBytes = 25'000'000;

/// Matrix and factor of the static solver's coarse level, an aggregate, and what the factorisation needs
/// beside them: measured on runs, 9 to 12 and 13 to 19 kB. [docs/records/findings.md, 3. Meshes beyond the
/// memory]
constexpr std::int64_t kAggregateBytes = 10'500;
constexpr std::int64_t kFactorisationBytes = 15'000;

/// Copies of the scene's files in a run: in the given scene and its order, in the session's scene and order,
/// in the scene that the model is made of; and those that a checkpoint adds while it is packed.
constexpr std::int64_t kFileCopies = 5;
constexpr std::int64_t kPackedFileCopies = 2;

/// Displacement, velocity in single precision and the branches' lag, until the frame is written; grid,
/// arrays, file and its image.
std::int64_t frame_memory(const Model& model) {
  const FrameBytes bytes = frame_bytes(make_vtk_grid(model.mesh, frame_cells(model.scene)));
  constexpr int kTimes = 3;
  const std::size_t component = (model.has_branches() ? 2 : 1) * sizeof(double) + sizeof(float);
  const auto laws = static_cast<std::int64_t>(sizeof(double)) * law_state_values(model.mesh);
  return 3 * model.mesh.slots * static_cast<std::int64_t>(component) + laws + bytes.mesh +
         kTimes * bytes.frame;
}

/// The coarse level is factorised and then used by conjugate gradients, in turn.
std::int64_t solver_memory(const Mesh& mesh) {
  const std::int64_t aggregates = aggregate_count(mesh);
  const double vector = static_cast<double>(3 * mesh.slots) * sizeof(double);
  return static_cast<std::int64_t>(kSolverVectors * vector) + kAggregateBytes * aggregates +
         std::max(static_cast<std::int64_t>(kIterationVectors * vector), kFactorisationBytes * aggregates);
}

std::vector<std::string> names(const std::vector<RunField>& fields) {
  std::vector<std::string> list;
  list.reserve(fields.size());
  for (const RunField field : fields) list.emplace_back(info_of(field).name);
  return list;
}

/// The static state is made of the fields that live from then on.
PhaseRow preload_row(const StepFeatures& features) {
  std::vector<RunField> reads;
  std::vector<RunField> writes = {RunField::displacement, RunField::solver};
  for (const FieldBytes& own : features.fields()) {
    if (info_of(own.field).life != FieldLife::always || own.field == RunField::displacement) continue;
    (own.field == RunField::wheel_frame ? writes : reads).push_back(own.field);
  }
  return {"preload", "static equilibrium of all blocks", names(reads), names(writes)};
}

PhaseRow checkpoint_row(const StepFeatures& features) {
  std::vector<RunField> reads;
  for (const FieldBytes& own : features.fields())
    if (own.saved) reads.push_back(own.field);
  reads.push_back(RunField::samples);
  return {"checkpoint", "a copy of the state, on the wall clock", names(reads),
          names({RunField::checkpoint})};
}

std::int64_t saved_bytes(const StepFeatures& features) {
  std::int64_t sum = 0;
  for (const FieldBytes& own : features.fields())
    if (own.saved) sum += own.bytes;
  return sum;
}

/// A copy of the state and, while it is packed and read back, its largest field: measured, 127 MB for 104 MB
/// of state at `paper`.
std::int64_t checkpoint_memory(const StepFeatures& features) {
  std::int64_t largest = 0;
  for (const FieldBytes& own : features.fields())
    if (own.saved) largest = std::max(largest, own.bytes);
  return saved_bytes(features) + largest;
}

/// Fields of the features, and those of solver and files.
std::vector<FieldBytes> all_fields(const Model& model) {
  const StepFeatures features(model, 0);
  std::vector<FieldBytes> list;
  for (const FieldBytes& own : features.fields())
    if (model.scene.motion || info_of(own.field).life != FieldLife::motion) list.push_back(own);
  if (model.scene.motion) list.push_back({RunField::checkpoint, checkpoint_memory(features)});
  if (model.scene.motion && model.scene.output.frames > 0)
    list.push_back({RunField::frames, frame_memory(model)});
  list.push_back({RunField::solver, solver_memory(model.mesh)});
  return list;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<PhaseRow> phases(const Model& model) {
  const StepFeatures features(model, 0);
  std::vector<PhaseRow> list = {preload_row(features)};
  if (!model.scene.motion) return list;
  for (const PhaseInfo& info : features.phases())
    list.push_back({name_of(info.phase), info.body, names(info.reads), names(info.writes)});
  list.push_back(checkpoint_row(features));
  if (model.scene.output.frames > 0)
    list.push_back({"frames", "a copy of the motion, evenly over the duration",
                    names({RunField::displacement, RunField::velocity, RunField::coefficients}),
                    names({RunField::frames})});
  return list;
}

std::vector<FieldRow> fields(const Model& model) {
  std::vector<FieldRow> list;
  for (const FieldBytes& own : all_fields(model)) {
    const RunFieldInfo& info = info_of(own.field);
    list.push_back({info.name, info.unit, info.entity, own.bytes});
  }
  return list;
}

Table phase_table(const Model& model) {
  Table table{"Phases", {{"Phase"}, {"Works on"}, {"Writes"}, {"Reads"}}, {}};
  for (const PhaseRow& phase : phases(model))
    table.rows.push_back({phase.name, phase.body, joined(phase.writes), joined(phase.reads)});
  return table;
}

Table field_table(const Model& model) {
  Table table{"Fields", {{"Field"}, {"Unit"}, {"By"}, {"Size", Align::right}}, {}};
  for (const FieldRow& field : fields(model))
    table.rows.push_back({field.name, field.unit, field.entity, bytes_text(field.bytes)});
  return table;
}

std::int64_t checkpoint_bytes(const Model& model) {
  return saved_bytes(StepFeatures(model, 0));
}

std::int64_t peak_bytes(const Model& model, double seconds, std::int64_t files) {
  const bool checkpoints = seconds >= model.scene.output.checkpoint_interval;
  std::int64_t always = kProgramBytes + kFileCopies * files;
  std::int64_t preload = 0;
  std::int64_t rolling = 0;
  std::int64_t written = 0;  // by one thread: a checkpoint or frames
  for (const FieldBytes& field : all_fields(model)) {
    if (field.field == RunField::checkpoint && !checkpoints) continue;
    const FieldLife life = info_of(field.field).life;
    if (field.field == RunField::checkpoint)
      written = std::max(written, field.bytes + kPackedFileCopies * files);
    else if (field.field == RunField::frames)
      written = std::max(written, field.bytes);
    else
      (life == FieldLife::always ? always : life == FieldLife::preload ? preload : rolling) += field.bytes;
  }
  return always + std::max(preload, rolling + written);
}

}  // namespace tread
