#pragma once
// The friction laws and their states over the integration points. [theory.md, Friction]
//
// A law is a plain struct with
//   State                      per integration point; plain doubles, or empty; zero where contact is fresh
//   keep_arrays(keep)          replaces each pointer by keep(pointer, count), its copy on a device
//   advance(state, sliding)    coefficient of friction f of a step from the sliding in the step before; moves
//                              the state on
// A new law is a header in this folder and one line in FrictionLaw.

#include <type_traits>
#include <variant>
#include <vector>

#include "kernels/contact/friction/coulomb.hpp"
#include "kernels/contact/friction/falling.hpp"
#include "kernels/contact/friction/table.hpp"

namespace tread {

using FrictionLaw = std::variant<  //
    CoulombFriction,               // one coefficient
    TableFriction,                 // stated along the rail
    FallingFriction>;              // falls with the slip speed

/// A law with the states of all integration points of the rail.
template <class Law>
struct FrictionOf {
  static constexpr bool kHasState = !std::is_empty_v<typename Law::State>;

  Law law;
  std::vector<typename Law::State> state = {};  ///< by integration point; empty for a law without a state
};

/// FrictionOf each law of a list.
template <class Laws>
struct FrictionsOf;
template <class... Law>
struct FrictionsOf<std::variant<Law...>> {
  using type = std::variant<FrictionOf<Law>...>;
};

using Friction = FrictionsOf<FrictionLaw>::type;

}  // namespace tread
