#pragma once
// Fields of a passage on the rail's surface: the largest stresses and the frictional work.
// [theory.md, Fields of the surface]

#include <cstdint>
#include <span>
#include <vector>

#include "core/page_vector.hpp"
#include "core/state_list.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/contact/patch_nodes.hpp"

namespace tread {

/// Fields over the nodes, [station][row] of a SurfaceGrid, and its cells. They only observe.
class SurfaceFields {
 public:
  explicit SurfaceFields(const SurfaceGrid& grid);

  /// A step: its tractions and frictional work.
  void add_step(const PatchNodes& patch);

  /// The fields that add_step() changes, by node.
  struct StepFields {
    PageVector<double>& max_pressure;
    PageVector<double>& max_shear;
    PageVector<double>& frictional_work;
  };
  StepFields step_fields() { return {max_pressure_, max_shear_, frictional_work_}; }

  /// A sample that stands for `interval` [s]: frictional work as the paper sums it. [paper, eq. (5)]
  void add_sample(const PatchNodes& patch, double interval);

  /// Displacement [m] of the nodes, the lag of their Maxwell branches [m] and the state of the laws, where
  /// there are any.
  struct Deformation {
    ConstNodeField displacement;
    ConstNodeField lag = nullptr;
    ConstLawState laws = nullptr;
  };

  /// The stress of the surface elements about the nodes under pressure; `block` is the rail's.
  void add_stress(const PatchNodes& patch, const InternalForce& force, int block, const Deformation& of);

  const SurfaceGrid& grid() const { return grid_; }
  std::span<const double> max_pressure() const { return max_pressure_; }        ///< by node [Pa]
  std::span<const double> max_shear() const { return max_shear_; }              ///< by node [Pa]
  std::span<const double> max_von_mises() const { return max_von_mises_; }      ///< by cell [Pa]
  std::span<const double> frictional_work() const { return frictional_work_; }  ///< by node [J/m2]
  /// By samples; by node [J/m2].
  std::span<const double> sampled_frictional_work() const { return sampled_work_; }

  /// Integral of a work per area, given by node, over the whole surface [J].
  double sum(std::span<const double> per_area) const;

  static std::int64_t bytes(const SurfaceGrid& grid);

  void list_state(StateList& list) {
    list.add("max_pressure", max_pressure_);
    list.add("max_shear", max_shear_);
    list.add("max_von_mises", max_von_mises_);
    list.add("frictional_work", frictional_work_);
    list.add("sampled_frictional_work", sampled_work_);
  }

 private:
  SurfaceGrid grid_;
  PageVector<double> max_pressure_, max_shear_, max_von_mises_, frictional_work_, sampled_work_;
};

}  // namespace tread
