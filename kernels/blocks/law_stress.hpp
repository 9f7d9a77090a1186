#pragma once
// Strain and stress of an element's centre by the law that it has, one element at a time.

#include <cstring>

#include "core/material.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

template <class Real>
void law_strain(bool finite_rotation, const Strain<Real>& strain, Real (&e)[6]) {
  if (finite_rotation)
    point_strain<true, Real>(strain.g, e);
  else
    point_strain<false, Real>(strain.g, e);
}

/// Stress of a strain by a law whose state's values are `state(i)`, which stay as they are.
template <class Real, class State>
void law_stress(int law, const Material& material, const State& state, const Real (&e)[6], Real (&s)[6]) {
  Laws::with(law, [&]<template <class> class Law>() {
    typename Law<Real>::template State<Real> own{};
    constexpr int kValues = kStateValues<Law>;
    if constexpr (kValues > 0) {
      Real values[kValues];
      for (int i = 0; i < kValues; ++i) values[i] = static_cast<Real>(state(i));
      std::memcpy(&own, values, sizeof own);
    }
    Law<Real>::of(material).stress(e, own, s);
    return true;
  });
}

}  // namespace tread
