// Tiles about the patch: they hold all nodes of the contact, and nothing else acts on these.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/index.hpp"
#include "drivers/engine/fields/patch_tiles.hpp"
#include "drivers/engine/model/model.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

class Tiles {
 public:
  /// `pairs`: the loop takes every second tile of a block along.
  explicit Tiles(const Scene& scene, bool pairs = false) : model_(scene) {
    for (const SweptBlock& block : model_.mesh.blocks) {
      first_.push_back(joined_.size());
      for (std::size_t tile = 0; tile < block.tiles.size(); ++tile)
        joined_.push_back(pairs && tile % 2 == 0 && tile + 1 < block.tiles.size());
    }
    tiles_ = std::make_unique<PatchTiles>(model_, joined_);
  }

  /// With the wheel at a place along the rail [m], turned by x / R and more [rad].
  BodyFrame at(double x) const {
    BodyFrame wheel;
    wheel.origin = {x, 0, model_.contact->touching_height()};
    wheel.velocity = {80, 0, 0};
    wheel.spin = 80 / 0.43;
    wheel.angle = x / 0.43 + turned;
    return wheel;
  }
  double turned = 0;
  bool find(double x) { return tiles_->find(at(x), kStep); }
  std::vector<TileStretch> near() const { return {tiles_->near().begin(), tiles_->near().end()}; }

  /// Those that were found keep their promises.
  void expect_sound(double x) {
    std::vector<int> visits(joined_.size(), 0);
    for (const auto& stretches : {tiles_->near(), tiles_->elsewhere()})
      for (const TileStretch& stretch : stretches) {
        for (std::size_t tile = stretch.first; tile < stretch.last; ++tile) ++visits[tile];
        EXPECT_TRUE(stretch.first == 0 || joined_[stretch.first - 1] == 0) << "tiles of a pair are parted";
      }
    EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
    const auto [rail, wheel] = model_.contact->near(at(x), kStep);
    expect_surface(model_.contact->options().rail_block, rail);
    expect_surface(model_.contact->options().wheel_block, wheel);
  }

 private:
  static constexpr double kStep = 3e-7;

  bool is_near(int block, int tile) const {
    for (const TileStretch& stretch : tiles_->near())
      if (stretch.holds(first_[index(block)] + index(tile))) return true;
    return false;
  }

  /// Near are the tiles of the surface, and those whose last element ends in them.
  void expect_surface(int number, const SurfacePart& part) const {
    const SweptBlock& block = model_.mesh.blocks[index(number)];
    for (int i = 0; i < part.count; ++i) {
      const int station = (part.first + i) % block.station_count();
      const int tile = block.tile_of_station[index(station)];
      EXPECT_TRUE(is_near(number, tile)) << "block " << number << ", tile " << tile;
      const int all = static_cast<int>(block.tiles.size());
      EXPECT_TRUE((tile == 0 && !block.closed) || is_near(number, (tile + all - 1) % all));
    }
  }

  Model model_;
  std::vector<std::size_t> first_;
  std::vector<unsigned char> joined_;
  std::unique_ptr<PatchTiles> tiles_;
};

Scene wheelset() {
  return resolve_scene(SceneSource{"small.toml", "[scene]\nbased_on = \"highspeed-slab-2014\"\n", {}},
                       {"scene.element_size=6 mm", "rail.length=2.7 m", "rail.origin=1.3 m",
                        "fastenings.count=4", "fastenings.first=0.3 m", "solution_zone.start=-5 mm",
                        "solution_zone.length=40 mm", "motion.duration=0.1 ms"})
      .scene;
}

TEST(PatchTiles, HoldThePatchWhereverItIs) {
  for (const bool pairs : {false, true}) {
    Tiles tiles(wheelset(), pairs);
    for (double x = -0.3; x < 0.3; x += 0.013) {
      ASSERT_TRUE(tiles.find(x)) << x;
      tiles.expect_sound(x);
    }
  }
}

TEST(PatchTiles, FollowOneAnotherPastAFullTurn) {
  Tiles tiles(wheelset());
  int past = 0;
  for (tiles.turned = 0; tiles.turned < 2 * M_PI; tiles.turned += 0.02) {
    ASSERT_TRUE(tiles.find(0)) << tiles.turned;
    tiles.expect_sound(0);
    const std::vector<TileStretch> near = tiles.near();
    if (near.size() == 2) continue;
    ++past;
    ASSERT_EQ(near.size(), 3U) << "rail, end and begin of the turn";
    EXPECT_GT(near[1].first, near[2].last);
  }
  EXPECT_GT(past, 0);
}

TEST(PatchTiles, AreNotApartWhereTheRailIsHeld) {
  Tiles tiles(wheelset());
  EXPECT_FALSE(tiles.find(-1.26));
}

TEST(PatchTiles, AreNotApartUnderAHammer) {
  Scene scene = wheelset();
  scene.hammer = HammerSpec{.position = 0.1, .force = 1e3, .duration = 1e-4};
  Tiles tiles(scene);
  EXPECT_FALSE(tiles.find(0.1));
  EXPECT_TRUE(tiles.find(-0.2));
}

TEST(PatchTiles, AreNotApartOnAWheelOfFewTiles) {
  Tiles tiles(samples::tyre_scene({"scene.element_size=20 mm", "solution_zone.length=200 mm"}));
  EXPECT_FALSE(tiles.find(0));
}

TEST(PatchTiles, NeedContact) {
  Scene scene = wheelset();
  scene.contact.reset();
  const Model model(scene);
  EXPECT_FALSE(PatchTiles(model, {}).find(BodyFrame{}, 1e-7));
}

}  // namespace
}  // namespace tread
