#pragma once
// The cheapest setting within a wanted error, as a dial has measured it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/results/estimate.hpp"
#include "drivers/studies/dial/dial_table.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json.hpp"

namespace tread {

struct AdviceOptions {
  std::string error;                      ///< "2%" or "0.02"; empty: no advice is wanted
  std::string quantity = kAllQuantities;  ///< or a DialQuantity's name
  std::filesystem::path dial = {};        ///< folder or file; empty: measured_dial()
  std::string cost = "element-steps";     ///< or "minutes"
};

/// The question and the answer of the table.
struct Advice {
  double wanted = 0;  ///< [-]
  std::string quantity;
  std::string measured_on;              ///< title of the passage that the table is of
  std::string reference;                ///< of its errors
  bool of_fluctuation = false;          ///< the table has errors of the fluctuation
  std::optional<DialRow> row = {};      ///< the cheapest; absent where none is as near and resolves the scene
  std::optional<DialRow> nearest = {};  ///< of all
  std::vector<std::string> warnings = {};  ///< of the row's mesh here; without a row: of the last skipped
  std::optional<Estimate> cost = {};       ///< of the scene with the row's settings, with the threads in use
  std::string no_cost = {};                ///< why a row has no cost: its mesh cannot be built here
  bool hidden_quality = false;             ///< the row sets the quality, but the scene states an element size
};

/// Nothing where none is wanted. Skips rows that make the same of the scene as fewer settings do and, of the
/// shipped table, rows whose mesh does not resolve it. InputError for options or a table that do not read,
/// and for minutes of the shipped table; ProblemsError where the row's settings do not suit the scene.
std::optional<Advice> advise(const ResolvedScene& resolved, const AdviceOptions& options);

std::string advice_text(const Advice& advice);

/// The member "advice" of `check --json`.
Json advice_json(const Advice& advice);

}  // namespace tread
