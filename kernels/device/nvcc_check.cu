// The bodies of element, motion and friction, compiled for a GPU, an element, a node or a point a thread, so
// that they stay fit for one. Nothing runs them.
//   cmake --build build/release --target nvcc_check      where CMake finds nvcc

#include "kernels/contact/friction/coulomb.hpp"
#include "kernels/contact/friction/falling.hpp"
#include "kernels/contact/friction/point_response.hpp"
#include "kernels/contact/friction/table.hpp"
#include "kernels/element/element_body.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/material/laws.hpp"
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

/// Stress, energy and forces of a law; `strain`: of displacements and of what adds for damping.
template <template <class> class Law, Sweep sweep, class Real>
__global__ void law_elements(const SweptConstants<Real>* constants, const ElementLaw<Law<Real>, Real>* laws,
                             const Strain<Real> (*strain)[2], typename Law<Real>::template State<Real>* state,
                             Strain<Real>* force, Real (*energy)[2]) {
  const int i = thread_index();
  law_forces<sweep == Sweep::revolved>(constants[i], laws[i], SweptElement<sweep, Real>{constants[i]},
                                       strain[i][0], &strain[i][1], state[i], force[i]);
  Real e[6];
  point_strain<sweep == Sweep::revolved, Real>(strain[i][0].g, e);
  energy[i][0] = laws[i].law.energy(e, state[i]);
  energy[i][1] = laws[i].law.dissipated(state[i]);
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

/// Responses of contact points to the velocities of an iteration.
__global__ void responses(PointSprings springs, double dt, const PointStep<double>* step,
                          const PointVelocity<double>* velocity, PointTraction<double>* traction) {
  const int i = thread_index();
  traction[i] = respond(step[i], springs, dt, velocity[i], traction[i]);
}

/// Instantiates the kernels of all laws.
template <class Real, template <class> class... Law>
int law_kernels(LawList<Law...> /*laws*/) {
  const void* const kernels[] = {reinterpret_cast<const void*>(&law_elements<Law, Sweep::extruded, Real>)...,
                                 reinterpret_cast<const void*>(&law_elements<Law, Sweep::revolved, Real>)...};
  return kernels[0] != nullptr ? static_cast<int>(sizeof kernels) : 0;
}
extern const int kLawKernels;
const int kLawKernels = law_kernels<double>(Laws{}) + law_kernels<float>(Laws{});

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
