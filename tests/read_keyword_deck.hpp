#pragma once
// A small reader of keyword decks: it knows the cards that the program writes, and no others.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace tread::samples {

/// A deck in its own units: mm, ms, kg, kN, GPa.
struct ReadDeck {
  using Card = std::vector<std::string>;
  struct Solid {
    std::int64_t part = 0;
    std::array<std::int64_t, 8> nodes = {};
  };
  struct Contact {
    std::string keyword;
    std::int64_t secondary = 0, primary = 0;
    int secondary_kind = 0, primary_kind = 0;
    double friction = 0;       ///< of fast slip
    double slow_friction = 0;  ///< without slip
    double decay = 0;          ///< [ms/mm]
    double reach = 0;          ///< of a tie [mm]
  };
  struct Load {
    std::int64_t node = 0, curve = 0;
    double value = 0;
    int axis = 2;
    bool turns = false;  ///< with the plane of three nodes; otherwise along an axis of the deck
    std::array<std::int64_t, 3> plane = {};
  };

  std::map<std::string, int> keywords;  ///< how often each occurs
  std::map<std::int64_t, Vec3> nodes, velocities;
  std::map<std::int64_t, std::array<double, 6>> stresses;  ///< xx, yy, zz, xy, yz, zx
  std::map<std::int64_t, Solid> solids;
  std::map<std::int64_t, Card> parts, sections, materials, hourglass, discretes,
      masses;                              ///< fields by number
  std::map<std::int64_t, double> damping;  ///< by part
  std::map<std::int64_t, std::vector<std::int64_t>> node_sets;
  std::map<std::string, std::vector<std::int64_t>> titled_sets;  ///< node sets, by title
  std::map<std::int64_t, std::vector<std::array<std::int64_t, 4>>> segment_sets;
  std::map<std::int64_t, std::vector<std::array<double, 2>>> curves;
  std::map<std::int64_t, Vec3> orientations;
  std::map<std::int64_t, std::array<std::int64_t, 3>> coordinates;  ///< nodes that they turn with
  std::vector<Card> held;                                           ///< of *BOUNDARY_SPC_SET
  std::vector<Contact> contacts;
  std::vector<Load> loads;
  Card time_step;                  ///< of *CONTROL_TIMESTEP
  Card accuracy;                   ///< of *CONTROL_ACCURACY
  std::set<std::int64_t> watched;  ///< nodes whose histories are written
  double gravity = 0, end = 0;
};

inline std::int64_t whole(const std::string& field) {
  return field.empty() ? 0 : std::stoll(field);
}
inline double real(const std::string& field) {
  return field.empty() ? 0 : std::stod(field);
}

