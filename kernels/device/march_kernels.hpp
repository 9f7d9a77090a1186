#pragma once
// Kernels of a device and their choice, for every kind of team. [kernels/device/march_body.hpp]

#include <type_traits>
#include <variant>

#include "kernels/device/device.hpp"
#include "kernels/device/march_body.hpp"
#include "kernels/device/node_kernels.hpp"
#include "kernels/device/patch_finder.hpp"
#include "kernels/device/patch_record.hpp"
#include "kernels/device/patch_solution.hpp"
#include "kernels/device/search_points.hpp"
#include "kernels/device/sum_kernels.hpp"

namespace tread {

/// launch.template operator()<March>() of the march over blocks of a variant.
template <class Real, class U, class Team, class Launch>
void with_march(TileVariant v, const Launch& launch) {
  constexpr auto extruded = Sweep::extruded;
  constexpr auto revolved = Sweep::revolved;
  Laws::with(v.law, [&]<template <class> class Law>() {
    if constexpr (!Law<Real>::kLinear) {
      if (v.sweep == revolved)
        launch.template operator()<March<Real, U, revolved, true, 0, Law, Team>>();
      else
        launch.template operator()<March<Real, U, extruded, false, 0, Law, Team>>();
    } else if (v.vertical_only) {
      launch.template operator()<March<Real, U, extruded, false, 2, Law, Team>>();
    } else if (v.sweep == revolved && v.finite_rotation) {
      launch.template operator()<March<Real, U, revolved, true, 0, Law, Team>>();
    } else if (v.sweep == revolved) {
      launch.template operator()<March<Real, U, revolved, false, 0, Law, Team>>();
    } else if (v.finite_rotation) {
      launch.template operator()<March<Real, U, extruded, true, 0, Law, Team>>();
    } else {
      launch.template operator()<March<Real, U, extruded, false, 0, Law, Team>>();
    }
    return true;
  });
}

/// A device of which `Own` has march_any, patch_any(body), which calls body(teams), and each(body), which
/// calls body(0) ... body(body.count() - 1).
template <class Own>
class KernelDevice : public Device {
 public:
  void search(const ContactTask& task) override {
    task.u.visit([&]<class U>(const U* u) {
      task.v.visit([&]<class V>(const V* v) {
        if constexpr (sizeof(V) <= sizeof(U)) each(SearchPoints<U, V>{task, {u}, {v}});
      });
    });
  }
  void find_patch(const ContactTask& task) override {
    this->count_launch();
    own().patch_any(FindPatch{task});
  }
  void resolve(const ContactTask& task, const FrictionLaw& law, void* state) override {
    this->count_launch();
    std::visit(
        [&](const auto& of) {
          using Law = std::decay_t<decltype(of)>;
          own().patch_any(SolvePatch<Law>{task, of, static_cast<typename Law::State*>(state)});
        },
        law);
  }
  void record(const ContactTask& task) override {
    each(RecordPatch{task});
    each(SumPatch{task});
  }
  void gather(const ContactTask& task, int points) override {
    each(GatherPoints{{task.candidates.point, task.candidates.origin}, task.point, points});
  }
  void triad(std::int64_t n, double* a, const double* b, const double* c) override {
    each(Triad{n, a, b, c});
  }

 protected:
  KernelDevice() : doubles_(*this), mixed_(*this), singles_(*this) {}

 private:
  template <class Real, class U>
  class Kernels final : public FieldKernels<Real, U> {
   public:
    explicit Kernels(KernelDevice& device) : device_(&device) {}

    void march(TileVariant variant, const MarchBlock<Real>& block,
               const MarchFields<Real, U>& fields) override {
      device_->count_launch();
      device_->own().march_any(variant, block, fields);
    }
    void sum_stations(const StationSums& sums, const Real* force) override {
      device_->each(SumStations<Real>{sums, force});
    }
    void move_primary(const PrimaryBlocks<Real>& primary, const MarchFields<Real, U>& fields) override {
      device_->each(MovePrimary<Real, U>{primary, fields});
    }
    void hold(std::int64_t count, const std::int64_t* unknowns, U* u, Real* v) override {
      device_->each(HoldUnknowns<Real, U>{count, unknowns, u, v});
    }
    void follow(const TiedNodes& secondary, U* u, Real* v) override {
      device_->each(FollowTies<Real, U>{secondary, u, v});
    }
    void collect(const SurfaceWindows& windows, const U* u, const Real* v, U* to_u, Real* to_v) override {
      device_->each(CollectWindows<Real, U>{windows, u, v, to_u, to_v});
    }
    void place(const GroupValues<Real, U>& values, U* u, Real* v) override {
      device_->each(PlaceGroups<Real, U>{values, u, v});
    }
    void take(const GroupValues<Real, U>& values, const U* u, const Real* v) override {
      device_->each(TakeGroups<Real, U>{values, u, v});
    }
    void anchor(const AnchoredNodes<Real>& nodes, U* u, Real* v) override {
      device_->each(AnchorNodes<Real, U>{nodes, u, v});
    }
    void sum_nodes(const NodeSumTask<Real, U>& task) override { device_->each(SumNodes<Real, U>{task}); }
    void sum_elements(TileVariant v, const ElementSumTask<Real, U>& task) override {
      Laws::with(v.law, [&]<template <class> class Law>() {
        if (v.sweep == Sweep::extruded && v.finite_rotation)
          device_->each(SumElements<Real, U, Sweep::extruded, true, Law>{task});
        else if (v.sweep == Sweep::extruded)
          device_->each(SumElements<Real, U, Sweep::extruded, false, Law>{task});
        else if (v.finite_rotation)
          device_->each(SumElements<Real, U, Sweep::revolved, true, Law>{task});
        else
          device_->each(SumElements<Real, U, Sweep::revolved, false, Law>{task});
        return true;
      });
    }
    void fold(const FoldTask& task) override { device_->each(FoldSums{task}); }
    void advance_lag(std::int64_t n, Real kept, Real gained, const Real* v, Real* q) override {
      device_->each(LagValues<Real>{n, {kept, gained}, v, q});
    }

   private:
    KernelDevice* device_;
  };

  template <class Body>
  void each(const Body& body) {
    if (body.count() == 0) return;
    this->count_launch();
    own().each(body);
  }
  Own& own() { return static_cast<Own&>(*this); }

  FieldKernels<double, double>& kernels_of(Device::Precision<double, double> /*of*/) override {
    return doubles_;
  }
  FieldKernels<float, double>& kernels_of(Device::Precision<float, double> /*of*/) override { return mixed_; }
  FieldKernels<float, float>& kernels_of(Device::Precision<float, float> /*of*/) override { return singles_; }

  Kernels<double, double> doubles_;
  Kernels<float, double> mixed_;
  Kernels<float, float> singles_;
};

}  // namespace tread
