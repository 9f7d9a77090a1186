#include "drivers/preload.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "drivers/static_system.hpp"
#include "kernels/solver/chunks.hpp"
#include "kernels/solver/two_level_preconditioner.hpp"

namespace tread {

namespace {

/// Adds the force that gives a block's nodes this acceleration; `angle`: of the wheel's frame [rad].
void add_acceleration(const Model& model, const SweptBlock& block, double angle, const Vec3& acceleration,
                      double* load) {
  for (int station = 0; station < block.station_count(); ++station) {
    const Vec3 local = to_local(block, station, angle, acceleration);
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.base + block.slot(node, station);
      const double m = model.mass[static_cast<std::size_t>(slot)];
      for (int c = 0; c < 3; ++c) load[dof(slot, c)] += m * local[c];
    }
  }
}

/// Adds the centrifugal force of a revolved block. `spin` [rad/s]
void add_centrifugal(const Model& model, const SweptBlock& block, double spin, double* load) {
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.base + block.slot(node, station);
      load[dof(slot, 2)] += model.mass[static_cast<std::size_t>(slot)] * spin * spin *
                            block.section.q[static_cast<std::size_t>(node)];
    }
}

/// Gravity, centrifugal force and vehicle weight as an external force field.
AlignedVector<double> external_load(const Model& model, const BodyFrame& frame, double spin) {
  AlignedVector<double> load(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  for (const SweptBlock& block : model.mesh.blocks) {
    add_acceleration(model, block, 0, {0, 0, -model.scene.gravity}, load.data());
    if (block.sweep == Sweep::revolved) add_centrifugal(model, block, spin, load.data());
  }
  if (!model.journal.empty()) model.journal.add(load.data(), frame, {0, 0, -model.journal_load()});
  if (model.guide) {
    model.guide->reduce(load.data());
    load[static_cast<std::size_t>(model.guide->unknown())] +=
        (model.guide->counterweight(spin, frame.angle) - model.journal_load()) / model.guide->per_rise();
  }
  return load;
}

/// Adds -m rate^2 d2u/ds2, the inertia of material that passes through the steady deflection u, s the station
/// coordinate.
void add_steady_inertia(const Model& model, const SteadyMotion& motion, const double* u, double* load) {
  for (const SweptBlock& block : model.mesh.blocks) {
    const double rate = block.sweep == Sweep::revolved ? motion.spin : motion.speed;
    if (rate == 0) continue;
    parallel_ranges(block.station_count(), [&](std::int64_t first, std::int64_t last) {
      for (int station = static_cast<int>(first); station < last; ++station) {
        if (!block.closed && (station == 0 || station == block.station_count() - 1)) continue;
        const LineCell cell = station_cell(block, station);
        const double scale = -2 * rate * rate / (cell.length_before + cell.length);
        for (int node = 0; node < block.section.nodes(); ++node) {
          // Values in the basis of the middle station.
          const auto value = [&](int at, double turned) {
            const std::int64_t slot = block.base + block.slot(node, at);
            const Vec3 v{u[dof(slot, 0)], u[dof(slot, 1)], u[dof(slot, 2)]};
            return block.sweep == Sweep::revolved ? turn(v, turned) : v;
          };
          const Vec3 here = value(station, 0);
          const Vec3 second = (1 / cell.length) * (value(cell.second, cell.length) - here) -
                              (1 / cell.length_before) * (here - value(cell.before, -cell.length_before));
          const std::int64_t slot = block.base + block.slot(node, station);
          const double m = model.mass[static_cast<std::size_t>(slot)];
          for (int c = 0; c < 3; ++c) load[dof(slot, c)] += m * scale * second[c];
        }
      }
    });
  }
}

/// Adds what presses on the wheelset when it has been rolling.
void add_run_in(const Model& model, const RunIn& run_in, const BodyFrame& frame, double* load) {
  model.journal.add(load, frame, {0, 0, -run_in.journal_force});
  const double per_mass = run_in.inertia_force / model.wheelset->mass();
  for (const int b : model.wheelset->blocks())
    add_acceleration(model, model.mesh.blocks[static_cast<std::size_t>(b)], frame.angle, {0, 0, -per_mass},
                     load);
}

/// The wheel's translation along x and rotation about the axle, held in the mass-weighted mean; without a
/// rail its height too.
std::optional<HeldMotions> held_wheel(const Model& model, const AlignedVector<double>& diagonal) {
  if (!model.wheelset || model.guide) return std::nullopt;
  const auto n = static_cast<std::size_t>(3 * model.mesh.slots);
  const std::size_t count = model.contact ? 2 : 3;
  std::vector<AlignedVector<double>> motions(count, AlignedVector<double>(n, 0.0));
  auto means = motions;
  for (const int b : model.wheelset->blocks()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const std::int64_t slot = block.base + block.slot(node, station);
        const Vec3 ahead = to_local(block, station, 0, {1, 0, 0});
        const Vec3 up = to_local(block, station, 0, {0, 0, 1});
        const std::array<Vec3, 3> motion = {ahead,
                                            Vec3{block.section.q[static_cast<std::size_t>(node)], 0, 0}, up};
        for (std::size_t m = 0; m < count; ++m)
          for (int c = 0; c < 3; ++c) {
            const auto unknown = static_cast<std::size_t>(dof(slot, c));
            if (diagonal[unknown] <= 0) continue;
            motions[m][unknown] = motion[m][c];
            means[m][unknown] = model.mass[static_cast<std::size_t>(slot)] * motion[m][c];
          }
      }
  }
  return HeldMotions(std::move(motions), std::move(means));
}