class DeckParser {
 public:
  ReadDeck read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 80U) << line;
      if (line.starts_with('$')) continue;
      if (line.starts_with('*')) {
        finish();
        keyword_ = line;
        ++deck_.keywords[line];
      } else {
        cards_.push_back(line);
      }
    }
    EXPECT_EQ(keyword_, "*END");
    return std::move(deck_);
  }

 private:
  /// Fields of a card: `first` of one width, the others of another.
  static ReadDeck::Card fields(const std::string& line, std::size_t first, std::size_t count,
                               std::size_t others) {
    ReadDeck::Card found;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t width = found.size() < count ? first : others;
      std::string field = line.substr(at, width);
      field.erase(0, field.find_first_not_of(' '));
      field.erase(field.find_last_not_of(' ') + 1);
      found.push_back(field);
      at += width;
    }
    found.resize(std::max<std::size_t>(found.size(), 8));
    return found;
  }
  static ReadDeck::Card tens(const std::string& line) { return fields(line, 10, 8, 10); }
  static ReadDeck::Card eights(const std::string& line) { return fields(line, 8, 10, 8); }

  template <class Table, class Value>
  static void add_new(Table& table, std::int64_t number, Value value) {
    EXPECT_GT(number, 0);
    EXPECT_TRUE(table.emplace(number, std::move(value)).second) << "twice: " << number;
  }

  void finish() {
    if (keyword_.empty() || keyword_ == "*KEYWORD") return;
    if (!read_mesh() && !read_tables() && !read_motion() && !keyword_.starts_with("*DATABASE_") &&
        !keyword_.starts_with("*CONTROL_") && keyword_ != "*TITLE")
      ADD_FAILURE() << "unknown keyword " << keyword_;
    if (keyword_ == "*CONTROL_TERMINATION") deck_.end = real(tens(cards_.at(0))[0]);
    if (keyword_ == "*CONTROL_TIMESTEP") deck_.time_step = tens(cards_.at(0));
    if (keyword_ == "*CONTROL_ACCURACY") deck_.accuracy = tens(cards_.at(0));
    if (keyword_ == "*DATABASE_HISTORY_NODE")
      for (const std::string& field : tens(cards_.at(0)))
        if (!field.empty()) deck_.watched.insert(whole(field));
    cards_.clear();
  }

  bool read_mesh() {
    if (keyword_ == "*NODE") {
      for (const std::string& card : cards_) {
        const auto f = fields(card, 8, 1, 16);
        add_new(deck_.nodes, whole(f[0]), Vec3{real(f[1]), real(f[2]), real(f[3])});
      }
    } else if (keyword_ == "*ELEMENT_SOLID") {
      EXPECT_EQ(cards_.size() % 2, 0U);
      for (std::size_t i = 0; i + 1 < cards_.size(); i += 2) {
        const auto head = eights(cards_[i]);
        const auto corners = eights(cards_[i + 1]);
        ReadDeck::Solid solid{whole(head[1]), {}};
        for (std::size_t k = 0; k < 8; ++k) solid.nodes[k] = whole(corners[k]);
        add_new(deck_.solids, whole(head[0]), solid);
      }
    } else if (keyword_ == "*ELEMENT_DISCRETE" || keyword_ == "*ELEMENT_MASS") {
      const bool mass = keyword_ == "*ELEMENT_MASS";
      for (const std::string& card : cards_) {
        const auto f = mass ? fields(card, 8, 2, 16) : eights(card);
        add_new(mass ? deck_.masses : deck_.discretes, whole(f[0]), f);
      }
    } else {
      return false;
    }
    return true;
  }

  bool read_tables() {
    if (keyword_ == "*PART") {
      EXPECT_EQ(cards_.size(), 2U);
      const auto f = tens(cards_.at(1));
      add_new(deck_.parts, whole(f[0]), f);
    } else if (keyword_.starts_with("*SECTION_")) {
      add_new(deck_.sections, whole(tens(cards_.at(0))[0]), tens(cards_.at(0)));
    } else if (keyword_.starts_with("*MAT_")) {
      auto f = tens(cards_.at(0));
      f[0] += keyword_;
      add_new(deck_.materials, whole(f[0]), f);
    } else if (keyword_ == "*HOURGLASS") {
      add_new(deck_.hourglass, whole(tens(cards_.at(0))[0]), tens(cards_.at(0)));
    } else if (keyword_ == "*DAMPING_PART_STIFFNESS") {
      add_new(deck_.damping, whole(tens(cards_.at(0))[0]), real(tens(cards_.at(0))[1]));
    } else if (keyword_ == "*DEFINE_SD_ORIENTATION") {
      for (const std::string& card : cards_) {
        const auto f = tens(card);
        add_new(deck_.orientations, whole(f[0]), Vec3{real(f[2]), real(f[3]), real(f[4])});
      }
    } else if (keyword_ == "*DEFINE_COORDINATE_NODES") {
      const auto f = tens(cards_.at(0));
      EXPECT_EQ(f[4], "1");
      add_new(deck_.coordinates, whole(f[0]), std::array{whole(f[1]), whole(f[2]), whole(f[3])});
    } else if (keyword_ == "*DEFINE_CURVE") {
      std::vector<std::array<double, 2>> points;
      for (std::size_t i = 1; i < cards_.size(); ++i) {
        const auto f = fields(cards_[i], 20, 2, 20);
        points.push_back({real(f[0]), real(f[1])});
      }
      add_new(deck_.curves, whole(tens(cards_.at(0))[0]), points);
    } else if (keyword_ == "*SET_NODE_LIST" || keyword_ == "*SET_NODE_LIST_TITLE") {
      const std::size_t head = keyword_ == "*SET_NODE_LIST" ? 0 : 1;
      std::vector<std::int64_t> nodes;
      for (std::size_t i = head + 1; i < cards_.size(); ++i)
        for (const std::string& field : tens(cards_[i]))
          if (!field.empty()) nodes.push_back(whole(field));
      if (head > 0) deck_.titled_sets[cards_.at(0)] = nodes;
      add_new(deck_.node_sets, whole(tens(cards_.at(head))[0]), nodes);
    } else if (keyword_ == "*SET_SEGMENT") {
      std::vector<std::array<std::int64_t, 4>> faces;
      for (std::size_t i = 1; i < cards_.size(); ++i) {
        const auto f = tens(cards_[i]);
        faces.push_back({whole(f[0]), whole(f[1]), whole(f[2]), whole(f[3])});
      }
      add_new(deck_.segment_sets, whole(tens(cards_.at(0))[0]), faces);
    } else {
      return false;
    }
    return true;
  }

  bool read_motion() {
    if (keyword_ == "*BOUNDARY_SPC_SET") {
      deck_.held.push_back(tens(cards_.at(0)));
    } else if (keyword_.starts_with("*CONTACT_")) {
      EXPECT_EQ(cards_.size(), 4U);
      const auto sides = tens(cards_.at(1));
      const auto friction = tens(cards_.at(2));
      const auto scales = tens(cards_.at(3));
      deck_.contacts.push_back({keyword_, whole(sides[0]), whole(sides[1]), std::stoi(sides[2]),
                                std::stoi(sides[3]), real(friction[1]), real(friction[0]), real(friction[2]),
                                0.6 * std::abs(real(scales[2]) + real(scales[3]))});
    } else if (keyword_ == "*LOAD_NODE_POINT") {
      for (const std::string& card : cards_) {
        const auto f = tens(card);
        EXPECT_TRUE(f[1] == "1" || f[1] == "2" || f[1] == "3") << card;
        ReadDeck::Load load{whole(f[0]), whole(f[2]), real(f[3]), std::stoi(f[1]) - 1, whole(f[4]) > 0, {}};
        if (load.turns) load.plane = deck_.coordinates.at(whole(f[4]));
        deck_.loads.push_back(load);
      }
    } else if (keyword_ == "*LOAD_BODY_Z") {
      deck_.gravity = real(tens(cards_.at(0))[1]);
      EXPECT_EQ(deck_.curves.count(whole(tens(cards_.at(0))[0])), 1U);
    } else if (keyword_ == "*INITIAL_VELOCITY_NODE") {
      for (const std::string& card : cards_) {
        const auto f = tens(card);
        add_new(deck_.velocities, whole(f[0]), Vec3{real(f[1]), real(f[2]), real(f[3])});
      }
    } else if (keyword_ == "*INITIAL_STRESS_SOLID") {
      EXPECT_EQ(cards_.size() % 3, 0U);
      for (std::size_t i = 0; i + 2 < cards_.size(); i += 3) {
        const auto head = tens(cards_[i]);
        EXPECT_EQ(head[3], "1");  // fields of sixteen characters
        const auto first = fields(cards_[i + 1], 16, 5, 16);
        const auto second = fields(cards_[i + 2], 16, 2, 16);
        add_new(deck_.stresses, whole(head[0]),
                std::array{real(first[0]), real(first[1]), real(first[2]), real(first[3]), real(first[4]),
                           real(second[0])});
      }
    } else if (keyword_ == "*INITIAL_VELOCITY_GENERATION") {
      const auto f = tens(cards_.at(0));
      const auto axis = tens(cards_.at(1));
      EXPECT_EQ(f[1], "3");
      const Vec3 spin = real(f[2]) * Vec3{real(axis[3]), real(axis[4]), real(axis[5])};
      const Vec3 centre = {real(axis[0]), real(axis[1]), real(axis[2])};
      for (const std::int64_t node : deck_.node_sets.at(whole(f[0])))
        add_new(deck_.velocities, node,
                Vec3{real(f[3]), real(f[4]), real(f[5])} + cross(spin, deck_.nodes.at(node) - centre));
    } else {
      return false;
    }
    return true;
  }

  ReadDeck deck_;
  std::string keyword_;
  std::vector<std::string> cards_;
};

