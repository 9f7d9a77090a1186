#pragma once
// Decks of the scenes that the tests of the export read back.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/studies/export/deck_surfaces.hpp"
#include "drivers/studies/export/keyword_export.hpp"
#include "tests/bar_scene.hpp"
#include "tests/read_keyword_deck.hpp"
#include "tests/tyre_scene.hpp"

namespace tread::samples {

inline Scene rigid_start(Scene scene) {
  if (scene.motion) scene.motion->start = "rigid";
  return scene;
}

inline Scene bar() {
  return rigid_start(resolve_scene(SceneSource{"bar.toml", kBar, {}}).scene);
}

inline Scene tyre(const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all = {"scene.element_size=10 mm"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return rigid_start(tyre_scene(all));
}

/// A half wheelset on a short track: a shipped scene.
inline Scene half_wheelset(const std::string& name, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all = {
      "scene.element_size=11 mm", "rail.length=1.95 m",          "rail.origin=1 m",     "fastenings.count=3",
      "solution_zone.start=0 m",  "solution_zone.length=0.15 m", "motion.duration=1 ms"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return rigid_start(read_scene(std::filesystem::path(TREAD_SOURCE_DIR) / "scenes" / (name + ".toml"), all));
}

inline const std::vector<std::string> kCorrugated = {"corrugation.start=0.03 m", "corrugation.length=0.08 m",
                                                     "corrugation.centre=0 m"};

struct Exported {
  ReadDeck deck;
  DeckSummary summary;
};

inline Exported exported(const Model& model, const DeckOptions& options = {}) {
  std::string text;
  KeywordDeck deck([&](std::string_view piece) { text += piece; });
  Exported result;
  result.summary = write_keyword_deck(model, options, "test", deck);
  result.deck = DeckParser().read(text);
  expect_whole(result.deck);
  for (const ReadDeck::Load& load : result.deck.loads) {
    EXPECT_TRUE(load.axis == 2 || options.preload) << load.node;
  }
  return result;
}

/// Sum of the stiffnesses or dampings of the discrete elements of a direction.
inline double sum_of(const ReadDeck& deck, const std::string& material, const Vec3& direction) {
  double sum = 0;
  for (const auto& [number, card] : deck.discretes) {
    const ReadDeck::Card& law = deck.materials.at(whole(deck.parts.at(whole(card[1]))[2]));
    if (whole(card[4]) > 0 && law[0].find(material) != std::string::npos &&
        dot(deck.orientations.at(whole(card[4])), direction) == 1)
      sum += real(law[1]);
  }
  return sum;
}

inline Vec3 normal_of(const ReadDeck& deck, const DeckFace& face) {
  const auto at = [&](std::size_t i) { return deck.nodes.at(face[i]); };
  return cross(at(2) - at(0), at(3) - at(1));
}

}  // namespace tread::samples
