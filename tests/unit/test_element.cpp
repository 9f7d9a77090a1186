#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/element/element_body.hpp"
#include "kernels/element/front_plan.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

HexNodes distorted_hexahedron() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  HexNodes nodes;
  for (int node = 0; node < 8; ++node)
    nodes[index(node)] = {mode_value(mode_xi, node) + shift(random),
                          2 * mode_value(mode_eta, node) + shift(random),
                          3 * mode_value(mode_zeta, node) + shift(random)};
  return nodes;
}

TEST(ElementGeometry, ParallelepipedHasItsVolumeAndEqualShares) {
  HexNodes nodes;
  for (int node = 0; node < 8; ++node) {
    const double xi = mode_value(mode_xi, node);
    const double eta = mode_value(mode_eta, node);
    const double zeta = mode_value(mode_zeta, node);
    nodes[index(node)] = {xi + 0.3 * eta, 2 * eta + 0.1 * zeta, 3 * zeta + 0.2 * xi};
  }
  const ElementGeometry shape = element_geometry(nodes);
  const double volume = 8 * (1 * (2 * 3) - 0.3 * (0 * 3 - 0.1 * 0.2));
  EXPECT_NEAR(shape.volume, volume, 1e-13 * volume);
  EXPECT_NEAR(shape.smallest_jacobian, 1, 1e-13);
  for (const double share : shape.nodal_volume) EXPECT_NEAR(share, volume / 8, 1e-13 * volume);
}

TEST(ElementGeometry, GradientOfALinearFieldIsExact) {
  const HexNodes nodes = distorted_hexahedron();
  const ElementGeometry shape = element_geometry(nodes);
  const Vec3 slope = {0.3, -0.7, 1.1};
  for (int j = 0; j < 3; ++j) {
    double gradient = 0;
    for (int m = 0; m < kGradientModes; ++m) {
      double amplitude = 0;
      for (int node = 0; node < 8; ++node)
        amplitude += mode_value(static_cast<Mode>(m), node) * (4 + dot(slope, nodes[index(node)]));
      gradient += amplitude * shape.gradient[index(m)][index(j)];
    }
    EXPECT_NEAR(gradient, slope[j], 1e-14);
  }
}

TEST(ElementGeometry, VolumeGrowsByTheIntegralOfTheShapeFunctionsGradient) {
  // dV/dx_I = b_I: a central difference is exact because V is linear in each coordinate.
  const HexNodes nodes = distorted_hexahedron();
  const ElementGeometry shape = element_geometry(nodes);
  for (int node = 0; node < 8; ++node)
    for (int j = 0; j < 3; ++j) {
      HexNodes ahead = nodes;
      HexNodes behind = nodes;
      ahead[index(node)][j] += 0.1;
      behind[index(node)][j] -= 0.1;
      double b = 0;
      for (int m = 0; m < kGradientModes; ++m)
        b += mode_value(static_cast<Mode>(m), node) * shape.gradient[index(m)][index(j)] * shape.volume;
      EXPECT_NEAR((element_geometry(ahead).volume - element_geometry(behind).volume) / 0.2, b,
                  1e-13 * shape.volume);
    }
}

TEST(ElementGeometry, TurnedInsideOutIsSeen) {
  HexNodes nodes = distorted_hexahedron();
  nodes[6] = -0.5 * nodes[6];
  EXPECT_LT(element_geometry(nodes).smallest_jacobian, 0);
  std::swap(nodes[0], nodes[4]);
  std::swap(nodes[1], nodes[5]);
  std::swap(nodes[2], nodes[6]);
  std::swap(nodes[3], nodes[7]);
  EXPECT_LT(element_geometry(nodes).volume, 0);
}

double mode_sum(Mode mode, const std::array<double, 8>& u) {
  double sum = 0;
  for (int node = 0; node < 8; ++node) sum += mode_value(mode, node) * u[index(node)];
  return sum;
}

struct Ends {
  double sum[4];
  double difference[4];
  explicit Ends(const std::array<double, 8>& u) {
    for (std::size_t j = 0; j < 4; ++j) {
      sum[j] = u[j + 4] + u[j];
      difference[j] = u[j + 4] - u[j];
    }
  }
};

constexpr std::array<double, 8> kField = {1, -2, 3, 5, -7, 11, 13, -17};

