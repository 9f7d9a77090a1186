#include "drivers/studies/export/deck_surfaces.hpp"

#include <fmt/format.h>

#include <utility>

#include "drivers/studies/export/deck_units.hpp"

namespace tread {

namespace {

using Edges = std::vector<std::pair<int, int>>;  // section nodes, by increasing p

const SweptBlock& block_of(const DeckModel& deck, int index) {
  return deck.model().mesh.blocks[static_cast<std::size_t>(index)];
}

Edges edges_of(const std::vector<int>& path) {
  Edges edges;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) edges.emplace_back(path[i], path[i + 1]);
  return edges;
}

Edges running_surface(const SweptBlock& block) {
  Edges edges;
  for (const SurfaceEdge& edge : block.section.surface) edges.emplace_back(edge.node[0], edge.node[1]);
  return edges;
}

/// The faces over these edges, which have the body below them (smaller q): normals point outwards.
std::vector<DeckFace> faces_over(const DeckModel& deck, const SweptBlock& block, const Edges& edges) {
  std::vector<DeckFace> faces;
  for_each_pitch(block, [&](int near, int far) {
    for (const auto& [from, to] : edges)
      faces.push_back({deck.node(block, from, near), deck.node(block, from, far), deck.node(block, to, far),
                       deck.node(block, to, near)});
  });
  return faces;
}

std::vector<std::int64_t> nodes_of(const DeckModel& deck, const SweptBlock& block,
                                   const std::vector<int>& path) {
  std::vector<std::int64_t> nodes;
  for (int station = 0; station < block.station_count(); ++station)
    for (const int node : path) nodes.push_back(deck.node(block, node, station));
  return nodes;
}

void begin_contact(DeckModel& deck, const char* keyword, const std::string& title, const ContactSides& sides,
                   KeywordDeck& out) {
  out.keyword(keyword);
  constexpr std::array<int, 2> kHead = {10, 60};
  const std::string shown = " " + title.substr(0, 59);
  out.card(kHead, {++deck.numbers.contact, std::string_view(shown)});
  out.names({"ssid", "msid", "sstyp", "mstyp"});
  out.card({sides.secondary, sides.primary, sides.secondary_kind, sides.primary_kind});
}

}  // namespace

std::int64_t write_node_set(DeckModel& deck, std::span<const std::int64_t> nodes, KeywordDeck& out) {
  const std::int64_t set = ++deck.numbers.set;
  out.keyword("*SET_NODE_LIST");
  out.names({"sid"});
  out.card({set});
  out.list(nodes);
  return set;
}

std::int64_t write_segment_set(DeckModel& deck, const std::vector<DeckFace>& faces, KeywordDeck& out) {
  const std::int64_t set = ++deck.numbers.set;
  out.keyword("*SET_SEGMENT");
  out.names({"sid"});
  out.card({set});
  out.names({"n1", "n2", "n3", "n4"});
  for (const DeckFace& face : faces) out.list(face);
  return set;
}

void write_tie_contact(DeckModel& deck, const std::string& title, const ContactSides& sides, double distance,
                       KeywordDeck& out) {
  // A negative thickness is a distance up to which nodes are tied. [mm]
  const double reach = -(0.1 + deck_unit::kLength * distance);
  if (deck.options().radioss_cards()) {
    deck.radioss.ties.push_back({"tie of " + title, sides.secondary, sides.primary, -reach});
    return;
  }
  begin_contact(deck, "*CONTACT_TIED_NODES_TO_SURFACE_ID", "tie of " + title, sides, out);
  out.names({"fs", "fd"});
  out.card({0.0, 0.0});
  out.names({"sfs", "sfm", "sst", "mst"});
  out.card({0.0, 0.0, reach, reach});
}

void write_ties(DeckModel& deck, KeywordDeck& out) {
  for (const TieSpec& tie : deck.model().tie_specs) {
    const SweptBlock& fine = block_of(deck, tie.secondary);
    const SweptBlock& coarse = block_of(deck, tie.primary);
    const std::string title = fmt::format("{} to {}", fine.name, coarse.name);
    out.remark(fmt::format("Tie of {}.", title));
    ContactSides sides;
    sides.secondary =
        write_node_set(deck, nodes_of(deck, fine, fine.section.paths.at(tie.secondary_path)), out);
    sides.secondary_kind = ContactSides::kNodes;
    const Edges edges = edges_of(coarse.section.paths.at(tie.primary_path));
    sides.primary = write_segment_set(deck, faces_over(deck, coarse, edges), out);
    write_tie_contact(deck, title, sides, 0, out);
  }
}

void write_part_sets(DeckModel& deck, KeywordDeck& out) {
  const BlockIndex& index = deck.model().index;
  const auto write = [&](int part, const char* path, const char* title) {
    if (part < 0) return;
    const SweptBlock& block = block_of(deck, part);
    const auto found = block.section.paths.find(path);
    if (found == block.section.paths.end()) return;
    out.keyword("*SET_NODE_LIST_TITLE");
    out.title(title);
    out.names({"sid"});
    out.card({++deck.numbers.set});
    out.list(nodes_of(deck, block, found->second));
  };
  if (index.disc < 0 && index.rail_base < 0) return;
  out.remark("Sets by which tread ties parts of this deck as bodies from a file; no card uses them.");
  const Vec3 axle = deck_unit::kLength * deck.wheel().origin;
  if (index.disc >= 0) out.remark(fmt::format("The axle lies at x = {:.12g}, z = {:.12g}.", axle.x, axle.z));
  write(index.disc, "tie_outer", "disc on tread");
  write(index.disc, "tie_inner", "disc on axle");
  write(index.rail_base, "tie", "rail under head");
  write(index.rail_base, "foot", "rail on fastenings");
}

void write_contact(DeckModel& deck, KeywordDeck& out) {
  if (!deck.model().contact) return;
  const ContactSpec& spec = *deck.scene().contact;
  const SweptBlock& wheel = block_of(deck, deck.model().index.tread);
  const SweptBlock& rail = block_of(deck, deck.model().index.rail_cap);
  out.remark("Contact of wheel (secondary) and rail (primary).");
  ContactSides sides;
  sides.secondary = write_segment_set(deck, faces_over(deck, wheel, running_surface(wheel)), out);
  sides.primary = write_segment_set(deck, faces_over(deck, rail, running_surface(rail)), out);
  // f = FD + (FS - FD) exp(-DC |v|)
  const bool falls = spec.friction_law == "falling";
  const double fast = falls ? spec.friction_fast : spec.friction;
  const double decay = falls ? 1 / spec.friction_speed : 0.0;  // s/m = ms/mm
  if (deck.options().radioss_cards()) {
    deck.radioss.contacts.push_back(
        {"wheel on rail", sides.secondary, sides.primary, fast, spec.friction - fast, decay});
    return;
  }
  begin_contact(deck, "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID", "wheel on rail", sides, out);
  out.names({"fs", "fd", "dc"});
  out.card({spec.friction, fast, decay});
  out.names({"sfs", "sfm"});
  out.card({1.0, 1.0});
}

}  // namespace tread
