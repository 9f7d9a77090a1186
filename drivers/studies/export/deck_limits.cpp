#include "drivers/studies/export/deck_limits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "drivers/studies/export/deck_springs.hpp"
#include "drivers/studies/export/deck_vehicle.hpp"

namespace tread {

namespace {

/// A deck has cards for these laws; OpenRadioss takes places free of stress for elastic parts alone.
void require_known_laws(const Model& model, const DeckOptions& options) {
  for (const SweptBlock& block : model.mesh.blocks)
    for (const Material& material : block.materials) {
      if (material.law != "elastic" && material.law != "j2")
        throw InputError(
            fmt::format("material.{}.law = \"{}\": no card is written for it; state \"elastic\" or \"j2\"",
                        material.name, material.law));
      if (options.radioss_cards() && material.law != "elastic")
        throw InputError(
            fmt::format("--preload: material.{}.law = \"{}\", and OpenRadioss has no static state for it; "
                        "leave out --preload, "
                        "or state --for ls-dyna",
                        material.name, material.law));
    }
}

/// A deck's friction is one coefficient, or falls with the slip speed.
void require_known_friction(const ContactSpec& contact) {
  if (contact.friction_law == "coulomb" || contact.friction_law == "falling") return;
  throw InputError(fmt::format(
      "contact.friction_law = \"{}\": a keyword deck holds one coefficient, or one that falls with "
      "the slip speed; set contact.friction_law = \"coulomb\" or \"falling\"",
      contact.friction_law));
}

/// An overlap pushes only where a contact takes it as it finds it.
void require_useful_overlap(const Model& model, const DeckOptions& options) {
  if (options.overlap == 0) return;
  if (!model.contact) throw InputError("--overlap: the scene has no wheel on a rail; leave it out");
  if (options.reader == DeckReader::ls_dyna)
    throw InputError(
        "--overlap: LS-DYNA moves overlapping nodes to the surface at t = 0, and they do not push; leave it "
        "out, or state --for openradioss");
}

}  // namespace

void require_deck_can_hold(const Model& model, const DeckOptions& options) {
  const Scene& scene = model.scene;
  require_known_laws(model, options);
  require_useful_overlap(model, options);
  if (!scene.motion)
    throw InputError(
        "[motion] is missing: a keyword deck needs a time to end; add motion.duration, or set "
        "motion.present = true");
  if (!scene.bodies.empty())
    throw InputError(
        fmt::format("body.{}: its mesh is another program's already, and is not written again; state "
                    "body.{}.present = false",
                    scene.bodies.begin()->first, scene.bodies.begin()->first));
  if (model.guide)
    throw InputError(
        "wheel.bore = \"guided\": a keyword deck has no carrier that turns freely and rolls at a stated "
        "speed; set wheel.bore = \"free\"");
  if (!scene.surfaces.empty())
    throw InputError(
        fmt::format("surface.{}: a keyword deck states the surface by its nodes alone, and these depths lie "
                    "in the contact gap; "
                    "state surface.{}.present = false",
                    scene.surfaces.begin()->first, scene.surfaces.begin()->first));
  if (scene.corrugation && scene.corrugation->apply == "gap")
    throw InputError(
        "corrugation.apply = \"gap\": a keyword deck states the surface by its nodes alone; set "
        "corrugation.apply = \"nodes\"");
  if (scene.vehicle && scene.vehicle->unsprung_mass <= 0)
    throw InputError(
        "vehicle.unsprung_mass = 0: the axle box of a keyword deck needs a mass; state at least 1 kg");
  if (scene.contact) require_known_friction(*scene.contact);
}

namespace {

class Differences {
 public:
  Differences(const Model& model, const DeckOptions& options, double step)
      : model_(model), options_(options), step_(step) {}

  std::vector<std::string> list() {
    add_element();
    add_damping();
    if (!model_.tie_specs.empty())
      add(options_.radioss_cards()
              ? "Ties: nodes of the fine side follow the faces of the coarse side; no mass is added."
              : "Ties: the reader's own; nodes of the fine side follow the faces of the coarse side. "
                "That of OpenRadioss (Spotflag 28) adds mass to those faces.");
    add_springs();
    if (model_.wheelset || model_.scene.gravity != 0) add_preload();
    if (model_.contact) add_contact();
    if (model_.wheelset) add_wheel();
    add_output();
    return std::move(list_);
  }

 private:
  void add(std::string sentence) { list_.push_back(std::move(sentence)); }

  void add_element() {
    add(options_.reader == DeckReader::openradioss
            ? "Element: one stress point. Without a card *HOURGLASS, OpenRadioss takes its Isolid 24, whose "
              "physical hourglass stiffness is the nearest; types 1 to 5 would select another. Its bulk "
              "viscosity (0.05 and 1.1) stays."
            : "Element: one stress point with the hourglass stiffness of type 6, QM = 1 (Belytschko and "
              "Bindeman), the nearest. Tiny Q1 and Q2 switch its bulk viscosity off, as here.");
    const bool held = std::any_of(model_.mesh.blocks.begin(), model_.mesh.blocks.end(),
                                  [](const SweptBlock& block) { return block.vertical_only; });
    if (held) add("Slab: held along and across at every node, as here.");
    for (const auto& [name, material] : model_.scene.materials)
      if (material.law == "j2")
        add(fmt::format("Material {}: *MAT_PLASTIC_KINEMATIC with the same hardening.", name));
  }

