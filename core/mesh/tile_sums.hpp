#pragma once
// Sums over the tiles of a mesh: tile by tile in parallel, then in the order of the tiles. The bits do not
// depend on the number of threads, nor on who has summed over which tile.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/index.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/parallel/parallel.hpp"
#include "core/parallel/ranks.hpp"

namespace tread {

/// Successive tiles [first, last) in the order of blocks and tiles.
struct TileStretch {
  std::size_t first = 0;
  std::size_t last = 0;

  bool holds(std::size_t tile) const { return first <= tile && tile < last; }
};

/// The tiles of which ranks hold the values.
struct TileShare {
  Ranks* ranks = nullptr;
  std::vector<TileStretch> own;      ///< of this rank
  std::vector<std::size_t> by_rank;  ///< tiles of rank 0, of rank 1 ...
  std::vector<std::int64_t> first;   ///< by rank, and the end, in by_rank

  /// Gives each rank the sums of all. `sums`: by tile of all blocks.
  template <class Sum>
  void complete(std::vector<Sum>& sums) const {
    static_assert(std::is_trivially_copyable_v<Sum>);
    std::vector<Sum> packed(sums.size());
    for (std::size_t i = 0; i < packed.size(); ++i) packed[i] = sums[by_rank[i]];
    std::vector<std::int64_t> first_byte;
    for (const std::int64_t i : first) first_byte.push_back(i * static_cast<std::int64_t>(sizeof(Sum)));
    ranks->gather(reinterpret_cast<std::byte*>(packed.data()), first_byte);
    for (std::size_t i = 0; i < packed.size(); ++i) sums[by_rank[i]] = packed[i];
  }
};

/// Sum of of_tile(block, tile) over the tiles of some blocks. `share`: of which tiles this process has the
/// values; null: of all.
template <class Sum, class OfTile>
Sum sum_tiles(const Mesh& mesh, std::span<const int> blocks, const TileShare* share, const OfTile& of_tile) {
  std::vector<std::size_t> before = {0};
  for (const SweptBlock& block : mesh.blocks) before.push_back(before.back() + block.tiles.size());
  std::vector<Sum> sums(before.back());
  const TileStretch all = {0, before.back()};
  const std::span<const TileStretch> own = share != nullptr ? share->own : std::span(&all, 1);
  for (const int block : blocks)
    for (const TileStretch& stretch : own) {
      const std::size_t offset = before[index(block)];
      const std::size_t first = std::max(stretch.first, offset);
      const std::size_t last = std::max(first, std::min(stretch.last, before[index(block) + 1]));
      parallel_ranges(static_cast<std::int64_t>(last - first), [&](std::int64_t from, std::int64_t to) {
        for (std::size_t tile = first + index(from); tile < first + index(to); ++tile)
          sums[tile] = of_tile(block, static_cast<int>(tile - offset));
      });
    }
  if (share != nullptr) share->complete(sums);
  Sum total{};
  for (const int block : blocks)
    for (std::size_t tile = before[index(block)]; tile < before[index(block) + 1]; ++tile)
      total += sums[tile];
  return total;
}

/// Numbers of the blocks for which which(block) holds.
template <class Which>
std::vector<int> blocks_where(const Mesh& mesh, const Which& which) {
  std::vector<int> blocks;
  for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block)
    if (which(mesh.blocks[index(block)])) blocks.push_back(block);
  return blocks;
}

}  // namespace tread
