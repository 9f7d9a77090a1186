#include "drivers/engine/model/rail_foot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"
#include "drivers/engine/model/attachments.hpp"

namespace tread {

RailFoot::RailFoot(const SweptBlock& block) : block_(&block) {
  const std::vector<int>& foot = block.section.paths.at("foot");
  middle_ = 0.5 * (block.section.p[index(foot.front())] + block.section.p[index(foot.back())]);
}

RailFoot::RailFoot(const HexBody& body, const std::string& set, const std::string& key) : key_(key) {
  const std::vector<std::int32_t>& members = body.mesh.node_sets.at(set);
  double low = 1e30, high = -1e30;
  for (const std::int32_t node : members) {
    const Vec3& at = body.mesh.nodes[index(node)];
    nodes_.push_back({body.slot(node), at.x, at.y});
    low = std::min(low, at.y);
    high = std::max(high, at.y);
  }
  middle_ = 0.5 * (low + high);
  std::vector<FaceCorners> faces;
  for (const auto& [face, element] : outer_faces(body.mesh, members)) {
    FaceCorners& corners = faces.emplace_back();
    auto& slots = at_.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& at = body.mesh.nodes[index(face[k])];
      corners[k] = {at.x, at.y, 0};
      slots[k] = body.slot(face[k]);
    }
  }
  if (faces.empty())
    throw InputError(
        fmt::format("{} = \"{}\": the set has {} nodes and no outer face of an element between "
                    "them; name the set of all nodes of the foot's underside",
                    key, set, members.size()));
  faces_.emplace(std::move(faces), 0);
}

std::vector<FootNode> RailFoot::nodes() const {
  if (!block_) return nodes_;
  std::vector<FootNode> list;
  for (const int node : block_->section.paths.at("foot"))
    for (int station = 0; station < block_->station_count(); ++station)
      list.push_back({block_->base + block_->slot(node, station), block_->stations[index(station)],
                      block_->section.p[index(node)]});
  return list;
}

std::optional<Attachment> RailFoot::on_faces(double x, double y) const {
  constexpr double kBeyond = 1e-6;  // a point may lie beyond a face by this [m]
  const FacePlace place = faces_->nearest({x, y, 0});
  if (!place.is_within(kBeyond)) return std::nullopt;
  return Attachment{at_[index(place.face)], place.share};
}

Attachment RailFoot::attach(double x, double y) const {
  if (block_) return tread::attach(*block_, "foot", x, y);
  const std::optional<Attachment> at = on_faces(x, y);
  if (!at)
    throw InputError(
        fmt::format("a fastening acts at x = {:.4f} m, y = {:.4f} m, beyond the set of {}; "
                    "extend the set, or move the fastenings",
                    x, y, key_));
  return *at;
}

Attachment RailFoot::attach_near(double x, double y) const {
  if (block_) return attach(x, y);
  return on_faces(x, y).value_or(Attachment{{within(x, y, 0, 0).front().slot, -1, -1, -1}, {1, 0, 0, 0}});
}

namespace {

/// Indices of the values within `reach` of `at`; where there are none, that of the nearest.
template <class Value>
std::vector<int> within_reach(int count, const Value& value, double at, double reach) {
  std::vector<int> found;
  int nearest = 0;
  for (int i = 0; i < count; ++i) {
    if (std::abs(value(i) - at) <= reach) found.push_back(i);
    if (std::abs(value(i) - at) < std::abs(value(nearest) - at)) nearest = i;
  }
  if (found.empty()) found.push_back(nearest);
  return found;
}

}  // namespace

