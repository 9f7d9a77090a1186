#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/element/element_body.hpp"
#include "kernels/lanes/hex_force.hpp"
#include "kernels/lanes/node_lanes.hpp"

namespace tread {
namespace {

/// Elements have the corners' positions alone, and a unit volume stands for theirs.
constexpr SweptConstants<double> kNoShape = [] {
  SweptConstants<double> constants{};
  constants.inverse_volume = 1;
  constants.gap_by_h1 = 1;
  return constants;
}();

/// Elements of a HexPack or HexRow that fit a register, from `lane` on.
template <bool finite_rotation, class Pack>
class HexElements {
 public:
  using V = Lanes<double>::Register;
  static constexpr int kWidth = Lanes<double>::kWidth;

  TREAD_INLINE HexElements(const HexView& view, const Pack& pack, int lane)
      : HexElements(view, pack, lane, Corners(view.nodes, pack, lane)) {}

  TREAD_INLINE Strain<V> strain() const {
    Strain<V> e;
    for (int i = 0; i < 3; ++i) element_.strain(i, displacement_.sum[i], displacement_.difference[i], e);
    return e;
  }

  TREAD_INLINE void add_forces(const Strain<V>& e) const {
    Strain<V> force;
    stress_forces<finite_rotation>(material_.point, e, force);
    hourglass(e, force);
    element_.template scale_by_volume<0>(force);
    V value[8][3];
    for (int i = 0; i < 3; ++i) {
      V s[4];
      V d[4];
      element_.forces(i, force, s, d);
      for (int j = 0; j < 4; ++j) {
        value[j][i] = s[j] - d[j];
        value[j + 4][i] = s[j] + d[j];
      }
    }
    add_to_corners(view_.f, pack_, lane_, value);
  }

  /// Energies by lane.
  TREAD_INLINE void add_energy(const Strain<V>& e, V& strain, V& hourglass_energy) const {
    V at_point[6];
    point_strain<finite_rotation, double>(e.g, at_point);
    strain += element_.energy_in_volume(
        LinearElastic<double>{material_.point.lambda, material_.point.mu}.energy(at_point, {}));
    Strain<V> force;
    hourglass(e, force);
    for (int i = 0; i < 3; ++i)
      for (int m = 0; m < kHourglassModes; ++m) hourglass_energy += 0.5 * e.q[i][m] * force.q[i][m];
  }

 private:
  /// Positions and displacements of the corners.
  struct Corners {
    V position[8][3];
    V displacement[8][3];
    TREAD_INLINE Corners(const double* nodes, const Pack& pack, int lane) {
      gather_corners(nodes, pack, lane, position, displacement);
    }
  };

  /// Sums and differences of the corners' values at both ends, [component][corner of the quad].
  struct Ends {
    V sum[3][4];
    V difference[3][4];
    TREAD_INLINE explicit Ends(const V (&at)[8][3]) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
          sum[i][j] = at[j][i] + at[j + 4][i];
          difference[i][j] = at[j + 4][i] - at[j][i];
        }
    }
  };

  /// Modal amplitudes of the same, [component][mode].
  struct Amplitudes {
    V value[3][kModes];
    TREAD_INLINE explicit Amplitudes(const Ends& ends) {
      for (int i = 0; i < 3; ++i) to_modes(ends.sum[i], ends.difference[i], value[i]);
    }
  };

  TREAD_INLINE HexElements(const HexView& view, const Pack& pack, int lane, const Corners& corners)
      : view_(view),
        pack_(pack),
        material_(view.materials[pack.shapes.material]),
        lane_(lane),
        displacement_(corners.displacement),
        element_(kNoShape, Amplitudes(Ends(corners.position)).value) {}

  /// Matrix of the element's rotation: [component][local axis].
  TREAD_INLINE void rotation(V (&axes)[3][3]) const {
    V turn[4];
    for (int i = 0; i < 4; ++i) turn[i] = load<V>(&pack_.shapes.turn[i][lane_]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      axes[i][i] = 1 - 2 * (turn[1 + j] * turn[1 + j] + turn[1 + k] * turn[1 + k]);
      axes[j][i] = 2 * (turn[1 + i] * turn[1 + j] + turn[0] * turn[1 + k]);
      axes[i][j] = 2 * (turn[1 + i] * turn[1 + j] - turn[0] * turn[1 + k]);
    }
  }

