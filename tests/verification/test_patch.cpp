#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "tests/field_differences.hpp"
#include "tests/refusal.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

using samples::for_each_node;
using samples::largest;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

SweptBlock of_steel(SweptBlock block) {
  for (Material& material : block.materials) material = samples::steel();
  return block;
}

SweptBlock distorted(SweptBlock block) {
  samples::shift_nodes(block, 1e-3, 0.7);
  return block;
}

struct Case {
  const char* name;
  SweptBlock block;
};

std::vector<Case> patches() {
  std::vector<Case> list = {{"extruded", of_steel(samples::extruded())},
                            {"revolved", of_steel(samples::revolved_open())},
                            {"ring", of_steel(samples::revolved_closed())}};
  for (std::size_t i = 0; i < 3; ++i) list.push_back({list[i].name, distorted(list[i].block)});
  return list;
}

/// Nodes on the section's outline: those of edges that belong to one quad only.
std::set<int> outline(const Section& section) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& quad : section.quads)
    for (std::size_t i = 0; i < 4; ++i) ++edges[std::minmax(quad[i], quad[(i + 1) % 4])];
  std::set<int> nodes;
  for (const auto& [edge, count] : edges)
    if (count == 1) nodes.insert({edge.first, edge.second});
  return nodes;
}

TEST(Patch, LinearFieldGivesExactStressAndNoInnerForce) {
  const Mat3 slope = {{{3e-4, -1e-4, 2e-4}, {4e-4, -2e-4, 1e-4}, {-3e-4, 2e-4, 5e-4}}};
  const auto field = [&](const Vec3& x) {
    Vec3 u;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) u[i] += slope[index(i)][index(j)] * x[j];
    return u;
  };
  const Material steel = samples::steel();
  const double trace = slope[0][0] + slope[1][1] + slope[2][2];
  std::array<double, 6> exact{};
  for (int i = 0; i < 3; ++i) {
    const auto j = index((i + 1) % 3), k = index((i + 2) % 3);
    exact[index(i)] = steel.lame_lambda() * trace + 2 * steel.shear_modulus() * slope[index(i)][index(i)];
    exact[index(3 + i)] = steel.shear_modulus() * (slope[j][k] + slope[k][j]);
  }
  for (const Case& c : patches()) {
    Mesh mesh;
    mesh.add(c.block);
    const SweptBlock& block = mesh.blocks[0];
    const InternalForce force(mesh);
    const auto u = samples::sample(mesh, field);
    AlignedVector<double> f(u.size());
    force.apply(u.data(), f.data());

    const std::set<int> boundary = outline(block.section);
    int inner = 0;
    for_each_node(mesh, [&](const SweptBlock&, int node, int station, std::int64_t slot) {
      const bool end = !block.closed && (station == 0 || station == block.station_count() - 1);
      if (end || boundary.count(node) > 0) return;
      ++inner;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[index(dof(slot, i))], 0, 1e-12 * largest(f)) << c.name;
    });
    EXPECT_GT(inner, 0);

    for (int station = 0; station < block.station_count() - (block.closed ? 0 : 1); ++station)
      for (int quad = 0; quad < static_cast<int>(block.section.quads.size()); ++quad) {
        const auto stress = force.stress(0, quad, station, u.data());
        EXPECT_NEAR(von_mises(stress) / von_mises(exact), 1, 1e-12);
        EXPECT_NEAR((stress[0] + stress[1] + stress[2]) / (exact[0] + exact[1] + exact[2]), 1, 1e-12);
        if (block.sweep == Sweep::revolved) continue;
        for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(stress[i], exact[i], 1e-12 * von_mises(exact));
      }
    const DeformationEnergy energy = force.energy(0, u.data());
    EXPECT_LT(energy.hourglass, 1e-22 * energy.strain);
  }
}

TEST(Patch, RigidMotionsGiveNoForce) {
  for (const Case& c : patches()) {
    Mesh mesh;
    mesh.add(c.block);
    const InternalForce force(mesh);
    AlignedVector<double> stretched(index(3 * mesh.slots));
    force.apply(samples::sample(mesh,
                                [](const Vec3& x) {
                                  return Vec3{x.x, 0, 0};
                                })
                    .data(),
                stretched.data());
    for (int motion = 0; motion < 6; ++motion) {
      Vec3 axis;
      axis[motion % 3] = 1;
      const auto u = samples::sample(mesh, [&](const Vec3& x) { return motion < 3 ? axis : cross(axis, x); });
      AlignedVector<double> f(u.size());
      force.apply(u.data(), f.data());
      // Translations and turns of 1 round off like positions of 1 m.
      EXPECT_LT(largest(f), 1e-11 * largest(stretched)) << c.name << " " << motion;
    }
  }
}

