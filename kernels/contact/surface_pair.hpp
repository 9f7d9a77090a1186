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

class SurfacePair;

/// Depths of both surfaces, of every kind; on the processor alone.
class SurfaceDepths {
 public:
  explicit SurfaceDepths(const SurfacePair& surfaces) : surfaces_(&surfaces) {}
  double rail(double x, double y) const;
  bool wheel_smooth() const;
  SurfaceDepth wheel(double angle, double y) const;
  double wheel_radius() const;

 private:
  const SurfacePair* surfaces_;
};

/// An extruded rail's surface under a revolved wheel's.
class SurfacePair {
 public:
  SurfacePair(const SweptBlock& rail, const SweptBlock& wheel, SurfaceKind kind, RunningSurface rail_depth,
              RunningSurface wheel_depth);

  /// Lowers the rail's surface, beside its other depths.
  void set_corrugation(Corrugation corrugation) { corrugation_ = std::move(corrugation); }

  /// The same as plain data, as long as this object stays where it is.
  SurfacePairBody<SurfaceDepths> body() const;

  const SweptBlock& rail() const { return *rail_; }
  const SweptBlock& wheel() const { return *wheel_; }
  const Corrugation& corrugation() const { return corrugation_; }
  const RunningSurface& rail_depth() const { return rail_depth_; }
  const RunningSurface& wheel_depth() const { return wheel_depth_; }
  /// Depth of the rail's surface at a place [m].
  double depth_at(double x, double y) const {
    const double depth = corrugation_.depth(x, y);
    return rail_depth_.smooth() ? depth : depth + rail_depth_.at(x, y).depth;
  }
  const SurfaceProfile& rail_profile() const { return rail_profile_; }
  const SurfaceProfile& wheel_profile() const { return wheel_profile_; }
  const StationFinder& rail_stations() const { return rail_stations_; }
  const StationFinder& wheel_stations() const { return wheel_stations_; }
  SurfaceKind kind() const { return kind_; }

 private:
  const SweptBlock* rail_;
  const SweptBlock* wheel_;
  SurfaceKind kind_;
  Corrugation corrugation_;
  RunningSurface rail_depth_, wheel_depth_;
  SurfaceProfile rail_profile_;
  SurfaceProfile wheel_profile_;
  StationFinder rail_stations_;
  StationFinder wheel_stations_;
};

inline double SurfaceDepths::rail(double x, double y) const {
  return surfaces_->depth_at(x, y);
}
inline bool SurfaceDepths::wheel_smooth() const {
  return surfaces_->wheel_depth().smooth();
}
inline SurfaceDepth SurfaceDepths::wheel(double angle, double y) const {
  return surfaces_->wheel_depth().around(angle, y);
}
inline double SurfaceDepths::wheel_radius() const {
  return surfaces_->wheel_depth().radius();
}

}  // namespace tread
