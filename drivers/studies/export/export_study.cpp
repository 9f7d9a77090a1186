#include "drivers/studies/export/export_study.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "drivers/engine/model/lateral_gap.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/results/scene_model.hpp"
#include "drivers/run/preload_cache.hpp"
#include "drivers/studies/export/deck_limits.hpp"
#include "drivers/studies/export/deck_units.hpp"
#include "drivers/studies/export/keyword_export.hpp"
#include "io/deck/radioss_file.hpp"
#include "io/files/named_output.hpp"
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

/// Beside a deck: the file of OpenRadioss's starter (0) or engine (1).
std::filesystem::path radioss_file(std::filesystem::path deck, int number) {
  return deck.replace_filename(fmt::format("{}_{:04}.rad", deck.stem().string(), number));
}

/// A file that takes its text in large pieces. Errors name `shown`.
class DeckText {
 public:
  DeckText(const std::filesystem::path& path, const std::filesystem::path& shown) : file_(path, shown) {}
  void add(std::string_view text) {
    constexpr std::size_t kPiece = 1 << 20;  // [B]
    text_ += text;
    if (text_.size() >= kPiece) hand_over();
  }
  void close() {
    hand_over();
    file_.close();
  }

 private:
  void hand_over() {
    file_.append(text_);
    text_.clear();
  }

  GrowingFile file_;
  std::string text_;
};

DeckOptions deck_options(const ExportOptions& options) {
  DeckOptions deck;
  if (options.output.empty()) throw InputError("-o: the name of the deck is empty; state a file");
  if (options.reader == "ls-dyna") deck.reader = DeckReader::ls_dyna;
  if (!options.overlap.empty()) deck.overlap = parse_option("--overlap", options.overlap, kLength);
  constexpr double kMostOverlap = 1e-3;  // [m]
  if (deck.overlap < 0 || deck.overlap > kMostOverlap)
    throw InputError(
        fmt::format("--overlap \"{}\": it lies between 0 and 1 mm; state what carries the load, such as \"20 "
                    "um\"",
                    options.overlap));
  if (options.ramp.empty()) return deck;
  deck.ramp = parse_option("--ramp", options.ramp, kTime);
  if (options.preload)
    throw InputError(
        "--ramp and --preload: in its static state a deck bears its loads from the start; leave one out");
  if (deck.ramp < 0)
    throw InputError(fmt::format("--ramp \"{}\" is negative; state a time such as \"0.5 ms\"", options.ramp));
  return deck;
}

/// Throws InputError where the files of a preloaded deck for OpenRadioss cannot lie beside the deck.
void require_place_for_files(const DeckOptions& deck, const std::filesystem::path& output) {
  if (!deck.radioss_cards() || has_neighbours(output)) return;
  throw InputError(
      fmt::format("-o {} takes one file, and --preload for OpenRadioss writes three; name a file, or state "
                  "--for ls-dyna",
                  output.string()));
}

Json summary_json(const DeckSummary& summary, const ExportOptions& options) {
  return {
      {"file", options.output.string()},
      {"radioss_file", summary.radioss.velocities.empty() ? "" : radioss_file(options.output, 0).string()},
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
  if (!summary.radioss.velocities.empty())
    fmt::print("Start     {}, for OpenRadioss's starter, and {} for its engine\n",
               radioss_file(options.output, 0).string(), radioss_file(options.output, 1).string());
  fmt::print("Units     {}\n", deck_unit::kNames);
  fmt::print("Bodies    {} nodes, {} hexahedra, {:.6g} kg\n", summary.nodes, summary.elements, summary.mass);
  fmt::print("Discrete  {} springs and dampers\n", summary.discrete_elements);
  fmt::print("Step      {:.4e} s of {:.4g} ms\n", summary.step, 1e3 * summary.duration);
  fmt::print("\nDifferences from the model:\n");
  for (const std::string& sentence : summary.differences) fmt::print("* {}\n", sentence);
}

/// The files of OpenRadioss: that of the starter names the deck.
void write_radioss_files(const std::filesystem::path& deck, const Scene& scene, const DeckSummary& summary) {
  RadiossRun run;
  run.name = deck.stem().string();
  run.end = deck_unit::kTime * summary.duration;
  run.histories = deck_unit::kTime * scene.output.history_interval;
  if (scene.output.frames > 0) run.frames = run.end / scene.output.frames;
  run.step = deck_unit::kTime * summary.step;
  run.factor = summary.step_factor;
  write_named_text(radioss_file(deck, 1), radioss_run(run));
  write_named_file(radioss_file(deck, 0), [&](const std::filesystem::path& part) {
    DeckText file(part, radioss_file(deck, 0));
    RadiossFile out([&](std::string_view text) { file.add(text); });
    out.begin(run.name, deck.filename().string());
    for (const RadiossTie& tie : summary.radioss.ties) out.tie(tie);
    for (const RadiossContact& contact : summary.radioss.contacts) out.contact(contact);
    for (const RadiossReference& reference : summary.radioss.references) out.reference(reference);
    out.velocities(summary.radioss.velocities);
    out.end();
    file.close();
  });
}

}  // namespace

void export_scene(const ResolvedScene& resolved, const ExportOptions& options) {
  require_other_file(options.output, resolved.source.name);
  for (const auto& [file, text] : resolved.source.files) require_other_file(options.output, file);
  use_threads(options.threads);
  DeckOptions deck_choice = deck_options(options);
  Scene scene = resolved.scene;
  if (scene.motion && !options.preload) scene.motion->start = "rigid";
  Model model = scene_model(scene, resolved);
  std::optional<Preload> preload;
  if (options.preload) {
    deck_choice.preload = &preload.emplace();
    require_place_for_files(deck_choice, options.output);
    require_deck_can_hold(model, deck_choice);
    const Progress progress(options.quiet);
    *preload = preload_and_corrugate(resolved, model,
                                     [&](const std::string& text) { progress.say("[preload] " + text); });
  } else {
    corrugate(model);
  }
  DeckSummary summary;
  write_named_file(options.output, [&](const std::filesystem::path& part) {
    DeckText file(part, options.output);
    KeywordDeck deck([&](std::string_view text) { file.add(text); });
    summary = write_keyword_deck(model, deck_choice, options.program, deck);
    file.close();
  });
  if (!summary.radioss.velocities.empty()) write_radioss_files(options.output, scene, summary);
  if (options.json)
    fmt::print("{}", json_text(summary_json(summary, options)));
  else
    print_summary(summary, options);
}

}  // namespace tread
