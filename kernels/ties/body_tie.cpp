#include "kernels/ties/body_tie.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/millimetre.hpp"
#include "kernels/ties/face_finder.hpp"
#include "kernels/ties/tie_places.hpp"

namespace tread {

namespace {

/// A node of one side, in the body frame.
struct SideNode {
  BasedNode node;
  Vec3 at;  ///< [m]
};

/// One side of a tie.
struct Side {
  std::vector<SideNode> nodes;
  std::vector<std::array<std::size_t, 4>> faces;  ///< indices of nodes
  std::vector<FaceCorners> corners;               ///< by face
};

void list_corners(Side& side) {
  for (const auto& face : side.faces) {
    FaceCorners& corners = side.corners.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) corners[k] = side.nodes[face[k]].at;
  }
}

Side side_of(const SweptBlock& block, const std::string& path) {
  const std::vector<int>& line = path_of(block, path);
  const int stations = block.station_count();
  Side side;
  for (int station = 0; station < stations; ++station)
    for (const int node : line)
      side.nodes.push_back(
          {{block.base + block.slot(node, station),
            block.sweep == Sweep::revolved ? block.stations[index(station)] : kCartesianAngle},
           position(block, node, station)});
  const auto at = [&](int station, std::size_t i) { return index(station) * line.size() + i; };
  for (int station = 0; station + (block.closed ? 0 : 1) < stations; ++station) {
    const int next = (station + 1) % stations;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      side.faces.push_back({at(station, i), at(station, i + 1), at(next, i + 1), at(next, i)});
  }
  list_corners(side);
  return side;
}

Side side_of(const HexBody& body, const std::vector<std::int32_t>& set) {
  Side side;
  for (const std::int32_t node : set)
    side.nodes.push_back({{body.slot(node), kCartesianAngle}, body.mesh.nodes[index(node)]});
  const auto place = [&](std::int32_t node) {
    return index(std::lower_bound(set.begin(), set.end(), node) - set.begin());
  };
  for (const auto& [face, element] : outer_faces(body.mesh, set))
    side.faces.push_back({place(face[0]), place(face[1]), place(face[2]), place(face[3])});
  list_corners(side);
  return side;
}

double area_of(const Side& side) {
  double sum = 0;
  for (const FaceCorners& face : side.corners) sum += face_area(face);
  return sum;
}

/// Share of a turn about the axle over which there are faces, by the middles of sectors.
double share_of_turn(const Side& side) {
  constexpr int kSectors = 720;
  constexpr double kSector = 2 * std::numbers::pi / kSectors;
  const auto angle = [](const Vec3& at) { return std::atan2(at.x, at.z); };
  std::array<bool, kSectors> met{};
  for (const FaceCorners& face : side.corners) {
    const double at = angle(face[0]);
    double low = 0, high = 0;  // of the other corners, from there
    for (const Vec3& corner : face) {
      const double beside = std::remainder(angle(corner) - at, 2 * std::numbers::pi);
      low = std::min(low, beside);
      high = std::max(high, beside);
    }
    const auto sector = [&](double beside) {  // the first whose middle lies beyond
      return static_cast<int>(std::ceil((at + beside) / kSector - 0.5));
    };
    for (int i = sector(low); i < sector(high); ++i) met[index((i + 2 * kSectors) % kSectors)] = true;
  }
  return static_cast<double>(std::count(met.begin(), met.end(), true)) / kSectors;
}

/// Secondary nodes may lie off the primary faces by this share of a face's longest edge, and are moved onto
/// them: chords of a ring of 30 elements are off by 3 % of their length.
constexpr double kFarthest = 0.1;

/// Digits of a file leave gaps of this share of an edge; nodes stay where they are, for moved ones cost more.
constexpr double kDigits = 1e-6;

/// Share of the block's surface that a set must cover which is to cover it, and of the way around a wheel's.
constexpr double kLeastCover = 0.95;

class TieMaker {
 public:
  TieMaker(Mesh& mesh, const BodyTieSpec& spec)
      : spec_(spec),
        block_(mesh.blocks[index(spec.block)]),
        body_(mesh.bodies[index(spec.body)]),
        set_(body_.mesh.node_sets.at(spec.set)),
        of_block_(side_of(block_, spec.path)),
        of_body_(side_of(body_, set_)) {
    require_faces();
  }

  BodyTie tie() {
    BodyTie tied;
    const bool body_leads = tied.body_leads = coarseness(of_body_) > 1.001 * coarseness(of_block_);
    const Side& secondary = body_leads ? of_block_ : of_body_;
    const Side& primary = body_leads ? of_body_ : of_block_;
    double longest = 0;
    for (const FaceCorners& face : primary.corners) longest = std::max(longest, longest_edge(face));
    const FaceFinder finder(primary.corners, kFarthest * longest);
    for (std::size_t i = 0; i < secondary.nodes.size(); ++i) {
      const SideNode& node = secondary.nodes[i];
      const FacePlace place = finder.nearest(node.at);
      if (!place.is_within(place.face < 0 ? 0 : kFarthest * longest_edge(primary.corners[index(place.face)])))
        refuse(node, place, kFarthest * longest, body_leads);
      if (place.distance > kDigits * longest) move(i, place.at - node.at, body_leads);
      tied.farthest = std::max(tied.farthest, place.distance);
      FollowingNode& made = tied.nodes.emplace_back();
      made.node = node.node;
      made.share = place.share;
      for (std::size_t k = 0; k < 4; ++k)
        made.primary[k] = primary.nodes[primary.faces[index(place.face)][k]].node;
    }
    if (!body_leads) require_shapes(tied.farthest);
    return tied;
  }