/// Strain by `kField` as component 1.
template <class Element>
Strain<double> strain_of(const Element& element) {
  const Ends ends(kField);
  Strain<double> strain{};
  element.strain(1, ends.sum, ends.difference, strain);
  return strain;
}

/// Expects the mean gradient and the hourglass amplitudes of `kField`. [theory.md, eqs. 2 and 3]
template <class Element>
void expect_strain(const Element& element, const ElementGeometry& shape, double gap_by_h1) {
  const Strain<double> strain = strain_of(element);
  for (int j = 0; j < 3; ++j) {
    double gradient = 0;
    for (int m = 0; m < kGradientModes; ++m)
      gradient += shape.gradient[index(m)][j] * mode_sum(static_cast<Mode>(m), kField);
    EXPECT_NEAR(strain.g[1][j], gradient, 1e-13 * norm(shape.gradient[0]) * 17);
  }
  const double(&q)[kHourglassModes] = strain.q[1];
  const double in_modes[kHourglassModes] = {q[0] / gap_by_h1, q[1] + q[2], q[1] - q[2], q[3]};
  for (int m = 0; m < kHourglassModes; ++m) {
    double amplitude = mode_sum(static_cast<Mode>(mode_h1 + m), kField);
    for (int j = 0; j < 3; ++j) amplitude -= strain.g[1][j] * shape.position[index(mode_h1 + m)][j];
    EXPECT_NEAR(in_modes[m], amplitude, 1e-12) << m;
  }
}

/// Expects that forces do the work of their strain on the field.
template <class Element>
void expect_transpose(const Element& element) {
  const Ends ends(kField);
  const Strain<double> strain = strain_of(element);
  Strain<double> force{};
  for (int j = 0; j < 3; ++j) force.g[1][j] = 1 + 0.3 * j;
  for (int m = 0; m < kHourglassModes; ++m) force.q[1][m] = 0.2 - 0.7 * m;
  double inside = 0;
  double scale = 0;
  const auto add = [&](double work) {
    inside += work;
    scale += std::abs(work);
  };
  for (int j = 0; j < 3; ++j) add(force.g[1][j] * strain.g[1][j]);
  for (int m = 0; m < kHourglassModes; ++m) add(force.q[1][m] * strain.q[1][m]);
  double s[4];
  double d[4];
  element.forces(1, force, s, d);
  double outside = 0;
  for (int j = 0; j < 4; ++j) outside += s[j] * ends.sum[j] + d[j] * ends.difference[j];
  EXPECT_NEAR(inside, outside, 1e-13 * scale);
}

class SweptSymmetry : public testing::TestWithParam<Sweep> {
 protected:
  SweptSymmetry()
      : section_(samples::grid_section({3, 2, 0.01, 0.05, 0.03, 0.02, 0.25})),
        nodes_(swept_nodes(section_, 3, GetParam(), 0.3)),
        shape_(element_geometry(nodes_)) {}

  Section section_;
  HexNodes nodes_;
  ElementGeometry shape_;
};

TEST_P(SweptSymmetry, LeavesTheCoefficientsThatTheKernelUses) {
  const double scale = norm(shape_.gradient[mode_eta]) + norm(shape_.gradient[mode_xi]);
  for (const Mode mode : {mode_eta, mode_zeta, mode_h1})
    EXPECT_NEAR(shape_.gradient[mode].x, 0, 1e-14 * scale);
  for (const Mode mode : {mode_xi, mode_h2, mode_h3})
    for (const int j : {1, 2}) EXPECT_NEAR(shape_.gradient[mode][j], 0, 1e-14 * scale);
  EXPECT_NEAR(shape_.position[mode_h1].x, 0, 1e-15);
  for (const Mode mode : {mode_h2, mode_h3, mode_h4})
    for (const int j : {1, 2}) EXPECT_NEAR(shape_.position[mode][j], 0, 1e-15);
  if (GetParam() == Sweep::extruded) {
    for (const int j : {1, 2}) EXPECT_NEAR(shape_.gradient[mode_h1][j], 0, 1e-14 * scale);
    for (const Mode mode : {mode_h2, mode_h3, mode_h4}) EXPECT_NEAR(shape_.position[mode].x, 0, 1e-15);
  } else {
    EXPECT_GT(std::abs(shape_.gradient[mode_h1].y), 1e-6 * scale);
    EXPECT_GT(std::abs(shape_.position[mode_h2].x), 1e-6);
  }
}

