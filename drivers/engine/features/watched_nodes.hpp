#pragma once
// Nodes whose motion features read in a sample, besides those on which they act.

#include <cstdint>
#include <vector>

#include "core/mesh/swept_block.hpp"

namespace tread {

/// In whole groups of kLanes slots.
class WatchedNodes {
 public:
  /// Keeps a reference.
  explicit WatchedNodes(const Mesh& mesh);

  void clear();
  void add(std::int64_t slot);
  /// The nodes of an element of a block.
  void add_element(int block, int quad, int station);

  /// In the order in which they were added.
  const std::vector<std::int64_t>& groups() const { return groups_.listed; }
  /// Tiles that hold the elements, numbered over all blocks; likewise.
  const std::vector<std::int64_t>& tiles() const { return tiles_.listed; }

 private:
  /// Numbers, each once.
  struct Numbers {
    explicit Numbers(std::int64_t all);
    void clear();
    void add(std::int64_t number);

    std::vector<std::int64_t> listed;
    std::vector<unsigned char> added;  ///< by number
  };

  const Mesh* mesh_;
  Numbers groups_, tiles_;
};

}  // namespace tread
