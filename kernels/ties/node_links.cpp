#include "kernels/ties/node_links.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/lanes/tie_station_body.hpp"

namespace tread {

/// A link and the node that takes its value.
struct NodeLinks::Entry {
  std::int64_t own = -1;
  Link link;
};

NodeLinks::NodeLinks(const std::vector<FollowingNode>& tied) {
  std::vector<Entry> of_secondary, of_primary;
  const auto link = [](const BasedNode& own, const BasedNode& other, double share) {
    const double turn = own.angle - other.angle;
    return Entry{own.slot,
                 {other.slot, dof(other.slot, 0), share, share * std::cos(turn), share * std::sin(turn)}};
  };
  for (const FollowingNode& node : tied)
    for (std::size_t k = 0; k < 4; ++k) {
      if (node.share[k] == 0) continue;
      of_secondary.push_back(link(node.node, node.primary[k], node.share[k]));
      of_primary.push_back(link(node.primary[k], node.node, node.share[k]));
    }
  to_secondary_ = sums_of(std::move(of_secondary));
  to_primary_ = sums_of(std::move(of_primary));
}

NodeLinks::Sums NodeLinks::sums_of(std::vector<Entry> entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.own, a.link.slot) < std::tie(b.own, b.link.slot);
  });
  Sums sums;
  for (const Entry& entry : entries) {
    if (sums.rows.empty() || sums.rows.back().slot != entry.own)
      sums.rows.push_back({entry.own, sums.links.size(), sums.links.size()});
    sums.links.push_back(entry.link);
    sums.rows.back().last = sums.links.size();
  }
  return sums;
}

void NodeLinks::sum_up(const Sums& sums, bool add, NodeField field) {
  field.visit([&]<class Real>(Real* values) {
    parallel_ranges(std::ssize(sums.rows), [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i) {
        const Row& row = sums.rows[index(i)];
        double sum[3] = {};
        for (std::size_t k = row.first; k < row.last; ++k) {
          const Link& link = sums.links[k];
          const Real* other = values + link.at;
          add_station_values<double>(link.share, link.cosine, link.sine, other[0], other[kLanes],
                                     other[2 * kLanes], sum);
        }
        Real* own = values + dof(row.slot, 0);
        for (int c = 0; c < 3; ++c)
          own[c * kLanes] = static_cast<Real>(add ? own[c * kLanes] + sum[c] : sum[c]);
      }
    });
  });
}

std::int64_t NodeLinks::bytes() const {
  std::size_t sum = 0;
  for (const Sums* sums : {&to_secondary_, &to_primary_})
    sum += sums->rows.size() * sizeof(Row) + sums->links.size() * sizeof(Link);
  return static_cast<std::int64_t>(sum);
}

}  // namespace tread