  /// Hourglass stiffness in the element's own axes. [theory.md, Element]
  TREAD_INLINE void hourglass(const Strain<V>& e, Strain<V>& force) const {
    V axes[3][3];
    V scale[3];
    rotation(axes);
    for (int i = 0; i < 3; ++i) scale[i] = load<V>(&pack_.shapes.scale[i][lane_]);
    V q[3][kHourglassModes];
    V in_modes[3][kHourglassModes];
    for (int i = 0; i < 3; ++i) by_directions(e.q[i], in_modes[i]);
    for (int i = 0; i < 3; ++i)
      for (int m = 0; m < kHourglassModes; ++m)
        q[i][m] = axes[0][i] * in_modes[0][m] + axes[1][i] * in_modes[1][m] + axes[2][i] * in_modes[2][m];
    V f[3][kHourglassModes];
    const V squares = scale[0] * scale[0] + scale[1] * scale[1] + scale[2] * scale[2];
    const V trace = scale[0] * q[0][0] + scale[1] * q[1][1] + scale[2] * q[2][2];
    for (int i = 0; i < 3; ++i) {
      f[i][i] = material_.mu *
                ((squares - scale[i] * scale[i]) * q[i][i] + scale[i] * (trace - scale[i] * q[i][i]));
      for (int j = 0; j < 3; ++j)
        if (j != i)
          f[i][j] =
              scale[i] * (material_.plate * (scale[i] * q[i][j]) + material_.plate_nu * (scale[j] * q[j][i]));
      f[i][3] = material_.youngs_third * (scale[i] * (scale[i] * q[i][3]));
    }
    for (int i = 0; i < 3; ++i) {
      for (int m = 0; m < kHourglassModes; ++m)
        in_modes[i][m] = axes[i][0] * f[0][m] + axes[i][1] * f[1][m] + axes[i][2] * f[2][m];
      by_directions(in_modes[i], force.q[i]);
    }
  }

  /// From h1, d02, d13, h4 to h1, h2, h3, h4: amplitudes one way, forces the other, which is its transpose.
  TREAD_INLINE static void by_directions(const V (&from)[kHourglassModes], V (&to)[kHourglassModes]) {
    to[0] = from[0];
    to[1] = from[1] + from[2];
    to[2] = from[1] - from[2];
    to[3] = from[3];
  }

  const HexView& view_;
  const Pack& pack_;
  const HexMaterial& material_;
  int lane_;
  Ends displacement_;
  PerturbedElement<V, double> element_;
};

/// Calls visit(elements) for all elements of the chunk.
template <bool finite_rotation, class Visit>
TREAD_INLINE void for_each_elements(const HexView& view, const Visit& visit) {
  const auto of = [&]<class Pack>(const Pack* packs, std::ptrdiff_t count) {
    for (std::ptrdiff_t p = 0; p < count; ++p)
      for (int lane = 0; lane < kLanes; lane += Lanes<double>::kWidth)
        visit(HexElements<finite_rotation, Pack>(view, packs[p], lane));
  };
  of(view.rows, view.row_count);
  of(view.packs, view.pack_count);
}

template <bool finite_rotation>
void hex_force(const HexView& view) {
  for_each_elements<finite_rotation>(view,
                                     [](const auto& elements) { elements.add_forces(elements.strain()); });
}

template <bool finite_rotation>
DeformationEnergy hex_energy(const HexView& view) {
  Lanes<double>::Register strain{};
  Lanes<double>::Register hourglass{};
  for_each_elements<finite_rotation>(
      view, [&](const auto& elements) { elements.add_energy(elements.strain(), strain, hourglass); });
  DeformationEnergy sum;
  for (int lane = 0; lane < Lanes<double>::kWidth; ++lane) {
    sum.strain += strain[lane];
    sum.hourglass += hourglass[lane];
  }
  return sum;
}

}  // namespace
}  // namespace tread
