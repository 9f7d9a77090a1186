#include "kernels/contact/patch_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/contract.hpp"

namespace tread {

namespace {

/// Half of the cells on either side of each of their ends.
std::vector<double> shares(const std::vector<double>& cells) {
  std::vector<double> out(cells.size() + 1, 0.0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    out[i] += 0.5 * cells[i];
    out[i + 1] += 0.5 * cells[i];
  }
  return out;
}

}  // namespace

SurfaceGrid make_surface_grid(const SweptBlock& rail, const SurfaceProfile& profile, SurfaceKind kind,
                              std::array<int, 2> edges) {
  SurfaceGrid grid;
  grid.first_edge = edges[0];
  grid.x = rail.stations;
  std::vector<double> lengths;
  for (std::size_t s = 0; s + 1 < grid.x.size(); ++s) lengths.push_back(grid.x[s + 1] - grid.x[s]);
  grid.length = shares(lengths);
  for (int edge = edges[0]; edge < edges[1]; ++edge)
    grid.quad.push_back(rail.section.surface[static_cast<std::size_t>(edge)].quad);
  // The profile goes on beyond the first and the last row, which stand for half of the faces there, too.
  const auto width_of = [&](int edge) {
    if (edge < 0 || edge >= profile.edges()) return 0.0;
    const auto middle = profile.evaluate(edge, 0.5, kind);
    return std::hypot(middle.dp, middle.dq);
  };
  for (int edge = edges[0]; edge <= edges[1]; ++edge) {
    grid.width.push_back(0.5 * width_of(edge - 1) + 0.5 * width_of(edge));
    grid.y.push_back(rail.section.p[static_cast<std::size_t>(profile.node(edge))]);
  }
  return grid;
}

PatchNodes::PatchNodes(SurfaceGrid grid, int stations)
    : grid_(std::move(grid)),
      nodes_(static_cast<std::size_t>(std::min(stations, grid_.stations())) * grid_.y.size()) {}

void PatchNodes::add(const ContactPoint& point) {
  for (int corner = 0; corner < 4; ++corner) {
    const int station = point.face[0] + corner / 2;
    const int row = point.face[1] - grid_.first_edge + corner % 2;
    TREAD_EXPECT(station >= first_ && station <= last_ && row >= 0 && row < grid_.rows());
    const double share =
        point.area * point.face_share[static_cast<std::size_t>(corner)] / grid_.area(station, row);
    nodes_[grid_.node(station - first_, row)].add(point, share);
  }
}

void PatchNodes::average(int first, int last, const std::vector<ContactPoint>& points) {
  if (last - first >= capacity()) throw std::logic_error("the patch's nodes need more room");
  first_ = first;
  last_ = last;
  std::fill(nodes_.begin(), nodes_.end(), NodalContact{});
  for (const ContactPoint& point : points) add(point);
  for (NodalContact& node : nodes_)
    if (node.touching > 0) {
      node.slip_speed.along /= node.touching;
      node.slip_speed.across /= node.touching;
    }
}

double PatchNodes::max_pressure() const {
  double largest = 0;
  for (const NodalContact& node : nodes_) largest = std::max(largest, node.pressure);
  return largest;
}

double PatchNodes::max_shear() const {
  double largest = 0;
  for (const NodalContact& node : nodes_) largest = std::max(largest, node.shear_size());
  return largest;
}

std::int64_t PatchNodes::bytes() const {
  const std::size_t coordinates = 2 * (grid_.x.size() + grid_.y.size()) * sizeof(double);
  return static_cast<std::int64_t>(coordinates + nodes_.size() * sizeof(NodalContact));
}

}  // namespace tread
