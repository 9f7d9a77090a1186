// The bodies of element, motion and friction, compiled for a GPU, an element, a node or a point a thread, so
// that they stay fit for one. Nothing runs them.
//   cmake --build build/release --target nvcc_check      where CMake finds nvcc

#include "kernels/contact/friction/coulomb.hpp"
#include "kernels/contact/friction/falling.hpp"
#include "kernels/contact/friction/table.hpp"
#include "kernels/element/element_body.hpp"
#include "kernels/update/node_motion_body.hpp"

namespace tread {

inline __device__ int thread_index() {
  return static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
}

/// Sums and differences of an element's displacements at its four corners; then of its forces.
template <class Real>
struct ElementValues {
  Real s[3][4];
  Real d[3][4];
};

/// Of the components from `first` on.
template <bool finite_rotation, int first = 0, class Real, class Element>
__device__ void element_forces(const SweptConstants<Real>& constants, const Element& element,
                               ElementValues<Real>& values) {
  Strain<Real> strain;
  Strain<Real> force;
  Real a[kModes];
  for (int i = first; i < 3; ++i) {
    to_modes(values.s[i], values.d[i], a);
    element.strain(i, a, strain);
  }
  strain_forces<finite_rotation, first>(constants, element, strain, force);
  for (int i = first; i < 3; ++i) {
    element.forces(i, force, a);
    from_modes(a, values.s[i], values.d[i]);
  }
}

template <Sweep sweep, bool finite_rotation, class Real>
__global__ void swept_forces(const SweptConstants<Real>* constants, ElementValues<Real>* values) {
  const int i = thread_index();
  element_forces<finite_rotation>(constants[i], SweptElement<sweep, Real>{constants[i]}, values[i]);
}

template <class Real>
__global__ void vertical_swept_forces(const SweptConstants<Real>* constants, ElementValues<Real>* values) {
  const int i = thread_index();
  element_forces<false, 2>(constants[i], SweptElement<Sweep::extruded, Real>{constants[i]}, values[i]);
}

/// shift: [element][component][mode] [m]
template <bool finite_rotation, class Real>
__global__ void perturbed_forces(const SweptConstants<Real>* constants, const Real (*shift)[3][kModes],
                                 ElementValues<Real>* values) {
  const int i = thread_index();
  element_forces<finite_rotation>(constants[i], PerturbedElement<Real, Real>(constants[i], shift[i]),
                                  values[i]);
}

/// Vectors: [node][component].
template <class Real>
__global__ void turns(Real cosine, Real sine, Real (*s)[3], Real (*d)[3]) {
  const int i = thread_index();
  turn_to_middle(cosine, sine, s[i], d[i]);
  turn_to_nodes(cosine, sine, s[i], d[i]);
}

template <class Real, class U>
__global__ void motions(StepConstants<Real> step, const Real* inverse_mass, const Real* radius,
                        const Real (*weight)[2], const Real (*f)[3], U (*u)[3], Real (*v)[3]) {
  const int i = thread_index();
  move_fixed<0>(step, inverse_mass[i], f[i], u[i], v[i]);
  move_fixed<2>(step, inverse_mass[i], f[i], u[i], v[i]);
  move_spinning(step, weight[i], radius[i], inverse_mass[i], f[i], u[i], v[i]);
}

/// Tractions and states of contact points by a friction law.
template <class Law>
__global__ void frictions(Law law, ElasticStick stick, const Sliding* sliding, const double* pressure,
                          typename Law::State* state, Traction* traction) {
  const int i = thread_index();
  const Traction slip{sliding[i].dt * sliding[i].velocity.along, sliding[i].dt * sliding[i].velocity.across};
  const double friction = law.advance(state[i], sliding[i]);
  traction[i] = stick.advance(traction[i], slip, friction * pressure[i], 0).traction;
}

#define TREAD_ELEMENT_KERNELS(Real, finite_rotation)                                                   \
  template __global__ void swept_forces<Sweep::extruded, finite_rotation>(const SweptConstants<Real>*, \
                                                                          ElementValues<Real>*);       \
  template __global__ void swept_forces<Sweep::revolved, finite_rotation>(const SweptConstants<Real>*, \
                                                                          ElementValues<Real>*);       \
  template __global__ void perturbed_forces<finite_rotation>(                                          \
      const SweptConstants<Real>*, const Real(*)[3][kModes], ElementValues<Real>*);
#define TREAD_MOTION_KERNEL(Real, U)                                                                \
  template __global__ void motions(StepConstants<Real>, const Real*, const Real*, const Real(*)[2], \
                                   const Real(*)[3], U(*)[3], Real(*)[3]);

#define TREAD_FRICTION_KERNEL(Law)                                                                  \
  template __global__ void frictions(Law, ElasticStick, const Sliding*, const double*, Law::State*, \
                                     Traction*);

TREAD_FRICTION_KERNEL(CoulombFriction)
TREAD_FRICTION_KERNEL(TableFriction)
TREAD_FRICTION_KERNEL(FallingFriction)
TREAD_ELEMENT_KERNELS(double, false)
TREAD_ELEMENT_KERNELS(double, true)
TREAD_ELEMENT_KERNELS(float, false)
TREAD_ELEMENT_KERNELS(float, true)
template __global__ void vertical_swept_forces(const SweptConstants<double>*, ElementValues<double>*);
template __global__ void vertical_swept_forces(const SweptConstants<float>*, ElementValues<float>*);
template __global__ void turns(double, double, double (*)[3], double (*)[3]);
template __global__ void turns(float, float, float (*)[3], float (*)[3]);
TREAD_MOTION_KERNEL(double, double)
TREAD_MOTION_KERNEL(float, double)
TREAD_MOTION_KERNEL(float, float)

}  // namespace tread