/// Expects that everything a card refers to is there, and that no node belongs to nothing.
inline void expect_whole(const ReadDeck& deck) {
  std::set<std::int64_t> used;
  const auto node = [&](std::int64_t number) {
    used.insert(number);
    ASSERT_EQ(deck.nodes.count(number), 1U) << "no node " << number;
  };
  for (const auto& [number, solid] : deck.solids) {
    EXPECT_EQ(deck.parts.count(solid.part), 1U);
    for (const std::int64_t corner : solid.nodes) node(corner);
  }
  for (const auto& [number, card] : deck.discretes) {
    EXPECT_EQ(deck.solids.count(number), 0U);
    EXPECT_EQ(deck.parts.count(whole(card[1])), 1U);
    EXPECT_EQ(deck.orientations.count(whole(card[4])), whole(card[4]) > 0 ? 1U : 0U);
    for (const std::size_t end : {2U, 3U}) node(whole(card[end]));
  }
  for (const auto& [number, card] : deck.masses) {
    EXPECT_EQ(deck.solids.count(number) + deck.discretes.count(number), 0U);
    node(whole(card[1]));
  }
  for (const auto& [number, card] : deck.parts) {
    EXPECT_EQ(deck.sections.count(whole(card[1])), 1U);
    EXPECT_EQ(deck.materials.count(whole(card[2])), 1U);
    EXPECT_EQ(deck.hourglass.count(whole(card[4])), whole(card[4]) > 0 ? 1U : 0U);
  }
  for (const auto& [part, value] : deck.damping) EXPECT_EQ(deck.parts.count(part), 1U);
  for (const auto& [number, nodes] : deck.node_sets) {
    EXPECT_EQ(deck.segment_sets.count(number), 0U) << "sets share the number " << number;
    EXPECT_FALSE(nodes.empty());
    for (const std::int64_t member : nodes) EXPECT_EQ(deck.nodes.count(member), 1U);
  }
  for (const auto& [number, faces] : deck.segment_sets) {
    EXPECT_FALSE(faces.empty());
    for (const auto& face : faces)
      for (const std::int64_t corner : face) EXPECT_EQ(deck.nodes.count(corner), 1U);
  }
  for (const ReadDeck::Card& card : deck.held) EXPECT_EQ(deck.node_sets.count(whole(card[0])), 1U);
  const auto has_set = [&](std::int64_t number, int kind) {
    return kind == 4 ? deck.node_sets.count(number) == 1 : deck.segment_sets.count(number) == 1;
  };
  for (const ReadDeck::Contact& contact : deck.contacts) {
    EXPECT_TRUE(has_set(contact.secondary, contact.secondary_kind));
    EXPECT_TRUE(has_set(contact.primary, contact.primary_kind));
  }
  for (const ReadDeck::Load& load : deck.loads) {
    node(load.node);
    EXPECT_EQ(deck.curves.count(load.curve), 1U);
    if (load.turns)
      for (const std::int64_t corner : load.plane) node(corner);
  }
  for (const auto& [number, stress] : deck.stresses) EXPECT_EQ(deck.solids.count(number), 1U);
  for (const auto& [number, velocity] : deck.velocities) EXPECT_EQ(deck.nodes.count(number), 1U);
  EXPECT_EQ(used.size(), deck.nodes.size());
}

}  // namespace tread::samples
