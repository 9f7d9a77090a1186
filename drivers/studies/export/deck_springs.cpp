#include "drivers/studies/export/deck_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "drivers/studies/export/deck_surfaces.hpp"
#include "drivers/studies/export/deck_units.hpp"

namespace tread {

void DiscreteParts::add(std::int64_t first, std::int64_t second, const DeckSpring& spring) {
  if (spring.stiffness > 0)
    elements_.push_back(
        {part_of(deck_unit::kStiffness * spring.stiffness, false), first, second, spring.component});
  if (spring.damping > 0)
    elements_.push_back(
        {part_of(deck_unit::kDamping * spring.damping, true), first, second, spring.component});
}

std::int64_t DiscreteParts::part_of(double value, bool damper) {
  constexpr double kSame = 1e-8;  // the last digit of a card
  for (const Part& part : parts_)
    if (part.damper == damper && std::abs(part.value - value) <= kSame * value) return part.number;
  parts_.push_back({++deck_->numbers.part, value, damper});
  return parts_.back().number;
}

std::int64_t DiscreteParts::write() {
  if (elements_.empty()) return 0;
  KeywordDeck& out = *out_;
  out.remark("Spring-dampers: fastenings, bed, foot holds, suspension.");
  for (const int direction : {0, 1, 2}) {
    out.keyword("*DEFINE_SD_ORIENTATION");
    out.names({"vid", "iop", "xt", "yt", "zt"});
    out.card({direction + 1, 0, direction == 0 ? 1.0 : 0.0, direction == 1 ? 1.0 : 0.0,
              direction == 2 ? 1.0 : 0.0});
  }
  for (const Part& part : parts_) {
    // A section of its own: OpenRadioss makes section and material one property.
    const std::int64_t section = ++deck_->numbers.section;
    const std::int64_t material = ++deck_->numbers.material;
    out.keyword("*SECTION_DISCRETE");
    out.names({"secid", "dro"});
    out.card({section, 0});
    out.names({"cdl", "tdl"});
    out.card({0.0, 0.0});
    out.keyword(part.damper ? "*MAT_DAMPER_VISCOUS" : "*MAT_SPRING_ELASTIC");
    out.names({"mid", part.damper ? "dc" : "k"});
    out.card({material, part.value});
    out.keyword("*PART");
    out.title(part.damper ? fmt::format("damper of {:.6g} kN ms/mm", part.value)
                          : fmt::format("spring of {:.6g} kN/mm", part.value));
    out.names({"pid", "secid", "mid"});
    out.card({part.number, section, material});
  }
  out.keyword("*ELEMENT_DISCRETE");
  out.names(kEightsCard, {"eid", "pid", "n1", "n2", "vid"});
  for (const Element& element : elements_)
    out.card(kEightsCard,
             {++deck_->numbers.element, element.part, element.first, element.second, element.component + 1});
  return static_cast<std::int64_t>(elements_.size());
}

namespace {

/// The ends of the model's spring-dampers: each point of a face, or of the ground below it, has one node.
/// Both ends of an element share a place. OpenRadioss gives an element with a length a mass of 1e-12 kg/mm,
/// by which its damper alone would bound the step; one without a length uses the masses of its nodes.
class SpringEnds {
 public:
  explicit SpringEnds(DeckModel& deck) : deck_(deck) {}

  /// Adds the ends of a spring-damper and returns their nodes, the upper one first.
  std::pair<std::int64_t, std::int64_t> add(const SpringDampers::Element& element, const DeckSpring& spring) {
    End& upper = on_face(element.upper, nullptr);
    End& lower = grounded(element.lower) ? on_ground(upper) : on_face(element.lower, &upper.at);
    for (End* end : {&upper, &lower}) end->mass += spring.end_mass(deck_.step);
    const double pull = element.load(element.stretch(deck_.displacement()), 0);
    upper.force[spring.component] -= pull;
    lower.force[spring.component] += pull;
    return {upper.node, lower.node};
  }

  void write(KeywordDeck& out) {
    out.remark("Ends of the spring-dampers on faces and on the ground.");
    out.keyword("*NODE");
    out.names(kNodeCard, {"nid", "x", "y", "z"});
    for_each_end([&](const End& end) {
      const Vec3 at = deck_unit::kLength * end.at;
      out.card(kNodeCard, {end.node, at.x, at.y, at.z});
    });
    out.keyword("*ELEMENT_MASS");
    out.names(kMassCard, {"eid", "nid", "mass"});
    for_each_end([&](const End& end) { out.card(kMassCard, {++deck_.numbers.element, end.node, end.mass}); });
    for (const auto& [point, end] : points_) deck_.spring_forces.emplace_back(end.node, end.force);
    write_ties(out);
  }