 private:
  void require_faces() const {
    if (of_body_.faces.empty())
      throw InputError(
          fmt::format("{} = \"{}\": the set has {} nodes and no outer face of an element between "
                      "them; name the set of all nodes of the tied surface",
                      spec_.key, spec_.set, of_body_.nodes.size()));
    const double cover = area_of(of_body_) / area_of(of_block_);
    if (spec_.whole && cover < kLeastCover)
      throw InputError(
          fmt::format("{} = \"{}\": its faces cover {:.1f} % of the surface that they are tied to, at least "
                      "{:.0f} % are needed; {}; see the keys unit and origin_x, origin_y, origin_z",
                      spec_.key, spec_.set, 100 * cover, 100 * kLeastCover, surface_text()));
    const double around = block_.closed ? share_of_turn(of_body_) : 1;
    if (around < kLeastCover)
      throw InputError(
          fmt::format("{} = \"{}\": its faces go {:.1f} % of the way around the axle, at least {:.0f} % are "
                      "needed; name the set of all nodes of the tied surface; {}; see the keys unit and "
                      "origin_x, origin_y, origin_z",
                      spec_.key, spec_.set, 100 * around, 100 * kLeastCover, surface_text()));
  }

  std::string surface_text() const {
    return fmt::format("the tied surface of the {} has {}", block_.name, surface_extents(block_, spec_.path));
  }

  /// Mean size of the faces [m].
  static double coarseness(const Side& side) {
    return std::sqrt(area_of(side) / static_cast<double>(side.faces.size()));
  }

  [[noreturn]] void refuse(const SideNode& node, const FacePlace& place, double reach,
                           bool body_leads) const {
    const std::string off = place.face < 0 ? fmt::format("more than {:.3f} mm", reach / mm)
                                           : fmt::format("{:.3f} mm", place.distance / mm);
    const std::string who =
        body_leads
            ? fmt::format("a node of the {}", block_.name)
            : fmt::format("node {} of the file", body_.mesh.node_number[index(node.node.slot - body_.base)]);
    throw InputError(fmt::format(
        "{} = \"{}\": {} at ({:.3f}, {:.3f}, {:.3f}) mm of the {} lies {} off the faces of the {}, on which "
        "it is to be tied; at most a tenth of a face's edge is bridged; {}; see the keys unit and origin_x, "
        "origin_y, origin_z",
        spec_.key, spec_.set, who, node.at.x / mm, node.at.y / mm, node.at.z / mm,
        body_.spins ? "wheel" : "rail", off, body_leads ? fmt::format("set") : block_.name, surface_text()));
  }

  /// Moves the i-th secondary node.
  void move(std::size_t i, const Vec3& shift, bool body_leads) {
    if (!body_leads) {
      body_.mesh.nodes[index(set_[i])] += shift;
      return;
    }
    const std::vector<int>& line = path_of(block_, spec_.path);
    const int station = static_cast<int>(i / line.size());
    block_.node_shift[block_.slot(line[i % line.size()], station)] += to_local(block_, station, 0, shift);
  }

  /// InputError if moved nodes fold an element of the body. `farthest`: the longest way of a node [m].
  void require_shapes(double farthest) const {
    for (std::size_t e = 0; e < body_.mesh.elements.size(); ++e)
      if (!(hex_shape(body_.mesh.corners(e)).smallest_jacobian > 0))
        throw InputError(
            fmt::format("{} = \"{}\": the nodes of the set move by up to {:.3f} mm onto the faces of the {}, "
                        "which folds element {} of the file; correct the body's origin_x, origin_y or "
                        "origin_z, or make the layer of elements at the set thicker",
                        spec_.key, spec_.set, farthest / mm, block_.name, body_.mesh.element_number[e]));
  }

  const BodyTieSpec& spec_;
  SweptBlock& block_;
  HexBody& body_;
  const std::vector<std::int32_t>& set_;
  Side of_block_, of_body_;
};

}  // namespace

std::string surface_extents(const SweptBlock& block, const std::string& path) {
  double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
  for (const int node : path_of(block, path)) {
    const double at[2] = {block.section.p[index(node)], block.section.q[index(node)]};
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], at[i]);
      high[i] = std::max(high[i], at[i]);
    }
  }
  const auto span = [](double from, double to) {
    return to - from < 1e-9 ? fmt::format("{:.6g} mm", from / mm)
                            : fmt::format("{:.6g} to {:.6g} mm", from / mm, to / mm);
  };
  return fmt::format("y = {}, {} = {}", span(low[0], high[0]),
                     block.sweep == Sweep::revolved ? "radius" : "z", span(low[1], high[1]));
}

BodyTie tie_body(Mesh& mesh, const BodyTieSpec& spec) {
  return TieMaker(mesh, spec).tie();
}

}  // namespace tread
