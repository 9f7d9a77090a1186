#pragma once
// The loop over the elements of a tile, or of two of them abreast. Internal linkage keeps the versions of the
// instruction sets apart.

#include <array>
#include <bit>
#include <cstddef>

#include "kernels/element/element_body.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/lanes/tile_front.hpp"
#include "kernels/material/laws.hpp"

namespace tread {
namespace {

/// Elements of a law. One that is not linear is damped where the view has velocities, by a strain of its own.
template <class Real, class U, Sweep sweep, bool damped, bool finite_rotation, int first = 0,
          template <class> class Law = LinearElastic>
class TileLoop : TileFront<Real, U, sweep, damped, !Law<Real>::kLinear, first> {
  using Front = TileFront<Real, U, sweep, damped, !Law<Real>::kLinear, first>;

 public:
  static constexpr bool kLinear = Law<Real>::kLinear;

  TileLoop(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front)
      : Front(elements, view, front) {}

  /// Energy of all elements.
  DeformationEnergy energy() const {
    const FrontPlan::Node* open = elements_.open;
    Sums strain{};
    Sums hourglass{};
    Sums dissipated{};
    for (int i = 0; i < elements_.quad_count; ++i) {
      const FrontPlan::Quad& quad = elements_.quads[i];
      for (; open != elements_.open + quad.opened; ++open) open_node(*open);
      with_elements(i, [&](int lane, const auto& element) {
        const Strain<Register> e = deformation(quad, lane, element);
        add_energy(e, i, lane, element, strain, dissipated);
        add_hourglass_energy(e, elements_.swept[i], hourglass);
      });
    }
    DeformationEnergy sum;
    for (int lane = 0; lane < kWidth; ++lane) {
      sum.strain += strain[lane];
      sum.hourglass += hourglass[lane];
      sum.dissipated += dissipated[lane];
    }
    return sum;
  }

  void run() const {
    prefetch_marks();
    const FrontPlan::Node* open = elements_.open;
    const FrontPlan::Node* close = elements_.close;
    for (int i = 0; i < elements_.quad_count; ++i) {
      const FrontPlan::Quad& quad = elements_.quads[i];
      for (; open != elements_.open + quad.opened; ++open) {
        prefetch(open[kPrefetchAhead].node);
        open_node(*open);
      }
      with_elements(i, [&](int lane, const auto& element) { add_elements(i, quad, lane, element); });
      for (; close != elements_.close + quad.closed; ++close) close_node(*close);
    }
  }

 private:
  using Front::elements_, Front::view_;
  using Front::kAbreast, Front::kRateRow, Front::kWidth;
  using Front::open_node, Front::close_node, Front::prefetch, Front::prefetch_marks, Front::corner,
      Front::shift_corner;
  using Register = typename Front::Register;
  using Half = typename Front::Half;
  using Sums = typename Vector<double, kWidth>::type;

  /// visit(lane, element) for the elements of a quad from that lane on.
  template <class Visit>
  TREAD_INLINE void with_elements(int index, const Visit& visit) const {
    const SweptConstants<Real>& constants = elements_.swept[index];
    if (elements_.perturbed != nullptr && elements_.perturbed[index] != 0) {
      for (int lane = 0; lane < kAbreast; lane += kWidth) {
        Register shift[3][kModes];
        const FrontPlan::Quad& quad = elements_.quads[index];
        for (int i = 0; i < 3; ++i) {
          Register s[4];
          Register d[4];
          load_corners([&](int j) { return shift_corner(quad.slot[j], lane) + i * kAbreast; }, s, d);
          to_modes(s, d, shift[i]);
        }
        visit(lane, PerturbedElement<Register, Real>(constants, shift));
      }
    } else {
      for (int lane = 0; lane < kAbreast; lane += kWidth) visit(lane, SweptElement<sweep, Real>{constants});
    }
  }

  /// Values of all corners of a quad: found once, not for every value that is added to them.
  TREAD_INLINE std::array<Real*, 4> corners(const FrontPlan::Quad& quad, int lane) const {
    return {corner(quad.slot[0], lane), corner(quad.slot[1], lane), corner(quad.slot[2], lane),
            corner(quad.slot[3], lane)};
  }

  /// Sums and differences of a component that stand at `sums(corner)`, the differences three rows behind.
  template <class Sums>
  TREAD_INLINE static void load_corners(const Sums& sums, Register (&s)[4], Register (&d)[4]) {
    for (int j = 0; j < 4; ++j) {
      s[j] = in_register(load<Register>(sums(j)));
      d[j] = in_register(load<Register>(sums(j) + 3 * kAbreast));
    }
  }