/// Adds the carrier's unknown, which couples to the whole bore, to a preconditioner that does not know it.
class WithCarrier : public Preconditioner {
 public:
  WithCarrier(const Preconditioner& others, std::int64_t unknown, double stiffness)
      : others_(&others), unknown_(unknown), stiffness_(stiffness) {}
  void apply(const double* r, double* z) const override {
    others_->apply(r, z);
    z[unknown_] = r[unknown_] / stiffness_;
  }

 private:
  const Preconditioner* others_;
  std::int64_t unknown_;
  double stiffness_;  ///< [N/m]
};

/// Of the wheel's elements against the carrier's unknown alone [N/m].
double carrier_stiffness(const StaticSystem& system, std::int64_t unknown) {
  AlignedVector<double> unit(system.diagonal().size(), 0.0);
  AlignedVector<double> force(unit.size());
  unit[static_cast<std::size_t>(unknown)] = 1;
  system.apply(unit.data(), force.data());
  return force[static_cast<std::size_t>(unknown)];
}

/// Why Newton's method finds no balance of the external `load`, whose norm is `size`; `residual`: what is
/// left of it [N].
std::string why_unbalanced(const Model& model, double residual, double size) {
  constexpr double kRounding = 1e-8;  // of forces that cancel inside the bodies
  if (residual < kRounding * size)
    return fmt::format(
        "the wheel load of {:.3g} N is lost in the rounding of the bodies' own forces; raise it, lower "
        "motion.speed or state motion.spin_in_preload = false",
        model.wheel_load());
  return fmt::format(
      "under the wheel load of {:.4g} kN and the spin of this speed the bodies move too far for small "
      "strain, or "
      "points keep entering and leaving the patch; a lower load, speed or motion.creepage, a thicker wheel, "
      "a finer "
      "quality or a softer contact.penetration_ratio helps",
      1e-3 * model.wheel_load());
}

std::vector<TiedSlot> tied_slots(const Model& model) {
  return model.ties ? model.ties->tied_slots() : std::vector<TiedSlot>{};
}

/// What the static state shows.
void describe(const Model& model, Preload& out) {
  if (model.contact) {
    model.contact->require_room(out.wheel);
    out.contact = model.contact->totals();
    out.max_pressure = model.contact->nodes().max_pressure();
  }
  const double* u = out.displacement.data();
  out.tilt = wheel_tilt(model, u, out.wheel.angle);
  const int base = model.index.rail_foot();
  if (base >= 0 && model.index.tread >= 0) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(base)];
    out.rail_deflection = -attach(block, "foot", 0, 0).value(u, 2);
  }
  if (model.index.slab >= 0)
    out.slab_deflection =
        -attach(model.mesh.blocks[static_cast<std::size_t>(model.index.slab)], "top", 0, 0).value(u, 2);
}

}  // namespace

double wheel_tilt(const Model& model, ConstNodeField displacement, double angle) {
  if (model.index.tread < 0) return 0;
  // The tread's lateral displacement varies as the depth below the axle.
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  double moment = 0;
  double second = 0;
  for (const SurfaceEdge& edge : block.section.surface)
    for (int station = 0; station < block.station_count(); ++station) {
      const double down = block.section.q[static_cast<std::size_t>(edge.node[0])] *
                          std::cos(block.stations[static_cast<std::size_t>(station)] + angle);
      moment += down * displacement[dof(block.base + block.slot(edge.node[0], station), 1)];
      second += down * down;
    }
  return moment / second;
}

SteadyMotion steady_motion(const Model& model) {
  SteadyMotion out;
  if (!model.scene.motion || !model.scene.wheel) return out;
  const MotionSpec& motion = *model.scene.motion;
  if (motion.spin_in_preload) out.spin = motion.speed / model.wheel_radius() * motion.spin_ratio();
  if (model.scene.start() == "moving") out.speed = motion.speed;
  out.rolling = model.scene.start() == "rolling" && motion.speed > 0;
  return out;
}

