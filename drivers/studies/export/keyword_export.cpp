#include "drivers/studies/export/keyword_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/studies/export/deck_bodies.hpp"
#include "drivers/studies/export/deck_limits.hpp"
#include "drivers/studies/export/deck_model.hpp"
#include "drivers/studies/export/deck_motion.hpp"
#include "drivers/studies/export/deck_springs.hpp"
#include "drivers/studies/export/deck_start.hpp"
#include "drivers/studies/export/deck_surfaces.hpp"
#include "drivers/studies/export/deck_units.hpp"
#include "drivers/studies/export/deck_vehicle.hpp"

namespace tread {

namespace {

void write_head(const DeckModel& deck, const DeckSummary& summary, const std::string& origin,
                KeywordDeck& out) {
  out.keyword("*KEYWORD");
  out.keyword("*TITLE");
  out.title(deck.scene().title);
  out.remark(fmt::format("Written by {}.", origin));
  out.remark(fmt::format("Units: {}. Axes: x rolling, y lateral, z vertical.", deck_unit::kNames));
  out.remark(
      fmt::format("{} nodes and {} hexahedra; {:.6g} kg.", summary.nodes, summary.elements, summary.mass));
  out.remark("Differences from the model:");
  for (const std::string& sentence : summary.differences) out.remark("* " + sentence);
}

/// A step no larger than this program's, where the reader obeys LCTM, and in any case its own times TSSFAC.
/// DT2MS scales no mass, as no step is so short. It makes OpenRadioss take the step of the nodes: the step of
/// its discrete elements knows their own mass alone, which is next to nothing.
void write_control(DeckModel& deck, const DeckSummary& summary, KeywordDeck& out) {
  const double end = deck_unit::kTime * summary.duration;
  const double step = deck_unit::kTime * summary.step;
  out.keyword("*CONTROL_UNITS");
  out.names({"length", "time", "mass"});
  out.card({"mm", "ms", "kg"});
  out.keyword("*CONTROL_TERMINATION");
  out.names({"endtim"});
  out.card({end});
  out.remark(fmt::format("Step of this program: {:.4e} ms.", step));
  const std::int64_t curve = ++deck.numbers.curve;
  out.keyword("*DEFINE_CURVE");
  out.names({"lcid"});
  out.card({curve});
  out.names(kCurveCard, {"time", "largest_step"});
  out.card(kCurveCard, {0.0, step});
  out.card(kCurveCard, {2 * end, step});
  out.keyword("*CONTROL_TIMESTEP");
  out.names({"dtinit", "tssfac", "isdo", "tslimt", "dt2ms", "lctm"});
  out.card({step, summary.step_factor, 0, 0.0, -1e-6 * step, curve});
  if (deck.options().reader != DeckReader::ls_dyna || !deck.model().wheelset) return;
  out.remark("Stress update of second order: one of first order strains a wheel that turns.");
  out.keyword("*CONTROL_ACCURACY");
  out.names({"osu"});
  out.card({1});
}

void write_output(const DeckModel& deck, KeywordDeck& out) {
  const OutputSpec& output = deck.scene().output;
  const double interval = deck_unit::kTime * output.history_interval;
  for (const char* keyword :
       {"*DATABASE_GLSTAT", "*DATABASE_MATSUM", "*DATABASE_RCFORC", "*DATABASE_DEFORC"}) {
    out.keyword(keyword);
    out.names({"dt"});
    out.card({interval});
  }
  if (deck.model().hammer) {
    out.remark("Displacements about the struck point.");
    out.keyword("*DATABASE_NODOUT");
    out.names({"dt"});
    out.card({interval});
    out.keyword("*DATABASE_HISTORY_NODE");
    std::vector<std::int64_t> struck;
    deck.for_each_node_of(*deck.model().hammer,
                          [&](std::int64_t node, double /*weight*/) { struck.push_back(node); });
    out.list(struck);
  }
  out.keyword("*DATABASE_BINARY_D3PLOT");
  out.names({"dt"});
  out.card({deck_unit::kTime * deck.duration() / std::max(output.frames, 1)});
}

}  // namespace

DeckSummary write_keyword_deck(const Model& model, const DeckOptions& options, const std::string& origin,
                               KeywordDeck& out) {
  require_deck_can_hold(model, options);
  TREAD_EXPECT(!model.wheelset || options.preload || model.scene.start() == "rigid");
  const StepLimit limit = step_limit(model);
  const double safety = model.scene.motion->step_safety;
  DeckSummary summary;
  summary.step = safety * limit.stable_step;
  DeckModel deck(model, options, summary.step);
  summary.nodes = deck.numbers.node;
  summary.elements = model.elements();
  if (std::max(2 * summary.nodes, 2 * summary.elements) > kLargestDeckNumber)
    throw InputError(fmt::format(
        "the mesh has {} nodes and {} elements: a keyword deck numbers up to {}; make the elements larger",
        summary.nodes, summary.elements, kLargestDeckNumber));
  for (const double mass : model.mass) summary.mass += mass;
  summary.step_factor =
      safety * std::min(1.0, limit.stable_step / limit.stiffest[limit.stiffest_block()].step);
  summary.duration = deck.duration();
  summary.differences = deck_differences(model, options, summary.step);

  write_head(deck, summary, origin, out);
  write_control(deck, summary, out);
  write_output(deck, out);
  write_bodies(deck, out);
  write_ties(deck, out);
  DiscreteParts discrete(deck, out);
  add_springs(deck, discrete, out);
  write_vehicle(deck, discrete, out);
  summary.discrete_elements = discrete.write();
  write_contact(deck, out);
  write_restraints(deck, out);
  write_loads(deck, out);
  if (!deck.preloaded()) {
    write_velocities(deck, out);
  } else if (deck.options().radioss_cards()) {
    deck.radioss.references = references(deck);
    deck.radioss.velocities = node_velocities(deck);
  } else {
    write_stresses(deck, out);
    write_node_velocities(deck, out);
  }
  write_part_sets(deck, out);
  out.keyword("*END");
  out.finish();
  summary.radioss = std::move(deck.radioss);
  return summary;
}

}  // namespace tread