 private:
  using Point = std::pair<std::array<std::int64_t, 4>, std::array<double, 4>>;
  struct End {
    std::int64_t node = 0;
    Vec3 at;              ///< [m]
    double distance = 0;  ///< from its face [m]
    double mass = 0;      ///< [kg]
    Vec3 force;           ///< of its springs at t = 0 [N]
  };

  static bool grounded(const Attachment& point) {
    return std::all_of(point.slot.begin(), point.slot.end(), [](std::int64_t slot) { return slot < 0; });
  }

  /// The end at a point of a face, or at `place` beside it.
  End& on_face(const Attachment& point, const Vec3* place) {
    const auto [known, added] = points_.try_emplace({point.slot, point.weight}, End{});
    if (added) {
      Vec3 at;
      deck_.for_each_node_of(point,
                             [&](std::int64_t node, double weight) { at += weight * deck_.place(node); });
      known->second.node = ++deck_.numbers.node;
      known->second.at = place ? *place : at;
      known->second.distance = norm(known->second.at - at);
    }
    return known->second;
  }

  /// The end on the ground below another one.
  End& on_ground(const End& above) {
    constexpr int kAllDirections = 1 + 2 + 4;
    const auto [known, added] = ground_.try_emplace(above.node, End{});
    if (added) {
      known->second.node = ++deck_.numbers.node;
      known->second.at = above.at;
      deck_.held[kAllDirections].push_back(known->second.node);
    }
    return known->second;
  }

  template <class Visit>
  void for_each_end(const Visit& visit) const {
    for (const auto& [point, end] : points_) visit(end);
    for (const auto& [above, end] : ground_) visit(end);
  }

  /// One tie for each block: surfaces of two blocks may lie upon one another.
  void write_ties(KeywordDeck& out) {
    struct Tie {
      std::vector<std::int64_t> nodes;
      std::set<DeckFace> faces;
      double distance = 0;  ///< largest of a node from its face [m]
    };
    std::map<const SweptBlock*, Tie> ties;
    for (const auto& [point, end] : points_) {
      Tie& tie = ties[&block_of(point.first[0])];
      tie.nodes.push_back(end.node);
      tie.distance = std::max(tie.distance, end.distance);
      // Nodes of an attachment stand row by row; those of a face follow its border.
      const auto corner = [&, &slots = point.first](std::size_t k) { return deck_.node(slots[k]); };
      tie.faces.insert({corner(0), corner(1), corner(3), corner(2)});
    }
    for (const auto& [block, tie] : ties) {
      ContactSides sides;
      sides.secondary = write_node_set(deck_, tie.nodes, out);
      sides.secondary_kind = ContactSides::kNodes;
      sides.primary = write_segment_set(deck_, {tie.faces.begin(), tie.faces.end()}, out);
      write_tie_contact(deck_, "spring-dampers to " + block->name, sides, tie.distance, out);
    }
  }

  const SweptBlock& block_of(std::int64_t slot) const {
    const std::vector<SweptBlock>& blocks = deck_.model().mesh.blocks;
    const auto after =
        std::upper_bound(blocks.begin(), blocks.end(), slot,
                         [](std::int64_t at, const SweptBlock& block) { return at < block.base; });
    return *(after - 1);
  }

  DeckModel& deck_;
  std::map<Point, End> points_;
  std::map<std::int64_t, End> ground_;  ///< by the node above
};

}  // namespace

void add_springs(DeckModel& deck, DiscreteParts& parts, KeywordDeck& out) {
  if (!deck.model().fastenings) return;
  SpringEnds ends(deck);
  for (const SpringDampers::Element& element : deck.model().fastenings->elements()) {
    if (element.stiffness == 0 && element.damping == 0) continue;  // broken: its ends would have no mass
    const DeckSpring spring{element.component, element.stiffness, element.damping};
    const auto [upper, lower] = ends.add(element, spring);
    parts.add(upper, lower, spring);
  }
  ends.write(out);
}

}  // namespace tread
