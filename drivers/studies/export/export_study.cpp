#include "drivers/studies/export/export_study.hpp"

#include <fmt/core.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "drivers/engine/lateral_gap.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/studies/export/deck_units.hpp"
#include "drivers/studies/export/keyword_export.hpp"
#include "io/files/output_file.hpp"
#include "io/text/json.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

/// The model with its corrugation; without a stated centre that lies where the undeformed profiles touch.
void corrugate(Model& model) {
  if (!model.scene.corrugation || !model.contact) return;
  const auto profile = [&](int block) {
    return SurfaceProfile(model.mesh.blocks[static_cast<std::size_t>(block)].section);
  };
  const double touching = lateral_gap(profile(model.index.rail_cap), profile(model.index.tread)).lowest;
  model.apply_corrugation(model.scene.corrugation->centre.value_or(touching));
}

DeckOptions deck_options(const ExportOptions& options) {
  DeckOptions deck;
  if (options.reader == "ls-dyna") deck.reader = DeckReader::ls_dyna;
  if (options.ramp.empty()) return deck;
  try {
    deck.ramp = parse_quantity(options.ramp, kTime);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--ramp \"{}\": {}", options.ramp, error.what()));
  }
  if (deck.ramp < 0)
    throw InputError(fmt::format("--ramp \"{}\" is negative; state a time such as \"0.5 ms\"", options.ramp));
  return deck;
}

Json summary_json(const DeckSummary& summary, const ExportOptions& options) {
  return {{"file", options.output.string()},
          {"units", deck_unit::kNames},
          {"nodes", summary.nodes},
          {"elements", summary.elements},
          {"discrete_elements", summary.discrete_elements},
          {"mass_kg", summary.mass},
          {"step_s", summary.step},
          {"duration_s", summary.duration},
          {"differences", summary.differences}};
}

void print_summary(const DeckSummary& summary, const ExportOptions& options) {
  fmt::print("File      {}\n", options.output.string());
  fmt::print("Units     {}\n", deck_unit::kNames);
  fmt::print("Bodies    {} nodes, {} hexahedra, {:.6g} kg\n", summary.nodes, summary.elements, summary.mass);
  fmt::print("Discrete  {} springs and dampers\n", summary.discrete_elements);
  fmt::print("Step      {:.4e} s of {:.4g} ms\n", summary.step, 1e3 * summary.duration);
  fmt::print("\nDifferences from the model:\n");
  for (const std::string& sentence : summary.differences) fmt::print("* {}\n", sentence);
}

}  // namespace

void export_scene(const ResolvedScene& resolved, const ExportOptions& options) {
  use_threads(options.threads);
  const DeckOptions deck_choice = deck_options(options);
  Scene scene = resolved.scene;
  if (scene.motion) scene.motion->start = "rigid";  // a deck starts without a preload
  Model model = scene_model(scene, resolved);
  corrugate(model);
  DeckSummary summary;
  replace_file(options.output, [&](const std::filesystem::path& part) {
    std::ofstream file(part, std::ios::binary);
    KeywordDeck deck([&](std::string_view text) { file << text; });
    summary = write_keyword_deck(model, deck_choice, options.program, deck);
    file.close();
    if (!file) throw ResourceError(fmt::format("cannot write {}: is the disk full?", part.string()));
  });
  if (options.json)
    fmt::print("{}", json_text(summary_json(summary, options)));
  else
    print_summary(summary, options);
}

}  // namespace tread
