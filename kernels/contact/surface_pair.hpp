#pragma once
// The running surfaces of rail and wheel and the gap between them. [theory.md, Surfaces and Contact]

#include <array>
#include <utility>

#include "core/corrugation.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/running_surface.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "kernels/contact/surface_pair_body.hpp"

namespace tread {

/// An extruded rail's surface under a revolved wheel's.
class SurfacePair {
 public:
  /// `across`: SurfacePairBody::kind_across.
  SurfacePair(const SweptBlock& rail, const SweptBlock& wheel, SurfaceKind kind, SurfaceKind across,
              RunningSurface rail_depth, RunningSurface wheel_depth);

  /// Lowers the rail's surface, beside its other depths.
  void set_corrugation(Corrugation corrugation) { corrugation_ = std::move(corrugation); }

  /// The same as plain data, as long as this object stays where it is.
  SurfacePairBody body() const;
  /// Depths as plain data, likewise.
  SurfaceDepths depths() const { return {corrugation_.view(), rail_depth_.view(), wheel_depth_.view()}; }

  const SweptBlock& rail() const { return *rail_; }
  const SweptBlock& wheel() const { return *wheel_; }
  const Corrugation& corrugation() const { return corrugation_; }
  const RunningSurface& rail_depth() const { return rail_depth_; }
  const RunningSurface& wheel_depth() const { return wheel_depth_; }
  /// Depth of the rail's surface at a place [m].
  double depth_at(double x, double y) const { return depths().rail(x, y); }
  const SurfaceProfile& rail_profile() const { return rail_profile_; }
  const SurfaceProfile& wheel_profile() const { return wheel_profile_; }
  const StationFinder& rail_stations() const { return rail_stations_; }
  const StationFinder& wheel_stations() const { return wheel_stations_; }
  SurfaceKind kind() const { return kind_; }
  SurfaceKind kind_across() const { return kind_across_; }

 private:
  const SweptBlock* rail_;
  const SweptBlock* wheel_;
  SurfaceKind kind_, kind_across_;
  Corrugation corrugation_;
  RunningSurface rail_depth_, wheel_depth_;
  SurfaceProfile rail_profile_;
  SurfaceProfile wheel_profile_;
  StationFinder rail_stations_;
  StationFinder wheel_stations_;
};

}  // namespace tread
