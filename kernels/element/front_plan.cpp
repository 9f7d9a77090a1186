#include "kernels/element/front_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/index.hpp"

namespace tread {

namespace {

/// Chooses the next quad: the one that lengthens the front least, and among those the one that lies furthest
/// back along the section's longer extent.
class FrontWalk {
 public:
  explicit FrontWalk(const Section& section)
      : section_(section),
        left_(section.p.size(), 0),
        opened_(section.p.size(), false),
        quads_of_(section.p.size()),
        done_(section.quads.size(), false) {
    const auto [p_min, p_max] = std::minmax_element(section.p.begin(), section.p.end());
    const auto [q_min, q_max] = std::minmax_element(section.q.begin(), section.q.end());
    const std::vector<double>& along = *p_max - *p_min > *q_max - *q_min ? section.p : section.q;
    for (std::size_t quad = 0; quad < section.quads.size(); ++quad) {
      double sum = 0;
      for (const int node : section.quads[quad]) {
        ++left_[index(node)];
        quads_of_[index(node)].push_back(static_cast<int>(quad));
        sum += along[index(node)];
      }
      along_.push_back(sum);
    }
  }

  int next() const {
    int best = -1;
    const auto consider = [&](int quad) {
      if (done_[index(quad)]) return;
      if (best < 0 ||
          std::pair(growth(quad), along_[index(quad)]) < std::pair(growth(best), along_[index(best)]))
        best = quad;
    };
    for (const int node : front_)
      for (const int quad : quads_of_[index(node)]) consider(quad);
    if (best < 0)
      for (int quad = 0; quad < static_cast<int>(done_.size()); ++quad) consider(quad);
    return best;
  }

  bool was_opened(int node) const { return opened_[index(node)]; }

  void open(int node) {
    opened_[index(node)] = true;
    front_.push_back(node);
  }

  /// Takes the quad away from its nodes; returns those that have no other left.
  std::vector<int> finish(int quad) {
    std::vector<int> closed;
    done_[index(quad)] = true;
    for (const int node : section_.quads[index(quad)])
      if (--left_[index(node)] == 0) {
        closed.push_back(node);
        front_.erase(std::find(front_.begin(), front_.end(), node));
      }
    return closed;
  }

 private:
  int growth(int quad) const {
    int change = 0;
    for (const int node : section_.quads[index(quad)]) {
      if (!was_opened(node)) ++change;
      if (left_[index(node)] == 1) --change;
    }
    return change;
  }

  const Section& section_;
  std::vector<int> left_;
  std::vector<bool> opened_;
  std::vector<std::vector<int>> quads_of_;
  std::vector<bool> done_;
  std::vector<double> along_;  ///< four times the centre of each quad [m]
  std::vector<int> front_;
};

}  // namespace

FrontPlan make_front_plan(const Section& section) {
  FrontPlan plan;
  FrontWalk walk(section);
  std::vector<int> slot_of(section.p.size(), -1);
  std::vector<int> free_slots;
  for (std::size_t step = 0; step < section.quads.size(); ++step) {
    const int quad = walk.next();
    FrontPlan::Quad entry{};
    entry.quad = quad;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const int node = section.quads[static_cast<std::size_t>(quad)][corner];
      int& slot = slot_of[static_cast<std::size_t>(node)];
      if (!walk.was_opened(node)) {
        walk.open(node);
        if (free_slots.empty()) free_slots.push_back(plan.slots++);
        slot = free_slots.back();
        free_slots.pop_back();
        plan.open.push_back({node, slot});
      }
      entry.slot[corner] = slot;
    }
    for (const int node : walk.finish(quad)) {
      const int slot = slot_of[static_cast<std::size_t>(node)];
      plan.close.push_back({node, slot});
      free_slots.push_back(slot);
    }
    entry.opened = static_cast<int>(plan.open.size());
    entry.closed = static_cast<int>(plan.close.size());
    plan.quads.push_back(entry);
  }
  plan.open.insert(plan.open.end(), kPrefetchAhead, plan.open.back());
  return plan;
}

void number_by_front(Section& section) {
  const FrontPlan plan = make_front_plan(section);
  const Section before = section;
  std::vector<int> number(section.p.size(), -1);
  for (std::size_t i = 0; i < section.p.size(); ++i) {
    const auto node = static_cast<std::size_t>(plan.open[i].node);
    number[node] = static_cast<int>(i);
    section.p[i] = before.p[node];
    section.q[i] = before.q[node];
  }
  const auto renumber = [&](int& node) { node = number[static_cast<std::size_t>(node)]; };
  for (auto& quad : section.quads) std::for_each(quad.begin(), quad.end(), renumber);
  for (SurfaceEdge& edge : section.surface) std::for_each(edge.node.begin(), edge.node.end(), renumber);
  for (auto& [name, path] : section.paths) std::for_each(path.begin(), path.end(), renumber);
}

}  // namespace tread