Preload solve_preload(Model& model, const SteadyMotion& motion, const ProgressText& progress) {
  constexpr int kMaxNewton = 40;
  constexpr double kTolerance = 1e-7;
  const StaticSystem system(model);
  const auto n = static_cast<std::int64_t>(system.diagonal().size());

  Preload out;
  out.displacement.assign(static_cast<std::size_t>(n), 0.0);
  if (model.contact) {
    // The undeformed surfaces overlap by about the Hertz patch when they are half the approach into each
    // other.
    const double overlap = 0.6 * model.hertz_patch.approach;
    const double depth = model.contact->corrugation().depth(0, model.contact->corrugation().centre());
    out.wheel.origin = {0, 0, model.contact->touching_height() - depth - overlap};
  }
  AlignedVector<double> load = external_load(model, out.wheel, motion.spin);
  const auto held = held_wheel(model, system.diagonal());
  AlignedVector<double> reduced = load;
  system.reduce(reduced.data());
  const double size = std::sqrt(dot(n, reduced.data(), reduced.data()));
  if (size == 0) return out;  // nothing loads the bodies: they rest as they are
  const double scale = model.wheel_load() > 0 ? model.wheel_load() : size;

  std::vector<Spring> fixed_springs;
  if (model.fastenings) fixed_springs = model.fastenings->springs();
  std::vector<Spring> springs;
  const Operator elastic = [&](const double* x, double* y) { system.apply(x, y); };
  const Operator tangent = [&](const double* x, double* y) {
    system.apply(x, y);
    add_springs(springs, x, y);
  };
  TwoLevelPreconditioner preconditioner(model.mesh, elastic, system.diagonal(), tied_slots(model), {});
  std::optional<WithCarrier> with_carrier;
  if (model.guide)
    with_carrier.emplace(preconditioner, model.guide->unknown(),
                         carrier_stiffness(system, model.guide->unknown()));
  const Preconditioner* precondition = &preconditioner;
  if (with_carrier) precondition = &*with_carrier;

  AlignedVector<double> residual(static_cast<std::size_t>(n));
  AlignedVector<double> correction(static_cast<std::size_t>(n));
  double* u = out.displacement.data();
  for (int iteration = 0;; ++iteration) {
    system.expand(u);
    springs = fixed_springs;
    model.internal->internal_force(u, nullptr, residual.data());
    add_springs(fixed_springs, u, residual.data());
    if (model.contact) {
      model.contact->find_static({u, nullptr, &out.wheel});
      model.contact->add_forces(residual.data());
      for (Spring& spring : model.contact->springs()) springs.push_back(std::move(spring));
      if (model.contact->points().empty())
        throw NumericalError(
            iteration == 0
                ? fmt::format(
                      "preload: no integration point of the rail touches the wheel; check "
                      "wheel.lateral_offset, and raise the wheel load of {:.3g} N if its patch is smaller "
                      "than an element",
                      model.wheel_load())
                : fmt::format("preload: after {} iterations no point of the wheel touches the rail: {}",
                              iteration, why_unbalanced(model, out.residual * scale, size)));
    }
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        residual[i] = load[i] - residual[i];
    });
    add_steady_inertia(model, motion, u, residual.data());
    system.reduce(residual.data());
    if (held) {
      const auto work = held->work(residual.data());
      out.held_force_x = work[0];
      out.held_moment = work[1];
      held->balance(residual.data());
    }
    out.residual = std::sqrt(dot(n, residual.data(), residual.data())) / scale;
    progress(fmt::format("iteration {}, residual {:.2e}, {} points in contact, F_N {:.3f} kN", iteration,
                         out.residual, model.contact ? model.contact->points().size() : 0,
                         model.contact ? -1e-3 * model.contact->totals().force_on_rail.z : 0.0));
    out.newton_iterations = iteration;
    if (out.residual < kTolerance) {
      if (!out.run_in) describe(model, out);
      if (!motion.rolling || out.run_in) break;
      out.run_in = run_in(model, axle_bending(model, u, out.wheel));
      add_run_in(model, *out.run_in, out.wheel, load.data());
      continue;
    }
    if (iteration == kMaxNewton)
      throw NumericalError(fmt::format(
          "preload: residual {:.2e} of the load after {} iterations (wanted {:.0e}): {}", out.residual,
          iteration, kTolerance, why_unbalanced(model, out.residual * scale, size)));
    preconditioner.update(tangent, springs);
    std::fill(correction.begin(), correction.end(), 0.0);
    const double wanted = std::clamp(0.3 * kTolerance / out.residual, 1e-7, 1e-3);
    const CgResult solved = conjugate_gradients(tangent, precondition, held ? &*held : nullptr, residual,
                                                correction, {wanted, 5000});
    if (!solved.converged)
      throw NumericalError(fmt::format("preload: the linear solver stalled at {:.2e} after {} iterations",
                                       solved.relative_residual, solved.iterations));
    out.cg_iterations += solved.iterations;
    add_scaled(n, 1.0, correction.data(), u);
  }
  return out;
}

}  // namespace tread
