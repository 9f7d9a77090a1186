#include "drivers/bench/work.hpp"

#include "drivers/bench/counted.hpp"
#include "kernels/element/element_body.hpp"

namespace tread {

namespace {

constexpr int kCorners = 4;
constexpr double kComponents = 3;

double moving_components(bool vertical_only) {
  return vertical_only ? 1 : kComponents;
}

/// One element between the nodal sums and differences and the forces on them, as the tile loop runs it, with
/// the additions into its four corners.
template <bool finite_rotation, int first, class Element>
void run_element(const Element& element, const SweptConstants<Counted>& constants) {
  Strain<Counted> strain{};
  Strain<Counted> force{};
  for (int i = first; i < 3; ++i) {
    const Counted s[kCorners] = {};
    const Counted d[kCorners] = {};
    element.strain(i, s, d, strain);
  }
  strain_forces<finite_rotation, first>(constants, element, strain, force);
  for (int i = first; i < 3; ++i) {
    Counted s[kCorners] = {};
    Counted d[kCorners] = {};
    element.forces(i, force, s, d);
    Counted sum = 0;
    for (int j = 0; j < kCorners; ++j) sum += s[j] + d[j];
  }
}

template <bool finite_rotation, int first = 0>
double element_flops(const ElementVariant& variant) {
  const SweptConstants<Counted> constants{};
  const std::int64_t before = Counted::operations();
  if (variant.perturbed) {
    const Counted s[kCorners] = {};
    const Counted d[kCorners] = {};
    Counted shift[3][kModes] = {};
    for (auto& component : shift) to_modes(s, d, component);
    run_element<finite_rotation, first>(PerturbedElement<Counted, Counted>(constants, shift), constants);
  } else if (variant.sweep == Sweep::revolved) {
    run_element<finite_rotation, first>(SweptElement<Sweep::revolved, Counted>{constants}, constants);
  } else {
    run_element<finite_rotation, first>(SweptElement<Sweep::extruded, Counted>{constants}, constants);
  }
  return static_cast<double>(Counted::operations() - before);
}

/// Operations of a section node and one element along the sweep: sum and difference of its ends, their
/// forces, the sum with the neighbour's force; sum and difference of its shifts.
double node_flops(const ElementVariant& variant) {
  const double components = moving_components(variant.vertical_only);
  double flops = components * (2 + 2 + 1);
  if (variant.damped) flops += components * 2;
  if (variant.perturbed) flops += kComponents * 2;
  if (variant.sweep == Sweep::extruded) return flops;
  Counted s[3] = {};
  Counted d[3] = {};
  const std::int64_t before = Counted::operations();
  turn_to_middle(Counted(1), Counted(0), s, d);
  turn_to_nodes(Counted(1), Counted(0), s, d);
  if (variant.perturbed) turn_to_middle(Counted(1), Counted(0), s, d);
  return flops + static_cast<double>(Counted::operations() - before);
}

}  // namespace

Work element_work(const ElementVariant& variant, const SweptBlock& block, ValueBytes bytes) {
  const auto elements = static_cast<double>(block.elements());
  const double quads = static_cast<double>(block.section.quads.size());
  const double slots = static_cast<double>(block.slots()) / elements;
  Work work;
  const double components = moving_components(variant.vertical_only);
  work.flops = (variant.vertical_only     ? element_flops<false, 2>(variant)
                : variant.finite_rotation ? element_flops<true>(variant)
                                          : element_flops<false>(variant)) +
               node_flops(variant) * block.section.nodes() / quads;
  if (variant.moves) {
    // Displacement and velocity in and out, inverse mass; the force stays in the caches.
    work.flops += update_work(variant.sweep, variant.vertical_only, bytes).flops * slots;
    work.bytes = (2 * components * (bytes.displacement + bytes.other) + bytes.other) * slots;
  } else {
    // Force, fetched and written whole; velocity.
    const double others = 2 * kComponents + (variant.damped ? components : 0);
    work.bytes = (components * bytes.displacement + others * bytes.other) * slots;
  }
  // Every node has a shift and its index; every quad has a flag.
  if (variant.perturbed)
    work.bytes += (kComponents * bytes.other + sizeof(int) / double{kLanes}) * slots + 1 / double{kLanes};
  return work;
}

Work update_work(Sweep sweep, bool vertical_only, ValueBytes bytes) {
  // Counted in kernels/update/node_motion_body.hpp: per component f / m + g, v, u; in the spinning frame two
  // accelerations with their centrifugal term, half of each before and after the turn, and the axial
  // component.
  const double components = moving_components(vertical_only);
  const double flops = sweep == Sweep::revolved ? 33 : 6 * components;
  // Displacement and velocity in and out, force, inverse mass.
  return {flops, 2 * components * bytes.displacement + (3 * components + 1) * bytes.other};
}

namespace {

// Tie of one to three: nine secondary nodes for a primary node. A secondary node takes from a third of a
// primary section node, because nodes across share the values of a lane; from two stations along and five
// thirds across. A primary node takes from three secondary section nodes, from five stations along and five
// across.
constexpr double kPrimaries = 1.0 / 9;
constexpr double kStationFlops = 10;  ///< four products and four sums of t and r with the turn, two of y
constexpr double kAcrossFlops = 6;

}  // namespace

Work tie_hand_over_work(ValueBytes bytes) {
  // Secondary forces in, primary ones in and out.
  return {kPrimaries * (3 * 5 * kStationFlops + 5 * kAcrossFlops),
          kComponents * bytes.other * (1 + 2 * kPrimaries)};
}

Work tie_follow_work(ValueBytes bytes) {
  // Secondary values fetched and written, primary ones in.
  return {2 * (2.0 / 3 * kStationFlops + 5.0 / 3 * kAcrossFlops),
          kComponents * (bytes.displacement + bytes.other) * (2 + kPrimaries)};
}

}  // namespace tread
