// Elements far from cubes: patch test and stable step for long, skewed and nearly incompressible ones. Shapes
// that cannot be elements are refused with a list.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/small_models.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/solver/stable_step.hpp"

namespace tread {

namespace {

constexpr int kQuads = 3;     ///< quads along both sides of the section
constexpr int kElements = 9;  ///< elements along the sweep: more than one tile
constexpr double kModulus = 205.9e9;

/// A block of elements of one shape.
struct Shape {
  std::array<double, 3> size{};  ///< sizes along the sweep, across, up [m]
  double skew_section = 0;       ///< angle by which the quads lean [rad]
  double skew_sweep = 0;         ///< angle by which the elements lean along the sweep [rad]
  double poissons_ratio = 0.3;
};

Section grid(const Shape& shape) {
  Section section;
  for (int row = 0; row <= kQuads; ++row)
    for (int column = 0; column <= kQuads; ++column) {
      const double q = row * shape.size[2];
      section.p.push_back(column * shape.size[1] + q * std::tan(shape.skew_section));
      section.q.push_back(q);
    }
  constexpr int kStride = kQuads + 1;
  for (int row = 0; row < kQuads; ++row)
    for (int column = 0; column < kQuads; ++column) {
      const int node = row * kStride + column;
      section.quads.push_back({node, node + 1, node + kStride + 1, node + kStride});
      section.quad_material.push_back(0);
    }
  return section;
}

Material material_of(const Shape& shape) {
  return {"steel", kModulus, shape.poissons_ratio, kSteelDensity, 0, 0};
}

SweptBlock block_of(const Shape& shape) {
  SweptBlock block = make_swept_block("block", Sweep::extruded, grid(shape), {material_of(shape)}, 0,
                                      {{kElements, shape.size[0], 0}});
  if (shape.skew_sweep == 0) return block;
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node)
      block.node_shift[block.slot(node, station)] = {
          block.section.q[static_cast<std::size_t>(node)] * std::tan(shape.skew_sweep), 0, 0};
  return block;
}

/// Calls visit(node, station, slot).
template <class Visit>
void for_each_node(const SweptBlock& block, const Visit& visit) {
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node)
      visit(node, station, block.base + block.slot(node, station));
}

struct Judged {
  double inner_force = 0;   ///< largest force inside the block / largest force on it, of a linear field [-]
  double stress_error = 0;  ///< largest stress error / Von Mises equivalent [-]
  double step = 0;          ///< computed stable step [s]
  bool holds = false;       ///< true if the step is stable and 1.01 of it is not
};

void patch_test(const Mesh& mesh, const InternalForce& force, const Material& steel, Judged& judged) {
  constexpr double kSlope[3][3] = {{3e-4, -1e-4, 2e-4}, {4e-4, -2e-4, 1e-4}, {-3e-4, 2e-4, 5e-4}};
  const SweptBlock& block = mesh.blocks[0];
  AlignedVector<double> u(static_cast<std::size_t>(3 * mesh.slots), 0);
  AlignedVector<double> f(u.size());
  for_each_node(block, [&](int node, int station, std::int64_t slot) {
    const Vec3 x = position(block, node, station);
    for (int i = 0; i < 3; ++i)
      u[static_cast<std::size_t>(dof(slot, i))] =
          kSlope[i][0] * x.x + kSlope[i][1] * x.y + kSlope[i][2] * x.z;
  });
  force.apply(u.data(), f.data());
  double inner = 0;
  double outer = 0;
  for_each_node(block, [&](int node, int station, std::int64_t slot) {
    const int row = node / (kQuads + 1);
    const int column = node % (kQuads + 1);
    const bool inside =
        row > 0 && row < kQuads && column > 0 && column < kQuads && station > 0 && station < kElements;
    for (int i = 0; i < 3; ++i) {
      double& largest = inside ? inner : outer;
      largest = std::max(largest, std::abs(f[static_cast<std::size_t>(dof(slot, i))]));
    }
  });
  judged.inner_force = inner / outer;

  std::array<double, 6> exact{};
  const double trace = kSlope[0][0] + kSlope[1][1] + kSlope[2][2];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    exact[i] = steel.lame_lambda() * trace + 2 * steel.shear_modulus() * kSlope[i][i];
    exact[3 + i] = steel.shear_modulus() * (kSlope[j][k] + kSlope[k][j]);
  }
  for (int quad = 0; quad < kQuads * kQuads; ++quad)
    for (int station = 0; station < kElements; ++station) {
      const std::array<double, 6> stress = force.stress(0, quad, station, u.data());
      for (std::size_t i = 0; i < 6; ++i)
        judged.stress_error =
            std::max(judged.stress_error, std::abs(stress[i] - exact[i]) / von_mises(exact));
    }
}