/// Eigenvalues of a symmetric matrix by Jacobi rotations, ascending.
std::vector<double> eigenvalues(ElementStiffness m) {
  constexpr std::size_t n = 24;
  for (int sweep = 0; sweep < 20; ++sweep)
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        if (m[p][q] == 0) continue;
        const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
        const double c = std::cos(angle), s = std::sin(angle);
        for (std::size_t k = 0; k < n; ++k) {
          const double kp = m[k][p], kq = m[k][q];
          m[k][p] = c * kp - s * kq;
          m[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < n; ++k) {
          const double pk = m[p][k], qk = m[q][k];
          m[p][k] = c * pk - s * qk;
          m[q][k] = s * pk + c * qk;
        }
      }
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(m[i][i]);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Element, HasSixZeroModesAndResistsAllOthers) {
  for (const Case& c : patches()) {
    Mesh mesh;
    mesh.add(c.block);
    const InternalForce force(mesh);
    for (int quad = 0; quad < static_cast<int>(c.block.section.quads.size()); ++quad) {
      const ElementStiffness k = force.element_stiffness(0, quad, 2);
      for (std::size_t i = 0; i < 24; ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(k[i][j], k[j][i], 1e-13 * k[0][0]);
      const auto values = eigenvalues(k);
      EXPECT_LT(std::abs(values[0]), 1e-13 * values[23]);
      EXPECT_LT(std::abs(values[5]), 1e-13 * values[23]);
      EXPECT_GT(values[6], 1e-4 * values[23]) << c.name;
    }
  }
}

/// Solves K u = load with the marked unknowns held at zero, by conjugate gradients.
AlignedVector<double> solve(const InternalForce& force, const std::vector<bool>& held,
                            const AlignedVector<double>& load) {
  const std::size_t n = load.size();
  AlignedVector<double> diagonal(n), u(n, 0), r = load, z(n, 0), p(n, 0), kp(n, 0);
  force.diagonal(diagonal.data());
  const auto precondition = [&] {
    double product = 0;
    for (std::size_t i = 0; i < n; ++i) {
      z[i] = held[i] || diagonal[i] == 0 ? 0 : r[i] / diagonal[i];
      product += z[i] * r[i];
    }
    return product;
  };
  double rz = precondition();
  const double first = rz;
  p = z;
  for (int iteration = 0; iteration < 20000 && rz > 1e-20 * first; ++iteration) {
    force.apply(p.data(), kp.data());
    double pkp = 0;
    for (std::size_t i = 0; i < n; ++i) pkp += p[i] * kp[i];
    const double alpha = rz / pkp;
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += alpha * p[i];
      r[i] -= alpha * kp[i];
    }
    const double next = precondition();
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  EXPECT_LE(rz, 1e-20 * first);
  return u;
}

/// A cantilever with one element through its thickness. Axes are 0, 1, 2 = x, y, z.
struct Cantilever {
  int along;          ///< axis of the beam
  int across;         ///< axis of the thickness and of the load
  bool plane_strain;  ///< true if the third axis is held
  double aspect;      ///< element length by thickness
};

constexpr double kSlenderness = 20;  ///< length by thickness

/// Ratio of the tip deflection to that of beam theory [-].
double tip_ratio(const Cantilever& c) {
  const double thickness = 0.01;
  const int count = static_cast<int>(std::lround(kSlenderness / c.aspect));
  const double length = count * c.aspect * thickness;
  double size[3] = {thickness, thickness, thickness};
  int elements[3] = {1, 1, 1};
  size[c.along] = length;
  elements[c.along] = count;
  const Section section = samples::grid_section({elements[1], elements[2], 0, 0, size[1], size[2], 0});
  Mesh mesh;
  mesh.add(make_swept_block("beam", Sweep::extruded, section, {samples::steel(), samples::steel()}, 0,
                            {{elements[0], size[0] / elements[0], 0}}));
  const InternalForce force(mesh);

  const int third = 3 - c.along - c.across;
  std::vector<bool> held(index(3 * mesh.slots), false);
  AlignedVector<double> load(held.size(), 0);
  std::vector<std::size_t> tip;
  for_each_node(mesh, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
    const Vec3 x = position(block, node, station);
    const bool root = x[c.along] < 1e-9;
    const bool low = x[c.across] < 1e-9;
    // The root is held against rigid motion and turning; the section may contract.
    if (root) held[index(dof(slot, c.along))] = true;
    if (root && low) held[index(dof(slot, c.across))] = true;
    if (c.plane_strain || (root && low && x[third] < 1e-9)) held[index(dof(slot, third))] = true;
    if (x[c.along] > length - 1e-9) {
      load[index(dof(slot, c.across))] = 25;
      tip.push_back(index(dof(slot, c.across)));
    }
  });
  const auto u = solve(force, held, load);
  double deflection = 0;
  for (const std::size_t i : tip) deflection += u[i] / 4;

  const Material steel = samples::steel();
  const double nu = steel.poissons_ratio;
  const double modulus = steel.youngs_modulus / (c.plane_strain ? 1 - nu * nu : 1);
  const double inertia = std::pow(thickness, 4) / 12;
  const double bending = 100 * std::pow(length, 3) / (3 * modulus * inertia);
  const double shear = 100 * length / (5.0 / 6 * steel.shear_modulus() * thickness * thickness);
  return deflection / (bending + shear);
}