TEST_P(SweptSymmetry, HourglassConstantsHoldTheWholeMatrix) {
  const HourglassMatrix matrix = hourglass_matrix(nodes_, shape_.volume, samples::steel());
  const auto constants = swept_constants<double>(shape_, matrix, samples::steel());
  double scale = 0;
  for (std::size_t i = 0; i < 12; ++i) scale = std::max(scale, matrix[i][i]);
  for (int column = 0; column < 12; ++column) {
    Strain<double> strain{};
    Strain<double> force{};
    strain.q[column / 4][column % 4] = 1;
    hourglass_forces(constants.hourglass, strain, force);
    // The amplitudes of h1, h2, h3, h4 by those of the kernels; forces go the other way.
    const double from[4][4] = {{1 / constants.gap_by_h1, 0, 0, 0}, {0, 1, 1, 0}, {0, 1, -1, 0}, {0, 0, 0, 1}};
    for (int row = 0; row < 12; ++row) {
      double wanted = 0;
      for (int m = 0; m < 4; ++m)
        for (int n = 0; n < 4; ++n)
          wanted += from[m][row % 4] * matrix[index(row / 4 * 4 + m)][index(column / 4 * 4 + n)] *
                    from[n][column % 4];
      EXPECT_NEAR(force.q[row / 4][row % 4], wanted, 1e-14 * scale) << row << " " << column;
    }
    for (int row = 0; row < 12; ++row)
      EXPECT_NEAR(matrix[index(row)][index(column)], matrix[index(column)][index(row)], 1e-14 * scale);
  }
}

TEST_P(SweptSymmetry, StrainsAreThoseOfTheGeometry) {
  const auto constants = swept_constants<double>(
      shape_, hourglass_matrix(nodes_, shape_.volume, samples::steel()), samples::steel());
  const PerturbedElement<double, double> perturbed(constants, {});
  EXPECT_NEAR(perturbed.volume_ratio, 1, 1e-14);
  expect_strain(perturbed, shape_, constants.gap_by_h1);
  expect_transpose(perturbed);
  const auto expect_swept = [&](const auto& element) {
    expect_strain(element, shape_, constants.gap_by_h1);
    expect_transpose(element);
    const Strain<double> a = strain_of(element), b = strain_of(perturbed);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a.g[1][j], b.g[1][j], 1e-12 * std::abs(a.g[1][0]));
    for (int m = 0; m < kHourglassModes; ++m) EXPECT_NEAR(a.q[1][m], b.q[1][m], 1e-12);
  };
  if (GetParam() == Sweep::revolved) {
    expect_swept(SweptElement<Sweep::revolved, double>{constants});
  } else {
    EXPECT_EQ(constants.gap_by_h1, 0.5);
    expect_swept(SweptElement<Sweep::extruded, double>{constants});
  }
}

INSTANTIATE_TEST_SUITE_P(Sweeps, SweptSymmetry, testing::Values(Sweep::extruded, Sweep::revolved),
                         [](const auto& sweep) {
                           return sweep.param == Sweep::extruded ? "extruded" : "revolved";
                         });

TEST(ElementBody, ModesOfDiagonalsMakeTheSumsOverTheNodes) {
  const Ends ends(kField);
  double a[kModes];
  to_modes(ends.sum, ends.difference, a);
  EXPECT_EQ(a[kernel_xi], mode_sum(mode_xi, kField));
  EXPECT_EQ(a[kernel_s02] - a[kernel_s13], mode_sum(mode_eta, kField));
  EXPECT_EQ(a[kernel_s02] + a[kernel_s13], mode_sum(mode_zeta, kField));
  EXPECT_EQ(a[kernel_h1], mode_sum(mode_h1, kField));
  EXPECT_EQ(a[kernel_d02] + a[kernel_d13], mode_sum(mode_h2, kField));
  EXPECT_EQ(a[kernel_d02] - a[kernel_d13], mode_sum(mode_h3, kField));
  EXPECT_EQ(a[kernel_h4], mode_sum(mode_h4, kField));
}

