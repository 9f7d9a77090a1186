#pragma once
// What a scene pays for: the phases of its computation and the fields that they read and write, read off the
// model.

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/engine/model.hpp"
#include "io/report/report.hpp"

namespace tread {

/// An array or record that lives in memory during a run.
struct FieldInfo {
  std::string name;
  std::string unit;    ///< "-" if it has none
  std::string entity;  ///< what it has values for: "node", "tied node", "rail integration point"
  std::int64_t bytes = 0;
};

/// A part of the preload or of the time step.
struct PhaseInfo {
  std::string name;
  std::string body;                 ///< what it works on, in words
  std::vector<std::string> reads;   ///< names of fields
  std::vector<std::string> writes;  ///< names of fields
};

/// In the order of execution; the preload comes first.
std::vector<PhaseInfo> phases(const Model& model);

/// Every field that some phase reads or writes, once.
std::vector<FieldInfo> fields(const Model& model);

/// Columns: phase, works on, writes, reads.
Table phase_table(const Model& model);

/// Columns: field, unit, one value set per, size.
Table field_table(const Model& model);

/// Of the fields in a checkpoint, without samples and patch.h5 [B].
std::int64_t checkpoint_bytes(const Model& model);

/// Largest sum of fields that are alive at one time, solver and model included: an estimate. [B]
std::int64_t peak_bytes(const Model& model);

}  // namespace tread