// Curvature is constant in each of the n elements, which makes the tip deflection 1 - 1/(4 n^2) of the
// theory's: 0.984 for the four elements of aspect 5.
TEST(Element, BendsAsBeamTheoryWithOneElementThroughTheThickness) {
  for (int along = 0; along < 3; ++along)
    for (int across = 0; across < 3; ++across)
      for (const double aspect : {1.0, 2.0, 4.0, 5.0}) {
        if (across == along) continue;
        for (const bool plane_strain : {false, true}) {
          const double expected = 1 - 0.25 * std::pow(aspect / kSlenderness, 2);
          EXPECT_NEAR(tip_ratio({along, across, plane_strain, aspect}), expected, 0.003)
              << along << across << plane_strain << " " << aspect;
        }
      }
}

TEST(LumpedMass, IsThatOfTheMeshedShapeAboutItsCentre) {
  for (const Case& c : patches()) {
    Mesh mesh;
    mesh.add(c.block);
    const InternalForce force(mesh);
    std::vector<double> mass(index(mesh.slots));
    force.lumped_mass(mass.data());
    double total = 0;
    Vec3 moment;
    for_each_node(mesh, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      EXPECT_GT(mass[index(slot)], 0);
      total += mass[index(slot)];
      moment += mass[index(slot)] * position(block, node, station);
    });
    double slots = 0;
    for (const double m : mass) slots += m;
    EXPECT_NEAR(slots, total, 1e-13 * total);
    if (!c.block.node_shift.empty()) continue;

    const Section& section = c.block.section;
    double area = 0;
    double q_moment = 0;
    for (const auto& quad : section.quads)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto a = index(quad[i]), b = index(quad[(i + 1) % 4]);
        const double part = 0.5 * (section.p[a] * section.q[b] - section.p[b] * section.q[a]);
        area += part;
        q_moment += part * (section.q[a] + section.q[b]) / 3;
      }
    double volume = 0;
    for (const Tile& tile : c.block.tiles) {
      const double pitch = c.block.classes[index(tile.pitch_class)].pitch;
      volume +=
          tile.elements * (c.block.sweep == Sweep::extruded ? area * pitch : q_moment * std::sin(pitch));
    }
    EXPECT_NEAR(total / (samples::steel().density * volume), 1, 1e-13) << c.name;
    if (c.block.sweep == Sweep::extruded) {
      EXPECT_NEAR(moment.z / total, q_moment / area, 1e-15);
      EXPECT_NEAR(moment.x / total, 0.5 * (c.block.stations.front() + c.block.stations.back()), 1e-14);
    }
    if (c.block.closed) {
      EXPECT_NEAR(std::hypot(moment.x, moment.z) / total, 0, 1e-15);
    }
  }
}

TEST(ElementFrequency, BoundsThatOfTheBlock) {
  for (const Case& c : patches()) {
    Mesh mesh;
    mesh.add(c.block);
    const InternalForce force(mesh);
    std::vector<double> mass(index(mesh.slots));
    force.lumped_mass(mass.data());
    auto u = samples::random_field(mesh);
    AlignedVector<double> f(u.size());
    double omega2 = 0;
    for (int iteration = 0; iteration < 300; ++iteration) {
      force.apply(u.data(), f.data());
      double work = 0;
      double norm2 = 0;
      for_each_node(mesh, [&](const SweptBlock&, int, int, std::int64_t slot) {
        for (int i = 0; i < 3; ++i) {
          const std::size_t k = index(dof(slot, i));
          work += u[k] * f[k];
          norm2 += mass[index(slot)] * u[k] * u[k];
        }
      });
      omega2 = work / norm2;
      for_each_node(mesh, [&](const SweptBlock&, int, int, std::int64_t slot) {
        for (int i = 0; i < 3; ++i)
          u[index(dof(slot, i))] = f[index(dof(slot, i))] / mass[index(slot)] / omega2;
      });
    }
    const ElementFrequency bound = force.max_frequency(0);
    EXPECT_LE(std::sqrt(omega2), bound.omega);
    EXPECT_GE(std::sqrt(omega2), 0.6 * bound.omega) << c.name;
    EXPECT_DOUBLE_EQ(force.element_frequency(0, bound.quad, bound.station), bound.omega);
  }
}

TEST(Shape, ShiftsThatTurnElementsInsideOutAreListed) {
  Mesh mesh;
  SweptBlock block = samples::extruded();
  block.node_shift[block.slot(5, 7)] = {0, 0, 0.015};
  mesh.add(block);
  const std::string text = samples::refusal<InputError>([&] { const InternalForce force(mesh); });
  for (const char* part : {"block 'bar': ", "turned inside out", "from station 6", "from station 7"})
    samples::expect_part(text, part);
  EXPECT_EQ(text.find("from station 8"), std::string::npos) << text;
}

}  // namespace
}  // namespace tread
