#pragma once
// A section swept along a line of stations, cut into tiles: the unit of storage and of parallel work.
//
// Local basis of a node, components 0, 1, 2 of every vector field:
//   extruded: (x, y, z) for all nodes;
//   revolved: (t, y, r) at the node's own angle phi about the y axis. phi = 0 points down (-z), phi grows
//   with
//             positive rotation about +y: r = (-sin phi, 0, -cos phi), t = (-cos phi, 0, sin phi), t x y = r.
// Element coordinates (xi, eta, zeta): xi along the sweep, (eta, zeta) in the quad.

#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/inline.hpp"
#include "core/material.hpp"
#include "core/math/vec.hpp"
#include "core/mesh/hex_mesh.hpp"
#include "core/mesh/section.hpp"

namespace tread {

/// Stations per tile: lanes of one vector register in double precision.
inline constexpr int kLanes = 8;

enum class Sweep { extruded, revolved };

/// Successive elements of one pitch along the sweep.
struct Segment {
  int elements = 0;
  double pitch = 0;         ///< length [m] (extruded) or angle [rad] (revolved) of one element
  int material_offset = 0;  ///< offset to Section::quad_material here (slab gaps of another material)
};

/// Up to kLanes consecutive stations and the elements that start at them. Lane l holds station
/// first_station + l; element l joins stations l and l + 1; the last element's far station is lane 0 of tile
/// `next`. All elements of a tile share one pitch class.
struct Tile {
  int first_station = 0;
  int stations = 0;  ///< used lanes, 1 ... kLanes
  int elements = 0;  ///< `stations`, or 0 in the tile that only holds the last station of an open block
  int pitch_class = 0;
  int next = -1;  ///< tile that holds the station after this one's last element; -1 if none
};

/// Successive tiles of a block, which may pass the end of a full turn.
struct TileSpan {
  int first = 0, count = 0;
};

/// Pitch and material of the elements of a tile. All elements of (quad, class) share their coefficients.
struct PitchClass {
  double pitch = 0;
  int material_offset = 0;
};

struct SweptBlock {
  std::string name;
  Sweep sweep = Sweep::extruded;
  bool closed = false;  ///< true for a full turn: the last element ends at station 0
  /// True if nodes move along component 2 only and the others stay zero. For extruded blocks of a linear law.
  bool vertical_only = false;
  Section section;
  std::vector<Material> materials;

  std::vector<double> stations;  ///< coordinate of each station along the sweep [m or rad]
  std::vector<Tile> tiles;
  std::vector<PitchClass> classes;
  std::int64_t base = 0;  ///< slot of (tile 0, section node 0, lane 0) in the mesh's node fields

  /// Displacement of nodes from their swept position, in their local basis [m], by slot relative to `base`.
  /// Nodes are shifted for a corrugation and, at interfaces, onto the chords of a coarser block. Elements
  /// that touch a shifted node have a shape of their own.
  std::map<std::int64_t, Vec3> node_shift;

  std::int64_t slots() const { return static_cast<std::int64_t>(tiles.size()) * section.nodes() * kLanes; }
  std::int64_t nodes() const { return static_cast<std::int64_t>(stations.size()) * section.nodes(); }
  std::int64_t elements() const;
  int station_count() const { return static_cast<int>(stations.size()); }

  /// Slot of a node relative to `base`: (tile * section nodes + section node) * kLanes + lane.
  std::int64_t slot(int section_node, int station) const {
    const int tile = tile_of_station[static_cast<std::size_t>(station)];
    return (static_cast<std::int64_t>(tile) * section.nodes() + section_node) * kLanes +
           (station - tiles[static_cast<std::size_t>(tile)].first_station);
  }
  std::vector<int> tile_of_station;

  /// Length [m] or angle [rad] of the element that starts at a station.
  double pitch(int station) const {
    const auto tile = static_cast<std::size_t>(tile_of_station[static_cast<std::size_t>(station)]);
    return classes[static_cast<std::size_t>(tiles[tile].pitch_class)].pitch;
  }

