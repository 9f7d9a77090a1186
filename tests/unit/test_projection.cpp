// Time of a step on more cores, projected from made-up phases.

#include <gtest/gtest.h>

#include <vector>

#include "drivers/bench/projection.hpp"

namespace tread {
namespace {

/// Phases of one step: the first all serial, the second of many equal items, the third of few.
const std::vector<PhaseWork> kPhases = {{"serial", 10e-6, 0, 0, 0, 0, 0},
                                        {"even", 0, 1000e-6, 0.1e-6, 0, 1, 8e6},
                                        {"uneven", 0, 100e-6, 25e-6, 0, 1, 0}};

TEST(Projection, OneCoreTakesAllWork) {
  const ProjectedStep step = project(kPhases, {5e-6, 0.1}, 1);
  EXPECT_NEAR(step.seconds, 1110e-6, 1e-12);
  EXPECT_NEAR(step.efficiency, 1, 1e-12);
}

TEST(Projection, ItemsBoundTheTime) {
  const ProjectedStep step = project(kPhases, {}, 16);
  EXPECT_NEAR(step.seconds, 10e-6 + 1000e-6 / 16 + 25e-6, 1e-12);
  EXPECT_NEAR(step.efficiency + step.serial + step.uneven + step.waiting, 1, 1e-12);
  EXPECT_EQ(step.limit, "uneven: uneven");
  EXPECT_NEAR(step.bandwidth, 8e6 / step.seconds, 1);
  EXPECT_EQ(project(kPhases, {}, 3).limit, "serial: serial");
}

TEST(Projection, WaitsAreThoseThatWereMeasured) {
  const WaitModel made{3e-6, 0.04};
  for (const int threads : {2, 4}) {
    std::vector<PhaseWork> measured = kPhases;
    measured.push_back({"calls", 0, 60e-6, 1e-6, 0, 5, 0});
    for (PhaseWork& phase : measured) phase.waiting = made.of(phase, threads);
    const WaitModel fitted = fit_waits(measured, threads);
    EXPECT_NEAR(fitted.call, made.call, 1e-12) << threads;
    EXPECT_NEAR(fitted.share, made.share, 1e-9) << threads;
  }
}

/// Waits that fall with the work leave a mean wait, not a negative share.
TEST(Projection, WaitsAreNeverNegative) {
  const std::vector<PhaseWork> phases = {{"a", 0, 10e-6, 0, 4e-6, 1, 0}, {"b", 0, 100e-6, 0, 1e-6, 1, 0}};
  const WaitModel fitted = fit_waits(phases, 2);
  EXPECT_EQ(fitted.share, 0);
  EXPECT_NEAR(fitted.call, 2.5e-6, 1e-12);
  EXPECT_EQ(fit_waits(phases, 1).call, 0);
}

}  // namespace
}  // namespace tread
