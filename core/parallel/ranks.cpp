#include "core/parallel/ranks.hpp"

#include <utility>

namespace tread {

namespace {

std::shared_ptr<Ranks>& chosen() {
  static std::shared_ptr<Ranks> ranks;
  return ranks;
}

}  // namespace

void choose_ranks(std::shared_ptr<Ranks> ranks) {
  chosen() = std::move(ranks);
}

std::shared_ptr<Ranks> chosen_ranks() {
  return chosen();
}

}  // namespace tread
