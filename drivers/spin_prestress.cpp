#include "drivers/spin_prestress.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "kernels/internal_force.hpp"
#include "kernels/solver/conjugate_gradients.hpp"

namespace tread {

namespace {

/// One element of every quad, symmetric about its middle: the two stations carry the same (y, r), no t.
struct Slice {
  Mesh mesh;
  std::optional<Ties> ties;

  Slice(const Mesh& source, const std::vector<int>& wheel, const std::vector<TieSpec>& specs) {
    constexpr double pitch = 0.01;
    std::vector<int> place(source.blocks.size(), -1);
    for (const int b : wheel) {
      const SweptBlock& block = source.blocks[static_cast<std::size_t>(b)];
      place[static_cast<std::size_t>(b)] = mesh.add(
          make_swept_block(block.name, Sweep::revolved, block.section, block.materials, 0, {{1, pitch, 0}}));
    }
    std::vector<TieSpec> own;
    for (TieSpec spec : specs) {
      spec.secondary = place[static_cast<std::size_t>(spec.secondary)];
      spec.primary = place[static_cast<std::size_t>(spec.primary)];
      if (spec.secondary >= 0 && spec.primary >= 0) own.push_back(spec);
    }
    ties.emplace(mesh, own);
  }

  /// Makes a field the same at both stations and removes t: the projection on axisymmetric fields.
  void project(double* field) const {
    for (const SweptBlock& block : mesh.blocks)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const std::int64_t a = block.base + block.slot(node, 0);
        const std::int64_t b = block.base + block.slot(node, 1);
        field[dof(a, 0)] = field[dof(b, 0)] = 0;
        for (int c = 1; c < 3; ++c) {
          const double mean = 0.5 * (field[dof(a, c)] + field[dof(b, c)]);
          field[dof(a, c)] = field[dof(b, c)] = mean;
        }
      }
  }
};

}  // namespace

SpinPrestress spin_prestress(const Mesh& mesh, const std::vector<int>& wheel, const std::vector<TieSpec>& ties,
                             double spin) {
  const Slice slice(mesh, wheel, ties);
  const InternalForce internal(slice.mesh);
  const auto n = static_cast<std::size_t>(3 * slice.mesh.slots);
  AlignedVector<double> full(n, 0.0);
  const Operator a = [&](const double* x, double* y) {
    std::copy(x, x + n, full.begin());
    slice.ties->follow(full.data());
    internal.apply(full.data(), y);
    slice.ties->gather(y);
    slice.project(y);
  };

  AlignedVector<double> mass(static_cast<std::size_t>(slice.mesh.slots), 0.0);
  internal.lumped_mass(mass.data());
  AlignedVector<double> load(n, 0.0);
  AlignedVector<double> diagonal(n, 0.0);
  AlignedVector<double> shift(n, 0.0);
  internal.diagonal(diagonal.data());
  for (const SweptBlock& block : slice.mesh.blocks)
    for (int node = 0; node < block.section.nodes(); ++node)
      for (int station = 0; station < 2; ++station) {
        const std::int64_t slot = block.base + block.slot(node, station);
        load[static_cast<std::size_t>(dof(slot, 2))] =
            mass[static_cast<std::size_t>(slot)] * spin * spin * block.section.q[static_cast<std::size_t>(node)];
        shift[static_cast<std::size_t>(dof(slot, 1))] = 1;
      }
  for (const std::int64_t slot : slice.ties->secondary_slots())
    for (int c = 0; c < 3; ++c) {
      diagonal[static_cast<std::size_t>(dof(slot, c))] = 0;
      shift[static_cast<std::size_t>(dof(slot, c))] = 0;
    }
  slice.ties->gather(load.data());
  slice.project(load.data());

  AlignedVector<double> u(n, 0.0);
  const JacobiPreconditioner jacobi(diagonal);
  const HeldMotions along_axis({shift}, {shift});
  const CgResult result = conjugate_gradients(a, &jacobi, &along_axis, load, u, {1e-10, 20000});
  if (!result.converged)
    throw NumericalError("the stress of the spinning wheel was not found in 20000 iterations; check the wheel's sections");
  slice.ties->follow(u.data());

  SpinPrestress out;
  for (std::size_t b = 0; b < slice.mesh.blocks.size(); ++b) {
    const SweptBlock& block = slice.mesh.blocks[b];
    auto& stress = out.stress.emplace_back();
    for (int quad = 0; quad < static_cast<int>(block.section.quads.size()); ++quad) {
      const auto s = internal.stress(static_cast<int>(b), quad, 0, u.data());
      stress.push_back({s[0], s[1], s[2], s[3]});
    }
    for (int node = 0; node < block.section.nodes(); ++node)
      out.tread_growth =
          std::max(out.tread_growth, u[static_cast<std::size_t>(dof(block.base + block.slot(node, 0), 2))]);
  }
  return out;
}

}  // namespace tread
