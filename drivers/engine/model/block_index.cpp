#include "drivers/engine/model/block_index.hpp"

namespace tread {

std::vector<int> BlockIndex::wheel() const {
  std::vector<int> blocks;
  for (const int b : {tread, disc, axle})
    if (b >= 0) blocks.push_back(b);
  return blocks;
}

std::vector<int> BlockIndex::rail() const {
  std::vector<int> blocks;
  for (const int b : {rail_cap, rail_base})
    if (b >= 0) blocks.push_back(b);
  return blocks;
}

}  // namespace tread