  void add_damping() {
    for (std::size_t b = 0; b < model_.mesh.blocks.size(); ++b) {
      const SweptBlock& block = model_.mesh.blocks[b];
      if (model_.branches[b]) {
        add(fmt::format("Damping of {}: left out. damping_up_to has no card.", block.name));
      } else if (model_.beta[b] > 0 && !damped_) {
        damped_ = true;
        add("Damping: proportional to stiffness, as a negative COEF (Rayleigh's, in ms). OpenRadioss reads a "
            "positive one as zero. Its step knows no damping: TSSFAC lowers it where the step here is "
            "shorter "
            "than the stiffest element's.");
      }
    }
  }

  void add_springs() {
    if (!model_.fastenings) return;
    double mass = 0;
    std::int64_t elements = 0;
    for (const SpringDampers::Element& element : model_.fastenings->elements()) {
      const DeckSpring spring{element.component, element.stiffness, element.damping};
      elements += spring.elements();
      mass += 2 * spring.end_mass(step_);
    }
    add(fmt::format(
        "Fastenings and bed: {} discrete elements, whose ends are nodes tied to the faces or held. The nodes "
        "have {:.3g} kg together, by which they are stable at the step of this program.",
        elements, mass));
  }

  void add_preload() {
    if (options_.preload) {
      add(
          fmt::format("Start: the static state of the scene, by places, velocities, {}, forces of springs "
                      "and nodal loads for "
                      "the hourglass forces; loads on the wheel turn with it.",
                      options_.radioss_cards() ? "places free of stress" : "stresses"));
      return;
    }
    const std::string touching = !model_.contact ? ""
                                 : options_.overlap != 0
                                     ? fmt::format(" and overlap by {:.4g} um", 1e6 * options_.overlap)
                                     : " and just touch";
    add(fmt::format(
        "Preload: none. The bodies are undeformed{}; gravity and static loads {}. The deck settles by "
        "itself while it runs.",
        touching,
        options_.ramp > 0 ? fmt::format("grow over {:.4g} ms", 1e3 * options_.ramp)
                          : std::string("act in full from t = 0")));
  }

  void add_contact() {
    const Scene& scene = model_.scene;
    if (scene.contact->surface == "exact")
      add("Contact surfaces: the faces of the elements. Here contact uses the curves of the profiles.");
    add(options_.radioss_cards()
            ? "Contact stiffness: four times the reader's own. Overlap at the start pushes; --overlap "
              "deepens it until F_N is that of the static state."
            : "Contact stiffness: the reader's own.");
    if (options_.preload && options_.reader == DeckReader::ls_dyna)
      add("Contact at t = 0: without force. LS-DYNA moves overlapping nodes to the surface; F_N builds up "
          "while the deck runs.");
    if (scene.contact->friction_law == "falling" && scene.contact->friction_memory > 0)
      add("contact.friction_memory: left out.");
    if (scene.corrugation && !scene.corrugation->centre)
      add("Corrugation: its deepest line is where the undeformed profiles touch. Here it is where the static "
          "pressure is largest.");
  }

  void add_wheel() {
    if (!options_.preload)
      add("Motion at t = 0: the wheel rolls rigidly without creepage other than motion.creepage.");
    if (model_.scene.vehicle)
      add(fmt::format(
          "Axle box: held across, and in the middle of the journal by spokes of {:.0f} Hz. Here the "
          "journal's mean motion carries it rigidly.",
          kSpokeFrequency));
    if (model_.scene.vehicle && model_.scene.vehicle->longitudinal == "carried")
      add(fmt::format(
          "Sprung mass: pulled along by a link of {:.0f} Hz. Here the journal carries it rigidly.",
          kLinkFrequency));
  }

  void add_output() {
    std::string left_out;
    const auto name = [&](bool there, const char* table) {
      if (there) left_out += (left_out.empty() ? "" : ", ") + std::string(table);
    };
    name(!model_.scene.probes.empty(), "[probe]");
    name(model_.scene.wear.has_value(), "[wear]");
    name(model_.scene.forks.has_value(), "[forks]");
    name(model_.scene.stop.steps > 0 || model_.scene.stop.wall_time || model_.scene.stop.penetration,
         "[stop]");
    if (!left_out.empty()) add(fmt::format("Left out: {}.", left_out));
  }

  const Model& model_;
  DeckOptions options_;
  double step_;  ///< of this program [s]
  bool damped_ = false;
  std::vector<std::string> list_;
};

}  // namespace

std::vector<std::string> deck_differences(const Model& model, const DeckOptions& options, double step) {
  return Differences(model, options, step).list();
}

}  // namespace tread
