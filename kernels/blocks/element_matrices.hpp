#pragma once
// Mass, stiffness and natural frequencies of single elements, by the linear law.

#include "kernels/blocks/block_elements.hpp"
#include "kernels/element/element_frequency.hpp"

namespace tread {

/// The element of a block with the largest natural frequency.
struct ElementFrequency {
  double omega = 0;  ///< [rad/s]
  int quad = -1;
  int station = -1;  ///< where the element starts
};

/// Components in the nodes' local bases.
template <class Real>
ElementStiffness element_stiffness(const BlockElements<Real>& elements, const ElementPlace& at);

/// Largest natural frequency of the element alone with its own lumped mass. [rad/s]
template <class Real>
double element_frequency(const BlockElements<Real>& elements, const ElementPlace& at);

/// Maximum over the elements of a block: a bound from above on its frequencies when assembled.
template <class Real>
ElementFrequency max_frequency(const BlockElements<Real>& elements);

/// Adds row sums of the mass matrix, rho times the integral of N_I, to a scalar field over the mesh. [kg]
template <class Real>
void add_lumped_mass(const BlockElements<Real>& elements, double* mass);

/// Adds the diagonal of the stiffness to a vector field over the mesh. [N/m]
template <class Real>
void add_diagonal(const BlockElements<Real>& elements, double* d);

}  // namespace tread