  /// Deformation by the displacements, or by the nodes' values from another row on.
  template <int row = 0, class Element>
  TREAD_INLINE Strain<Register> deformation(const FrontPlan::Quad& quad, int lane,
                                            const Element& element) const {
    const std::array<Real*, 4> at = corners(quad, lane);
    Strain<Register> strain;
    for (int i = first; i < 3; ++i) {
      Register s[4];
      Register d[4];
      load_corners([&](int j) { return at[j] + (row + i) * kAbreast; }, s, d);
      element.strain(i, s, d, strain);
    }
    return strain;
  }

  template <class Element>
  TREAD_INLINE void add_elements(int index, const FrontPlan::Quad& quad, int lane,
                                 const Element& element) const {
    const Strain<Register> strain = deformation(quad, lane, element);
    const SweptConstants<Real>& constants = elements_.swept[index];
    Strain<Register> force;
    if constexpr (kLinear) {
      strain_forces<finite_rotation, first>(constants, element, strain, force);
    } else {
      State state = load_state(index, lane);
      Strain<Register> rate;
      const bool damps = view_.added != nullptr;
      if (damps) rate = deformation<kRateRow>(quad, lane, element);
      law_forces<finite_rotation>(constants, law(index), element, strain, damps ? &rate : nullptr, state,
                                  force);
      store_state(index, lane, state);
    }
    const std::array<Real*, 4> at = corners(quad, lane);
    for (int i = first; i < 3; ++i) {
      Register s[4];
      Register d[4];
      element.forces(i, force, s, d);
      for (int j = 0; j < 4; ++j) {
        Real* const fs = at[j] + (6 + i) * kAbreast;
        Real* const fd = at[j] + (9 + i) * kAbreast;
        store(fs, load<Register>(fs) + s[j]);
        store(fd, load<Register>(fd) + d[j]);
      }
    }
  }

  /// Adds what the law stores and has dissipated in the state that the strain leads to; the elements keep
  /// theirs.
  template <class Element>
  TREAD_INLINE void add_energy(const Strain<Register>& deformation, int index, int lane,
                               const Element& element, Sums& strain, Sums& dissipated) const {
    if constexpr (kLinear) {
      strain += __builtin_convertvector(
          linear_energy<finite_rotation>(elements_.swept[index], element, deformation), Sums);
    } else {
      const LawEnergy<Register> energy =
          law_energy<finite_rotation>(law(index), element, deformation, load_state(index, lane));
      strain += __builtin_convertvector(energy.stored, Sums);
      dissipated += __builtin_convertvector(energy.dissipated, Sums);
    }
  }

  TREAD_INLINE void add_hourglass_energy(const Strain<Register>& deformation,
                                         const SweptConstants<Real>& constants, Sums& hourglass) const {
    hourglass_works(constants.hourglass, deformation,
                    [&](const Register& work) { hourglass += 0.5 * __builtin_convertvector(work, Sums); });
  }

  using State = typename Law<Real>::template State<Register>;
  static constexpr int kValues = kStateValues<Law>;
  struct StateValues {
    Register value[kValues > 0 ? kValues : 1];
  };

  const ElementLaw<Law<Real>, Real>& law(int index) const {
    return static_cast<const ElementLaw<Law<Real>, Real>*>(elements_.laws)[index];
  }

  /// Place of a value of the state of a quad's elements in a tile's first lane.
  TREAD_INLINE std::ptrdiff_t state_place(int index, int tile, int value) const {
    return ((static_cast<std::ptrdiff_t>(tile) * elements_.quad_count + index) * kValues + value) * kLanes;
  }

  TREAD_INLINE State load_state(int index, int lane) const {
    if constexpr (kValues == 0) {
      return {};
    } else {
      StateValues values;
      for (int i = 0; i < kValues; ++i) {
        const Real* const at = view_.state + state_place(index, 0, i);
        if constexpr (kWidth <= kLanes)
          values.value[i] = load<Register>(at + lane);
        else
          values.value[i] =
              abreast(load<Half>(at), view_.tiles > 1 ? load<Half>(at + state_place(0, 1, 0)) : Half{});
      }
      return std::bit_cast<State>(values);
    }
  }

  TREAD_INLINE void store_state(int index, int lane, const State& state) const {
    if constexpr (kValues > 0) {
      const auto values = std::bit_cast<StateValues>(state);
      for (int i = 0; i < kValues; ++i) {
        Real* const at = view_.advanced_state + state_place(index, 0, i);
        if constexpr (kWidth <= kLanes) {
          store(at + lane, values.value[i]);
        } else {
          Real row[kWidth];
          store(row, values.value[i]);
          for (int tile = 0; tile < view_.tiles; ++tile)
            store(at + state_place(0, tile, 0), load<Half>(row + tile * kLanes));
        }
      }
    }
  }
};

}  // namespace
}  // namespace tread
