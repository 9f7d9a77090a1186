#include <algorithm>
#include <cmath>
#include <memory>

#include "core/corrugation.hpp"
#include "drivers/bench/kernel_cases.hpp"
#include "kernels/contact/contact.hpp"
#include "kernels/contact/surface_fields.hpp"

namespace tread {

namespace {

constexpr double kRollingRadius = 0.43;  ///< radius of the wheel's rolling circle [m]
constexpr double kCrownRadius = 0.3;     ///< radius of the wheel's profile [m]
constexpr double kHalfWidth = 0.03;      ///< half width of both surfaces [m]
constexpr double kHalfLength = 0.06;     ///< half length of rail and tread [m]
constexpr double kApproach = 42e-6;      ///< lowering of the wheel: semi-axes of 6 and 5 mm [m]
constexpr double kPenetration = 0.03;    ///< share of the overlap that the rail's surface does not follow [-]
constexpr double kPenalty = 5e14;        ///< [Pa/m]
constexpr double kFriction = 0.5;
constexpr double kSpeed = 300 / 3.6;      ///< [m/s]
constexpr double kCreepage = 1e-3;        ///< [-]
constexpr double kFinest = 1.1e-3;        ///< element size of the largest mesh [m]
constexpr double kMostElements = 1.46e6;  ///< number of elements of that mesh

/// Element size [m] with which a mesh of so many elements resolves the patch.
double element_size(std::int64_t elements) {
  return kFinest * std::cbrt(kMostElements / static_cast<double>(elements));
}

/// One row of quads under a surface (p, top(p)).
template <class Top, class Slope>
Section strip(double size, const Top& top, const Slope& slope) {
  const int columns = static_cast<int>(std::ceil(2 * kHalfWidth / size));
  Section section;
  const auto p_of = [&](int i) { return kHalfWidth * (2.0 * i / columns - 1); };
  for (const double depth : {size, 0.0})
    for (int i = 0; i <= columns; ++i) {
      section.p.push_back(p_of(i));
      section.q.push_back(top(p_of(i)) - depth);
    }
  const int upper = columns + 1;
  const auto tangent = [&](int i) {
    const double s = slope(p_of(i));
    return std::array<double, 2>{1 / std::hypot(1, s), s / std::hypot(1, s)};
  };
  for (int i = 0; i < columns; ++i) {
    section.quads.push_back({i, i + 1, upper + i + 1, upper + i});
    section.quad_material.push_back(0);
    section.surface.push_back({i, {upper + i, upper + i + 1}, {tangent(i), tangent(i + 1)}});
  }
  return section;
}

Mesh surfaces(double size) {
  const std::vector<Material> steel = {{"steel", 205.9e9, 0.3, 7790, 0}};
  const int along = static_cast<int>(std::ceil(2 * kHalfLength / size));
  Mesh mesh;
  mesh.add(make_swept_block("rail", Sweep::extruded,
                            strip(
                                size, [](double) { return 0.0; }, [](double) { return 0.0; }),
                            steel, -kHalfLength, {{along, 2 * kHalfLength / along, 0}}));
  mesh.add(make_swept_block("wheel", Sweep::revolved,
                            strip(
                                size, [](double y) { return kRollingRadius - y * y / (2 * kCrownRadius); },
                                [](double y) { return -y / kCrownRadius; }),
                            steel, -kHalfLength / kRollingRadius,
                            {{along, 2 * kHalfLength / kRollingRadius / along, 0}}));
  return mesh;
}

/// A wheel that rolls with creepage over a rail. The rail's surface follows nearly all of their overlap.
struct Patch {
  explicit Patch(double size)
      : mesh(surfaces(size)),
        contact(mesh, options(), Corrugation()),
        fields(contact.nodes().grid()),
        u(static_cast<std::size_t>(3 * mesh.slots), 0.0),
        v(u.size(), 0.0),
        mass(static_cast<std::size_t>(mesh.slots), 0.5 * 7790 * size * size * size),
        dt(8.9e-8 * size / kFinest) {
    wheel.origin = {0, 0, contact.touching_height() - kApproach};
    wheel.velocity = {kSpeed, 0, 0};
    wheel.spin = (1 + kCreepage) * kSpeed / kRollingRadius;
    press();
    u_before = u;
    contact.find_static({u.data(), nullptr, &wheel});
    contact.begin();
    search();
  }