  /// Material of the elements of (quad, class).
  const Material& material(int quad, int pitch_class) const {
    const auto index = section.quad_material[static_cast<std::size_t>(quad)] +
                       classes[static_cast<std::size_t>(pitch_class)].material_offset;
    return materials[static_cast<std::size_t>(index)];
  }
};

/// Lays out stations and tiles. Extruded: stations start at `start` [m]. Revolved: stations start at angle
/// `start` [rad]; if the segments add up to 2 pi (to 1e-9), the block is closed and the last station is
/// station 0.
SweptBlock make_swept_block(std::string name, Sweep sweep, Section section, std::vector<Material> materials,
                            double start, const std::vector<Segment>& segments);

/// Position of a node (its shift included) in the body frame [m]. Extruded: (x, y, z). Revolved: relative to
/// the axis, at frame angle 0.
Vec3 position(const SweptBlock& block, int section_node, int station);

/// Rotates a vector from the node's local basis to Cartesian axes, at frame angle `angle` [rad]. Returns it
/// unchanged for extruded blocks.
Vec3 to_cartesian(const SweptBlock& block, int station, double angle, const Vec3& local);
Vec3 to_local(const SweptBlock& block, int station, double angle, const Vec3& cartesian);

/// The elements of a swept block one by one: node `station * section nodes + section node`, parts by the
/// block's materials.
HexMesh hexahedra_of(const SweptBlock& block);

/// A body of hexahedra of another program beside the swept blocks. Components of vector fields are Cartesian,
/// in the axes of the body: of a wheel's those of the frame at angle 0.
struct HexBody {
  std::string name;
  HexMesh mesh;                     ///< positions in the body frame, of a wheel relative to its axis [m]
  std::vector<Material> materials;  ///< by part of the mesh
  bool spins = false;               ///< with the wheel's frame
  std::int64_t base = 0;            ///< slot of node 0 in the mesh's node fields

  std::int64_t nodes() const { return static_cast<std::int64_t>(mesh.nodes.size()); }
  std::int64_t elements() const { return static_cast<std::int64_t>(mesh.elements.size()); }
  std::int64_t slots() const { return (nodes() + kLanes - 1) / kLanes * kLanes; }
  std::int64_t slot(std::int64_t node) const { return base + node; }
};

/// Angle of a station of a revolved block whose basis (t, y, r) is (x, y, z): a node of a spinning HexBody is
/// one of such a station, at (x, y, z) in place of (0, y, r).
inline constexpr double kCartesianAngle = std::numbers::pi;

/// The bodies of a model. Node fields are contiguous over all of them; unused lanes hold zero.
struct Mesh {
  std::vector<SweptBlock> blocks;
  std::vector<HexBody> bodies;  ///< after the blocks in the fields
  std::int64_t slots = 0;       ///< node slots over all blocks and bodies, a multiple of kLanes

  /// Appends a block or a body, gives it its base and returns its index.
  int add(SweptBlock block);
  int add(HexBody body);

  /// Number of blocks and bodies, and the name of one: blocks come first.
  int parts() const { return static_cast<int>(blocks.size() + bodies.size()); }
  const std::string& part_name(int part) const;
  /// The body that a part is; null: a block.
  const HexBody* body_of(int part) const {
    const auto b = static_cast<std::size_t>(part);
    return b < blocks.size() ? nullptr : &bodies[b - blocks.size()];
  }
};

/// Calls visit(slot, place in the body frame [m]) for the nodes of the bodies that spin, or of those that do
/// not.
template <class Visit>
void for_each_body_node(const Mesh& mesh, bool spinning, const Visit& visit) {
  for (const HexBody& body : mesh.bodies)
    for (std::int64_t node = 0; body.spins == spinning && node < body.nodes(); ++node)
      visit(body.slot(node), body.mesh.nodes[static_cast<std::size_t>(node)]);
}

/// Index of a component of a node in a vector field of 3 * mesh.slots values. Within a group of kLanes slots
/// the components follow one another, lanes contiguous.
TREAD_BODY std::int64_t dof(std::int64_t slot, int component) {
  return (slot / kLanes * 3 + component) * kLanes + slot % kLanes;
}

/// Slot and component of an index that dof() gives.
TREAD_BODY std::int64_t slot_of(std::int64_t unknown) {
  return unknown / (3 * kLanes) * kLanes + unknown % kLanes;
}
TREAD_BODY int component_of(std::int64_t unknown) {
  return static_cast<int>(unknown / kLanes % 3);
}

}  // namespace tread