/// Returns true if a disturbance stays bounded over many steps dt of the free block.
bool stays_bounded(const Mesh& mesh, const InternalForce& force, const AlignedVector<double>& inverse_mass,
                   double dt) {
  constexpr int kSteps = 1000;
  AlignedVector<double> u(static_cast<std::size_t>(3 * mesh.slots), 0);
  AlignedVector<double> v(u.size(), 0), f(u.size(), 0);
  for_each_node(mesh.blocks[0], [&](int node, int station, std::int64_t slot) {
    for (int i = 0; i < 3; ++i)
      v[static_cast<std::size_t>(dof(slot, i))] = std::sin(97.0 * node + 31.0 * station + 7.0 * i);
  });
  const double start = 3.0 * static_cast<double>(mesh.blocks[0].nodes());
  const TimeUpdate update(mesh, inverse_mass.data());
  double square = 0;
  for (int step = 0; step < kSteps && square < 1e12 * start; ++step) {
    force.apply(u.data(), f.data());
    update.move_all({dt, 0, {}}, {u.data(), v.data(), f.data()});
    square = 0;
    for (const double value : v) square += value * value;
  }
  return square < 1e7 * start;  // amplitudes at the limit itself grow like steps
}

void step_test(const Mesh& mesh, const InternalForce& force, Judged& judged) {
  AlignedVector<double> mass(static_cast<std::size_t>(mesh.slots), 0);
  force.lumped_mass(mass.data());
  AlignedVector<double> inverse(mass.size(), 0), by_unknown(3 * mass.size(), 0);
  for (std::int64_t slot = 0; slot < mesh.slots; ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    if (mass[i] > 0) inverse[i] = 1 / mass[i];
    for (int c = 0; c < 3; ++c) by_unknown[static_cast<std::size_t>(dof(slot, c))] = inverse[i];
  }
  const Operator k = [&](const double* x, double* y) { force.apply(x, y); };
  judged.step = stable_step(highest_frequency(k, by_unknown).omega, 0);
  judged.holds = stays_bounded(mesh, force, inverse, judged.step) &&
                 !stays_bounded(mesh, force, inverse, 1.01 * judged.step);
}

Judged judge(const Shape& shape) {
  Mesh mesh;
  mesh.add(block_of(shape));
  const InternalForce force(mesh);
  Judged judged;
  patch_test(mesh, force, material_of(shape), judged);
  step_test(mesh, force, judged);
  return judged;
}

/// Shapes of one kind, by the property that makes them extreme.
struct Family {
  std::string name;
  std::string label;  ///< label of the abscissa
  std::vector<double> at;
  std::function<Shape(double)> shape;
};

std::vector<Family> families(const VerifyInputs& inputs) {
  const double h = inputs["element_size"];
  const double longest = inputs["aspect"];
  const double skew = inputs["skew"];
  const double nu = inputs["poissons_ratio"];
  std::vector<double> aspects, angles, ratios;
  for (const double share : {0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0})
    aspects.push_back(std::pow(longest, share));
  for (int i = 0; i <= 6; ++i) angles.push_back(skew * i / 6);
  for (const double share : {0.0, 0.3, 0.6, 0.8, 0.9, 0.96, 1.0}) ratios.push_back(nu * share);
  const double radian = std::numbers::pi / 180;
  return {{"long along the sweep", "Length / width [-]", aspects,
           [=](double a) {
             return Shape{{a * h, h, h}, 0, 0, 0.3};
           }},
          {"thin plates", "Width / thickness [-]", aspects,
           [=](double a) {
             return Shape{{a * h, a * h, h}, 0, 0, 0.3};
           }},
          {"long across the sweep", "Width / length [-]", aspects,
           [=](double a) {
             return Shape{{h, a * h, h}, 0, 0, 0.3};
           }},
          {"skewed section", "Angle [degrees]", angles,
           [=](double a) {
             return Shape{{h, h, h}, a * radian, 0, 0.3};
           }},
          {"skewed along the sweep", "Angle [degrees]", angles,
           [=](double a) {
             return Shape{{h, h, h}, 0, a * radian, 0.3};
           }},
          {"nearly incompressible", "Poisson's ratio [-]", ratios,
           [=](double r) {
             return Shape{{h, h, h}, 0, 0, r};
           }},
          {"long, skewed and nearly incompressible", "Length / width [-]", aspects, [=](double a) {
             return Shape{{a * h, h, h}, skew * radian, 0, nu};
           }}};
}

