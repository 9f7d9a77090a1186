// The bodies of friction and contact points, compiled for a GPU, a point a thread, so that they stay fit for
// one. Nothing runs them. Elements and motion: cuda.cu.
//   cmake --build build/release --target nvcc_check      where CMake finds nvcc

#include "kernels/contact/friction/coulomb.hpp"
#include "kernels/contact/friction/falling.hpp"
#include "kernels/contact/friction/point_response.hpp"
#include "kernels/contact/friction/table.hpp"

namespace tread {

inline __device__ int thread_index() {
  return static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
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

template __global__ void frictions(CoulombFriction, ElasticStick, const Sliding*, const double*,
                                   CoulombFriction::State*, Traction*);
template __global__ void frictions(TableFriction, ElasticStick, const Sliding*, const double*,
                                   TableFriction::State*, Traction*);
template __global__ void frictions(FallingFriction, ElasticStick, const Sliding*, const double*,
                                   FallingFriction::State*, Traction*);

}  // namespace tread
