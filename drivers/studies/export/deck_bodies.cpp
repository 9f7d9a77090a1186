#include "drivers/studies/export/deck_bodies.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "drivers/studies/export/deck_units.hpp"

namespace tread {

namespace {

/// A law of J2 plasticity is *MAT_PLASTIC_KINEMATIC: its tangent and the isotropic share of its hardening.
void write_plastic(std::int64_t number, const Material& material, KeywordDeck& out) {
  const double hardening = material.isotropic_hardening + material.kinematic_hardening;
  const double e = material.youngs_modulus;
  out.keyword("*MAT_PLASTIC_KINEMATIC");
  out.names({"mid", "ro", "e", "pr", "sigy", "etan", "beta"});
  out.card({number, deck_unit::kDensity * material.density, deck_unit::kStress * e, material.poissons_ratio,
            deck_unit::kStress * material.yield_stress, deck_unit::kStress * e * hardening / (e + hardening),
            hardening > 0 ? material.isotropic_hardening / hardening : 0.0});
  out.names({"src", "srp", "fs", "vp"});
  out.card({0.0, 0.0, 0.0, 0.0});
}

void write_material(std::int64_t number, const Material& material, KeywordDeck& out) {
  out.remark(fmt::format("Material {}.", material.name));
  if (material.law == "j2") {
    write_plastic(number, material, out);
    return;
  }
  out.keyword("*MAT_ELASTIC");
  out.names({"mid", "ro", "e", "pr"});
  out.card({number, deck_unit::kDensity * material.density, deck_unit::kStress * material.youngs_modulus,
            material.poissons_ratio});
}

/// A block's quads of one of its materials.
struct BodyPart {
  int block = 0, material = 0;
  bool operator<(const BodyPart& other) const {
    return std::pair(block, material) < std::pair(other.block, other.material);
  }
};

int material_index(const SweptBlock& block, const VtkGrid::Cell& cell) {
  const auto tile = static_cast<std::size_t>(block.tile_of_station[static_cast<std::size_t>(cell.station)]);
  const auto pitch_class = static_cast<std::size_t>(block.tiles[tile].pitch_class);
  return block.section.quad_material[static_cast<std::size_t>(cell.quad)] +
         block.classes[pitch_class].material_offset;
}

class DeckBodies {
 public:
  DeckBodies(DeckModel& deck, KeywordDeck& out) : deck_(deck), out_(out) {
    for (const VtkGrid::Cell& cell : deck.grid().cells)
      parts_.try_emplace({cell.block, material_index(block(cell.block), cell)}, 0);
    for (auto& [part, number] : parts_) {
      number = ++deck.numbers.part;
      deck.parts.emplace_back(number, part.block);
    }
  }

  void write() {
    write_nodes();
    write_sections();
    write_parts();
    write_damping();
    write_elements();
  }

 private:
  const SweptBlock& block(int index) const {
    return deck_.model().mesh.blocks[static_cast<std::size_t>(index)];
  }
  const Material& material(const BodyPart& part) const {
    return block(part.block).materials[static_cast<std::size_t>(part.material)];
  }

  void write_nodes() {
    out_.keyword("*NODE");
    out_.names(kNodeCard, {"nid", "x", "y", "z"});
    std::int64_t number = 0;
    for (const VtkGrid::Point& point : deck_.grid().points) {
      const Vec3 at = deck_unit::kLength * deck_.place(point);
      out_.card(kNodeCard, {++number, at.x, at.y, at.z});
    }
  }

  void write_sections() {
    out_.remark("One stress point in the middle of each element.");
    out_.keyword("*SECTION_SOLID");
    section_ = ++deck_.numbers.section;
    out_.names({"secid", "elform"});
    out_.card({section_, 1});
    if (deck_.options().reader == DeckReader::openradioss) return;
    out_.remark("Assumed strain, co-rotational, with the full elastic stiffness; no bulk viscosity.");
    out_.keyword("*HOURGLASS");
    out_.names({"hgid", "ihq", "qm", "ibq", "q1", "q2"});
    out_.card({kHourglass, 6, 1.0, 0, kNoViscosity, kNoViscosity});
  }

  void write_parts() {
    std::map<std::string, std::int64_t> materials;
    for (const auto& [part, number] : parts_) {
      const Material& of_part = material(part);
      const auto [known, added] = materials.try_emplace(of_part.name, 0);
      if (added) {
        known->second = ++deck_.numbers.material;
        write_material(known->second, of_part, out_);
      }
      out_.keyword("*PART");
      out_.title(fmt::format("{}, {}", block(part.block).name, of_part.name));
      out_.names({"pid", "secid", "mid", "eosid", "hgid"});
      const bool stated = deck_.options().reader == DeckReader::ls_dyna;
      out_.card({number, section_, known->second, 0, stated ? kHourglass : 0});
    }
  }

  /// Rayleigh's damping is a negative coefficient, in units of time.
  void write_damping() {
    for (const auto& [part, number] : parts_) {
      const double beta = deck_.model().beta[static_cast<std::size_t>(part.block)];
      if (beta <= 0) continue;
      out_.keyword("*DAMPING_PART_STIFFNESS");
      out_.names({"pid", "coef"});
      out_.card({number, -deck_unit::kTime * beta});
    }
  }

  void write_elements() {
    const VtkGrid& grid = deck_.grid();
    out_.keyword("*ELEMENT_SOLID");
    out_.names(kEightsCard, {"eid", "pid"});
    out_.names(kEightsCard, {"n1", "n2", "n3", "n4", "n5", "n6", "n7", "n8"});
    auto corner = grid.connectivity.begin();
    for (const VtkGrid::Cell& cell : grid.cells) {
      const auto node = [&](int i) { return corner[i] + 1; };
      out_.card(kEightsCard,
                {++deck_.numbers.element, parts_.at({cell.block, material_index(block(cell.block), cell)})});
      out_.card(kEightsCard, {node(0), node(1), node(2), node(3), node(4), node(5), node(6), node(7)});
      corner += grid.corners();
    }
  }

  static constexpr std::int64_t kHourglass = 1;
  static constexpr double kNoViscosity = 1e-12;  // 0 would select the reader's 1.5 and 0.06

  DeckModel& deck_;
  KeywordDeck& out_;
  std::map<BodyPart, std::int64_t> parts_;
  std::int64_t section_ = 0;
};

}  // namespace

void write_bodies(DeckModel& deck, KeywordDeck& out) {
  DeckBodies(deck, out).write();
}

}  // namespace tread
