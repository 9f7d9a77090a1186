// Stations of rail and wheel: no element much shorter than its neighbours, wherever run and zone end.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "drivers/engine/station_plan.hpp"

namespace tread {
namespace {

double shortest(const std::vector<Segment>& segments) {
  double least = 1e30;
  for (const Segment& s : segments) least = std::min(least, s.pitch);
  return least;
}

TEST(StationPlan, HasNoSliverWhereverTheRunEnds) {
  const MeshSizes sizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  const Span zone{0.1, 0.4};
  for (double end = 0.02; end < 0.6; end += 0.37e-3) {
    const Span run{-0.04, end};
    EXPECT_GE(shortest(plan_rail({-0.5, 1}, run, zone, sizes).fine), 0.45 * sizes.contact) << end;
    EXPECT_GE(0.43 * shortest(plan_tyre_part(0.43, run, zone, 0.05, sizes).tread), 0.45 * sizes.contact)
        << end;
  }
}

}  // namespace
}  // namespace tread
