#include "kernels/contact/surface_pair.hpp"

#include <utility>

namespace tread {

SurfacePair::SurfacePair(const SweptBlock& rail, const SweptBlock& wheel, SurfaceKind kind,
                         SurfaceKind across, RunningSurface rail_depth, RunningSurface wheel_depth)
    : rail_(&rail),
      wheel_(&wheel),
      kind_(kind),
      kind_across_(across),
      rail_depth_(std::move(rail_depth)),
      wheel_depth_(std::move(wheel_depth)),
      rail_profile_(rail.section),
      wheel_profile_(wheel.section),
      rail_stations_(rail),
      wheel_stations_(wheel) {}

SurfacePairBody SurfacePair::body() const {
  return {{rail_stations_.line(), rail_profile_.view(), rail_->section.p.data(), rail_->section.q.data()},
          {wheel_stations_.line(), wheel_profile_.view(), wheel_->section.p.data(), wheel_->section.q.data()},
          kind_,
          kind_across_,
          depths()};
}

}  // namespace tread
