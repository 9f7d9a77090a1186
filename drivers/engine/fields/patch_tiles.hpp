#pragma once
// The tiles about the patch, whose elements come first where contact is solved beside all others.
// [docs/architecture.md, Step]

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/tile_sums.hpp"
#include "drivers/engine/fields/featured_nodes.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

class PatchTiles {
 public:
  /// Keeps a reference. `joined`: by tile, true where the element loop takes the tile behind it along.
  PatchTiles(const Model& model, std::vector<unsigned char> joined);

  /// Finds the tiles that hold all nodes whose motion contact reads or changes in a step of dt [s]. False
  /// without contact, and where something else than elements and contact acts on one of these nodes.
  bool find(const BodyFrame& wheel, double dt);

  /// Those found, in the order of the sweep, with the tiles before them, whose elements move the first of
  /// them.
  std::span<const TileStretch> near() const { return near_; }
  /// The parts of `own`, ascending, among them and among all others, in the same orders.
  void share(std::span<const TileStretch> own, std::vector<TileStretch>& near,
             std::vector<TileStretch>& elsewhere) const;
  /// All other tiles, ascending.
  std::span<const TileStretch> elsewhere() const { return elsewhere_; }

 private:
  bool add(int block, const SurfaceProfile& profile, const SurfacePart& part);
  void list_others();

  const Model* model_;
  std::vector<unsigned char> joined_;
  std::vector<std::size_t> first_tile_;  ///< by block, and their number
  GroupMarks taken_;                     ///< by other features
  std::vector<TileStretch> near_, elsewhere_;
};

}  // namespace tread
