#include "drivers/studies/export/deck_springs.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "drivers/studies/export/deck_units.hpp"

namespace tread {

namespace {

/// Calls visit(slot, weight) for the nodes of a point; the ground is slot -1 with the weight 1.
template <class Visit>
void for_each_node_of(const Attachment& point, const Visit& visit) {
  bool ground = true;
  for (std::size_t k = 0; k < point.slot.size(); ++k) {
    if (point.slot[k] < 0) continue;
    ground = false;
    if (point.weight[k] > 0) visit(point.slot[k], point.weight[k]);
  }
  if (ground) visit(std::int64_t{-1}, 1.0);
}

}  // namespace

std::vector<DeckSpring> deck_springs(const Model& model) {
  std::map<std::tuple<std::int64_t, std::int64_t, int>, DeckSpring> all;
  if (!model.fastenings) return {};
  for (const SpringDampers::Element& element : model.fastenings->elements())
    for_each_node_of(element.upper, [&](std::int64_t upper, double upper_weight) {
      for_each_node_of(element.lower, [&](std::int64_t lower, double lower_weight) {
        DeckSpring& spring = all[{upper, lower, element.component}];
        spring.upper = upper;
        spring.lower = lower;
        spring.component = element.component;
        spring.stiffness += upper_weight * lower_weight * element.stiffness;
        spring.damping += upper_weight * lower_weight * element.damping;
      });
    });
  std::vector<DeckSpring> springs;
  springs.reserve(all.size());
  for (const auto& [nodes, spring] : all) springs.push_back(spring);
  return springs;
}

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
  out.keyword("*DEFINE_SD_ORIENTATION");
  out.names({"vid", "iop", "xt", "yt", "zt"});
  for (const int direction : {0, 1, 2})
    out.card({direction + 1, 0, direction == 0 ? 1.0 : 0.0, direction == 1 ? 1.0 : 0.0,
              direction == 2 ? 1.0 : 0.0});
  out.keyword("*SECTION_DISCRETE");
  const std::int64_t section = ++deck_->numbers.section;
  out.names({"secid", "dro"});
  out.card({section, 0});
  out.names({"cdl", "tdl"});
  out.card({0.0, 0.0});
  for (const Part& part : parts_) {
    const std::int64_t material = ++deck_->numbers.material;
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

void add_springs(DeckModel& deck, DiscreteParts& parts, KeywordDeck& out) {
  constexpr int kAllDirections = 1 + 2 + 4;
  std::map<std::int64_t, std::int64_t> ground;  // number of the ground's node by that of the node above
  const std::vector<DeckSpring> springs = deck_springs(deck.model());
  for (const DeckSpring& spring : springs) {
    const std::int64_t upper = deck.node(spring.upper);
    if (spring.lower < 0 && ground.count(upper) == 0) {
      ground[upper] = ++deck.numbers.node;
      deck.held[kAllDirections].push_back(ground[upper]);
    }
    parts.add(upper, spring.lower < 0 ? ground[upper] : deck.node(spring.lower), spring);
  }
  if (ground.empty()) return;
  out.remark("Ground under the spring-dampers.");
  out.keyword("*NODE");
  out.names(kNodeCard, {"nid", "x", "y", "z"});
  for (const auto& [above, node] : ground) {
    const Vec3 at = deck_unit::kLength * deck.place(above);
    out.card(kNodeCard, {node, at.x, at.y, at.z});
  }
}

}  // namespace tread