std::vector<FootNode> RailFoot::within(double x, double y, double half_length, double half_width) const {
  std::vector<FootNode> found;
  if (block_) {
    const std::vector<int>& foot = block_->section.paths.at("foot");
    const auto across = [&](int i) { return block_->section.p[index(foot[index(i)])]; };
    const auto along = [&](int station) { return block_->stations[index(station)]; };
    for (const int i : within_reach(static_cast<int>(foot.size()), across, y, half_width))
      for (const int station : within_reach(block_->station_count(), along, x, half_length))
        found.push_back({block_->base + block_->slot(foot[index(i)], station), along(station), across(i)});
    return found;
  }
  std::copy_if(nodes_.begin(), nodes_.end(), std::back_inserter(found), [&](const FootNode& node) {
    return std::abs(node.x - x) <= half_length && std::abs(node.y - y) <= half_width;
  });
  if (found.empty())
    found.push_back(
        *std::min_element(nodes_.begin(), nodes_.end(), [&](const FootNode& a, const FootNode& b) {
          return std::hypot(a.x - x, a.y - y) < std::hypot(b.x - x, b.y - y);
        }));
  return found;
}

RailFoot foot_of_rail(const Scene& scene, const Mesh& mesh, const BlockIndex& blocks) {
  if (blocks.base_body < 0) return RailFoot(mesh.blocks[index(blocks.rail_foot())]);
  const auto& [name, spec] = *scene.body_replacing("rail");
  return {mesh.bodies[index(blocks.base_body)], spec.foot, fmt::format("body.{}.foot", name)};
}

namespace {

/// Calls `act` with the number of the fastening, x and y [m] of each of its spring-dampers. `middle`: y of
/// the foot's [m].
template <class Act>
void each_spring_damper(const Scene& scene, double middle, const Act& act) {
  const FasteningSpec& f = *scene.fastenings;
  for (int i = 0; i < f.count; ++i)
    for (int column = 0; column < f.columns; ++column)
      for (int row = 0; row < f.rows; ++row)
        act(i, scene.fastening_x(i) + f.column_offset(column), middle + f.row_offset(row));
}

}  // namespace

std::vector<SpringDampers::Element> fastening_elements(const Scene& scene, const RailFoot& rail,
                                                       const std::vector<const SweptBlock*>& below) {
  const FasteningSpec& f = *scene.fastenings;
  const int groups = f.columns * f.rows;
  std::vector<SpringDampers::Element> elements;
  each_spring_damper(scene, rail.middle(), [&](int i, double x, double y) {
    const SupportSpec own = scene.support(i);
    const SweptBlock* under = below[static_cast<std::size_t>(i)];
    const Attachment foot = rail.attach(x, y);
    const Attachment support = under ? attach(*under, "top", x, y) : Attachment{};
    elements.push_back(
        {foot, support, own.stiffness * f.stiffness / groups, own.damping_share() * f.damping / groups, 2});
    const double share = own.holds ? 1.0 / groups : 0;
    for (const auto& [component, hold] : {std::pair(0, &f.along), std::pair(1, &f.across)})
      if (hold->kind == "elastic")
        elements.push_back({foot, {}, share * hold->stiffness, share * hold->damping, component});
  });
  return elements;
}

std::size_t elements_of_fastening(const FasteningSpec& f) {
  std::size_t directions = 1;
  for (const FootHold* hold : {&f.along, &f.across})
    if (hold->kind == "elastic") ++directions;
  return directions * static_cast<std::size_t>(f.columns * f.rows);
}

std::vector<FootNode> held_foot_nodes(const Scene& scene, const RailFoot& foot) {
  constexpr double kRounding = 1e-9;
  const FasteningSpec& f = *scene.fastenings;
  std::vector<FootNode> nodes;
  const auto hold = [&](double x, double y, double half_length, double half_width) {
    for (const FootNode& node : foot.within(x, y, half_length, half_width)) nodes.push_back(node);
  };
  if (f.held_at == "springs") {
    each_spring_damper(scene, foot.middle(), [&](int i, double x, double y) {
      if (scene.support(i).holds) hold(x, y, 0, 0);
    });
    return nodes;
  }
  for (int i = 0; i < f.count; ++i)
    if (scene.support(i).holds)
      hold(scene.fastening_x(i), foot.middle(), 0.5 * f.pad_length + kRounding,
           0.5 * f.pad_width + kRounding);
  return nodes;
}

}  // namespace tread