  static ContactOptions options() {
    ContactOptions options;
    options.rail_block = 0;
    options.wheel_block = 1;
    options.penalty = kPenalty;
    options.friction = CoulombFriction{kFriction};
    options.wheel_radius = kRollingRadius;
    return options;
  }

  void press() {
    const SweptBlock& rail = mesh.blocks.front();
    for (int station = 0; station < rail.station_count(); ++station)
      for (int node = 0; node < rail.section.nodes(); ++node) {
        const Vec3 x = position(rail, node, station);
        const double overlap = kApproach - x.x * x.x / (2 * kRollingRadius) - x.y * x.y / (2 * kCrownRadius);
        u[static_cast<std::size_t>(dof(rail.slot(node, station), 2))] =
            -(1 - kPenetration) * std::max(0.0, overlap);
      }
  }

  /// Searches and advances the time, so that faces out of reach are examined as often as in a run.
  void search() {
    contact.search({u.data(), v.data(), &wheel}, time, dt);
    time += dt;
  }
  void resolve() { contact.resolve({u.data(), v.data(), mass.data()}, wheel, dt); }
  void before_resolve() {
    u = u_before;
    std::fill(v.begin(), v.end(), 0.0);
    search();
  }

  Mesh mesh;
  Contact contact;
  SurfaceFields fields;
  AlignedVector<double> u, v, u_before, mass;
  BodyFrame wheel;
  double dt;        ///< [s]
  double time = 0;  ///< [s]
};

/// Completes a kernel on a patch of so many points or nodes, of `bytes` each.
PreparedKernel prepared(TimedCall timed, std::size_t units, double bytes) {
  PreparedKernel kernel;
  kernel.timed = std::move(timed);
  kernel.units = static_cast<std::int64_t>(units);
  kernel.work.bytes = bytes;
  kernel.working_set = static_cast<std::int64_t>(bytes * static_cast<double>(units));
  return kernel;
}

constexpr double kHistoryBytes = 3 * sizeof(double);  ///< bytes of a point: pressure and shear

PreparedKernel prepare_search(std::int64_t elements) {
  const auto patch = std::make_shared<Patch>(element_size(elements));
  return prepared({[patch] { patch->search(); }}, patch->contact.points().size(),
                  sizeof(ContactPoint) + kHistoryBytes);
}

PreparedKernel prepare_resolve(std::int64_t elements) {
  const auto patch = std::make_shared<Patch>(element_size(elements));
  return prepared({[patch] { patch->resolve(); }, [patch] { patch->before_resolve(); }},
                  patch->contact.points().size(), 2 * (sizeof(ContactPoint) + kHistoryBytes));
}

PreparedKernel prepare_fields(std::int64_t elements) {
  const auto patch = std::make_shared<Patch>(element_size(elements));
  patch->resolve();
  const PatchNodes& nodes = patch->contact.nodes();
  const auto stations = static_cast<std::size_t>(nodes.last() - nodes.first() + 1);
  // Largest pressure, largest shear, frictional work: read and written.
  return prepared({[patch] { patch->fields.add_step(patch->contact.nodes()); }},
                  stations * static_cast<std::size_t>(nodes.grid().rows()),
                  sizeof(NodalContact) + 2 * 3 * sizeof(double));
}

}  // namespace

void add_contact_cases(std::vector<KernelCase>& cases) {
  cases.push_back({"contact_search", "exact profiles", "double", "point", prepare_search});
  cases.push_back({"contact_resolve", "friction", "double", "point", prepare_resolve});
  cases.push_back({"surface_fields", "step", "double", "surface node", prepare_fields});
}

}  // namespace tread