/// Courant number of the fastest wave over the shortest edge.
double courant(const Shape& shape, double step) {
  return step * material_of(shape).pressure_wave_speed() /
         *std::min_element(shape.size.begin(), shape.size.end());
}

Finding refusal(const std::string& what, const std::vector<std::string>& parts,
                const std::function<void()>& act) {
  return {what + ": refused with a list", "-", refused(act, parts) ? 1.0 : 0.0, 1, 0.0, true};
}

std::vector<Finding> refusals(double h) {
  const Shape cube{{h, h, h}, 0, 0, 0.3};
  const auto changed = [=](auto change) {
    return [=] {
      Section section = grid(cube);
      change(section);
      validate(section, "section");
    };
  };
  return {refusal("inverted quads", {"2 faults", "quad 3 is inverted", "quad 4 is inverted"},
                  changed([](Section& s) {
                    std::swap(s.quads[3][1], s.quads[3][3]);
                    std::swap(s.quads[4][1], s.quads[4][3]);
                  })),
          refusal("a quad without area", {"quad 0 is inverted, flat"}, changed([](Section& s) {
                    s.quads[0] = {0, 1, 2, 1};
                  })),
          refusal("a repeated quad", {"quad 9 repeats an earlier one"}, changed([](Section& s) {
                    s.quads.push_back(s.quads[4]);
                    s.quad_material.push_back(0);
                  })),
          refusal("a node without a quad", {"node 16 belongs to no quad"}, changed([](Section& s) {
                    s.p.push_back(0);
                    s.q.push_back(0);
                  })),
          refusal("elements turned inside out by moved nodes",
                  {"turned inside out", "from station 2", "from station 3"}, [=] {
                    Mesh mesh;
                    SweptBlock block = block_of(cube);
                    block.node_shift[block.slot(5, 3)] = {0, 0, 1.5 * h};
                    mesh.add(block);
                    const InternalForce force(mesh);
                  })};
}

CaseResult extremes_elements(const VerifyInputs& inputs, const ProgressText& progress) {
  const OneThread one_thread;
  CaseResult result;
  for (const Family& family : families(inputs)) {
    Judged worst;
    worst.holds = true;
    Series step{family.name, {}, {}, Stroke::solid};
    for (const double at : family.at) {
      const Shape shape = family.shape(at);
      const Judged judged = judge(shape);
      worst.inner_force = std::max(worst.inner_force, judged.inner_force);
      worst.stress_error = std::max(worst.stress_error, judged.stress_error);
      worst.holds = worst.holds && judged.holds;
      step.x.push_back(at);
      step.y.push_back(courant(shape, judged.step));
      progress(fmt::format("{} {:.3g}: inner forces {:.1e}, stress {:.1e}, step {:.3e} s ({})", family.name,
                           at, judged.inner_force, judged.stress_error, judged.step,
                           judged.holds ? "holds" : "does not hold"));
    }
    const auto find = [&](const char* what, double value, double reference, std::optional<double> bound) {
      result.findings.push_back({family.name + ": " + what, "-", value, reference, bound, true});
    };
    find("largest inner force of a linear field", worst.inner_force, 0, 1e-10);
    find("largest error of its stress", worst.stress_error, 0, 1e-10);
    find("computed step stable, 1.01 of it not", worst.holds ? 1 : 0, 1, 0.0);
    find("step x wave speed / shortest edge, at the end of the range", step.y.back(), step.y.front(), {});
    Figure figure;
    figure.title = family.name;
    figure.x_label = family.label;
    figure.panels = {{"Stable step x wave speed / shortest edge [-]", {step}, {}, 200, std::nullopt}};
    result.figures.push_back(figure);
  }
  const std::vector<Finding> refused = refusals(inputs["element_size"]);
  result.findings.insert(result.findings.end(), refused.begin(), refused.end());
  return result;
}

}  // namespace

VerifyCase extremes_elements_case() {
  std::vector<VerifyInput> inputs = {
      {"element_size", &kLength, "mm", 5e-3, {1e-5, 1}, "the elements' shortest edge"},
      {"aspect", nullptr, "", 50, {1, 200}, "longest over shortest edge, up to which is tried"},
      {"skew", nullptr, "", 60, {0, 75}, "angle in degrees up to which is tried"},
      {"poissons_ratio", nullptr, "", 0.49, {0, 0.499}, "Poisson's ratio up to which is tried"}};
  return {"extremes_elements",
          "patch test and stable step of long, skewed and nearly incompressible elements", std::move(inputs),
          extremes_elements, kExtremes};
}

}  // namespace tread
