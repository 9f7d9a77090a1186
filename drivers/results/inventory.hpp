#pragma once
// Cost of a scene: phases of its computation and the fields that they read and write, as the features of the
// model declare them.

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Vector fields of the static solver beside the displacement: the residual, one and a half of the
/// preconditioner.
inline constexpr double kSolverVectors = 2.5;
/// Those of conjugate gradients, while they iterate.
inline constexpr double kIterationVectors = 2;

/// An array or record that lives in memory during a run.
struct FieldRow {
  std::string name;
  std::string unit;    ///< "-" if it has none
  std::string entity;  ///< owner of one set of values: "node", "tied node", "rail integration point"
  std::int64_t bytes = 0;
};

/// A part of the preload or of the time step.
struct PhaseRow {
  std::string name;
  std::string body;                 ///< the part of the model that it works on, in words
  std::vector<std::string> reads;   ///< names of fields
  std::vector<std::string> writes;  ///< names of fields
};

/// In the order of execution; the preload comes first.
std::vector<PhaseRow> phases(const Model& model);

/// Every field that some phase reads or writes, once.
std::vector<FieldRow> fields(const Model& model);

/// Columns: phase, works on, writes, reads.
Table phase_table(const Model& model);

/// Columns: field, unit, one value set per, size.
Table field_table(const Model& model);

/// Bytes of the fields in a checkpoint, without samples and patch.h5 [B].
std::int64_t checkpoint_bytes(const Model& model);

/// Largest sum of fields that are alive at one time, with the solver, the program and its libraries: an
/// estimate of a run that takes `seconds` of the clock, and so keeps checkpoints or ends before the first.
/// `files`: file_bytes() of the scene. [B]
std::int64_t peak_bytes(const Model& model, double seconds, std::int64_t files = 0);

}  // namespace tread