TEST(ElementBody, StrainsOfAnyShapeAreThoseOfTheGeometry) {
  const HexNodes nodes = distorted_hexahedron();
  const ElementGeometry shape = element_geometry(nodes);
  SweptConstants<double> no_shape{};
  no_shape.inverse_volume = 1;
  no_shape.gap_by_h1 = 0.4;
  double positions[3][kModes];
  for (int j = 0; j < 3; ++j) {
    std::array<double, 8> x{};
    for (std::size_t node = 0; node < 8; ++node) x[node] = nodes[node][j];
    const Ends ends(x);
    to_modes(ends.sum, ends.difference, positions[j]);
  }
  const PerturbedElement<double, double> element(no_shape, positions);
  EXPECT_NEAR(element.volume_ratio, shape.volume, 1e-13 * shape.volume);
  expect_strain(element, shape, no_shape.gap_by_h1);
  expect_transpose(element);
}

TEST(ElementBody, BackwardStagesAreTransposes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  double s[4], d[4], s_back[4], d_back[4], a[kModes], b[kModes];
  for (int j = 0; j < 4; ++j) {
    s[j] = value(random);
    d[j] = value(random);
  }
  for (double& x : b) x = value(random);
  to_modes(s, d, a);
  from_modes(b, s_back, d_back);
  double forward = 0;
  double backward = 0;
  for (int m = 0; m < kModes; ++m) forward += a[m] * b[m];
  for (int j = 0; j < 4; ++j) backward += s[j] * s_back[j] + d[j] * d_back[j];
  EXPECT_NEAR(forward, backward, 1e-14);

  double sum[3], difference[3], sum_force[3], difference_force[3];
  double work = 0;
  for (int i = 0; i < 3; ++i) {
    sum[i] = value(random);
    difference[i] = value(random);
    sum_force[i] = value(random);
    difference_force[i] = value(random);
  }
  double turned_sum[3], turned_difference[3];
  std::copy_n(sum, 3, turned_sum);
  std::copy_n(difference, 3, turned_difference);
  turn_to_middle(std::cos(0.1), std::sin(0.1), turned_sum, turned_difference);
  for (int i = 0; i < 3; ++i)
    work += turned_sum[i] * sum_force[i] + turned_difference[i] * difference_force[i];
  turn_to_nodes(std::cos(0.1), std::sin(0.1), sum_force, difference_force);
  for (int i = 0; i < 3; ++i) work -= sum[i] * sum_force[i] + difference[i] * difference_force[i];
  EXPECT_NEAR(work, 0, 1e-14);
}

TEST(FrontPlan, OpensAndClosesEveryNodeOnceAroundItsQuads) {
  const Section section = samples::grid_section({17, 9, 0, 0, 1.7, 0.9, 0});
  const FrontPlan plan = make_front_plan(section);
  std::vector<int> node_in(index(plan.slots), -1);
  std::vector<int> closings(section.p.size(), 0);
  int opened = 0;
  int closed = 0;
  for (const FrontPlan::Quad& entry : plan.quads) {
    for (; opened < entry.opened; ++opened)
      node_in[index(plan.open[index(opened)].slot)] = plan.open[index(opened)].node;
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_EQ(node_in[index(entry.slot[j])], section.quads[index(entry.quad)][j]);
    for (; closed < entry.closed; ++closed) {
      const auto [node, slot] = plan.close[index(closed)];
      EXPECT_EQ(node_in[index(slot)], node);
      ++closings[index(node)];
    }
  }
  for (const int count : closings) EXPECT_EQ(count, 1);
  EXPECT_LE(plan.slots, 13);
}

TEST(FrontPlan, NumbersNodesInTheOrderOfTheirOpening) {
  const Section before = samples::grid_section({17, 9, 0, 0, 1.7, 0.9, 0});
  Section section = before;
  section.paths["some"] = {3, 50, 7};
  section.surface.push_back({0, {3, 50}, {}});
  number_by_front(section);
  const FrontPlan plan = make_front_plan(section);
  for (int i = 0; i < section.nodes(); ++i) EXPECT_EQ(plan.open[index(i)].node, i);
  const auto place = [](const Section& s, int node) { return std::pair(s.p[index(node)], s.q[index(node)]); };
  for (std::size_t quad = 0; quad < section.quads.size(); ++quad)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_EQ(place(section, section.quads[quad][j]), place(before, before.quads[quad][j]));
  const std::vector<int>& path = section.paths.at("some");
  EXPECT_EQ(place(section, path[0]), place(before, 3));
  EXPECT_EQ(place(section, path[1]), place(before, 50));
  EXPECT_EQ(place(section, path[2]), place(before, 7));
  EXPECT_EQ(section.surface[0].node[1], path[1]);
}

}  // namespace
}  // namespace tread
