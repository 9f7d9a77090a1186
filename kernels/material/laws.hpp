#pragma once
// The material laws, one a line. How to add one: docs/contributing.md.
//
// A law is a struct template of plain parameters:
//
//   template <class Real>
//   struct Law {
//     static constexpr const char* kName;  // material.NAME.law
//     static constexpr bool kLinear;       // stress is proportional to strain and has no state
//     static const char* refusal(const Material&);  // why the law cannot take the values; null: it can
//     static Law of(const Material&);
//     template <class V> struct State;     // nothing but values V; zero in the undeformed body
//     // Stress [Pa] of a strain; advances the state. Stored energy and what is dissipated so far [J/m3].
//     template <class V> void stress(const V (&e)[6], State<V>& state, V (&s)[6]) const;
//     template <class V> V energy(const V (&e)[6], const State<V>& state) const;
//     template <class V> V dissipated(const State<V>& state) const;
//   };
//
// V is Real (one element: tests, a device) or a vector of lanes. Strain is (xx, yy, zz, 2yz, 2zx, 2xy),
// stress (xx, yy, zz, yz, zx, xy) [Pa]. In blocks of finite rotation they are Green and Lagrange's strain and
// the second Piola-Kirchhoff stress. Preload, stable step, hourglass stiffness and damping are those of the
// linear law with the material's elastic constants; a law must not be stiffer.

#include <string_view>
#include <type_traits>
#include <vector>

#include "kernels/material/j2_plasticity.hpp"
#include "kernels/material/linear_elastic.hpp"

namespace tread {

/// Class templates, numbered from 0.
template <template <class> class... Law>
struct LawList {
  /// Returns visit.template operator()<Law>() of the law with this number.
  template <class Visit>
  static auto with(int law, const Visit& visit) {
    using Result = std::common_type_t<decltype(visit.template operator()<Law>())...>;
    Result result{};
    int number = 0;
    static_cast<void>(((number++ == law ? (result = visit.template operator()<Law>(), true) : false) || ...));
    return result;
  }
  /// The number of a name, -1 where there is none.
  static int find(std::string_view name) {
    int number = 0;
    return ((name == std::string_view(Law<double>::kName) ? true : (++number, false)) || ...) ? number : -1;
  }
  static std::vector<std::string_view> names() { return {Law<double>::kName...}; }
};

using Laws = LawList<  // the linear law is number 0
    LinearElastic,     //
    J2Plasticity       //
    >;

/// Values of a law's state at an element.
template <template <class> class Law>
inline constexpr int kStateValues =
    std::is_empty_v<typename Law<double>::template State<double>>
        ? 0
        : static_cast<int>(sizeof(typename Law<double>::template State<double>) / sizeof(double));

/// Values of the state of the law with this number.
inline int state_values(int law) {
  return Laws::with(law, [&]<template <class> class Law>() { return kStateValues<Law>; });
}

/// Returns true if the law with this number is linear.
inline bool is_linear(int law) {
  return Laws::with(law, [&]<template <class> class Law>() { return Law<double>::kLinear; });
}

}  // namespace tread
