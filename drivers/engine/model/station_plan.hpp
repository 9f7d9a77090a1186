#pragma once
// Where the stations of the swept blocks stand: fine where the patch passes, coarse elsewhere, nested for the
// ties.

#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/scene.hpp"

namespace tread {

/// Element sizes that a quality stands for.
struct MeshSizes {
  double contact = 0;          ///< h: in the patch, solution zone [m]
  double far = 0;              ///< largest pitch along the rail [m]
  double section = 0;          ///< coarse quads of rail base, disc and axle [m]
  double slab = 0;             ///< pitch and quads of slab and mortar [m]
  int approach_ratio = 2;      ///< pitch along AB is this many h
  int coarse_ratio = 4;        ///< tied coarse blocks have this many h per element in the solution zone
  int axle_ratio = 4;          ///< axle elements per disc element along the sweep
  double band_half_width = 0;  ///< of the fine running band [m]
  double margin = 2.5;         ///< way beside a zone that keeps the approach pitch [m]
};

/// Sizes of the scene's quality, or scaled to its element size, and the scene's margin.
MeshSizes mesh_sizes(const Scene& scene);

/// An interval of x.
struct Span {
  double first = 0, last = 0;
  bool empty() const { return !(last > first); }
};

/// Stretch of the track that the wheel can touch, with a margin of 20 mm before its start and beyond speed
/// times duration, which the way that traction adds uses first; empty without [wheel].
Span run_span(const Scene& scene);

/// Returns true if the wheel hardly moves: at speed 0 less than 1 mm, or without [motion].
bool stands(const Scene& scene);

/// Stretch of the finely divided track: the solution zone and half a patch about it, or what the wheel can
/// touch where it stands elsewhere.
Span zone_span(const Scene& scene);

/// zone_span() and those of the tables [zone.NAME], in order.
std::vector<Span> zone_spans(const Scene& scene);

/// Stretch of the tread that meets a stretch of track, both counted from the wheel's start [m]. A stated
/// creepage turns the wheel by more or less than its way, and friction may bring it to roll: the arc covers
/// both cases and all between. It is the stretch itself where they differ by less than the arcs have to
/// spare.
Span arc_of(const Scene& scene, Span track);

/// Segments of the fine block and of the coarse block tied to it; they cover the same length and nest.
struct NestedSegments {
  std::vector<Segment> fine;
  std::vector<Segment> coarse;
};

/// Along the rail: h in the zones, a step to the approach pitch on both sides, that pitch over the margin,
/// twice it in the rest of `run` unless that were longer than 9 mm, growing to the far pitch outside of it.
/// Zones are in order.
NestedSegments plan_rail(Span rail, Span run, const std::vector<Span>& zones, const MeshSizes& sizes);

/// Along a rail without a wheel: one pitch, that of the tied coarse blocks. Waves run along all of it.
NestedSegments plan_even_rail(Span rail, const MeshSizes& sizes);

/// Around the wheel. Zones and runs are its arcs, arc_of().
struct WheelPlan {
  double start = 0;  ///< angle of the first station [rad]
  std::vector<Segment> tread;
  std::vector<Segment> disc;
  std::vector<Segment> axle;
};

/// h over the arcs that meet the zones, a step to the approach pitch on both sides, that pitch over the rest
/// of the turn.
WheelPlan plan_wheel(double radius, const std::vector<Span>& zones, const MeshSizes& sizes);

/// Around a tyre, nothing tied to it: h over the arcs that meet the zones, or all around where these reach
/// over more than a turn, approach pitch over what meets the rest of `run`, growing to twice the coarse
/// quads' size over the rest of the turn.
WheelPlan plan_tyre(double radius, Span run, std::vector<Span> zones, const MeshSizes& sizes);

/// Around the part of a tyre that rolls over `run`, and `overhang` [m] of tread before and behind it,
/// together kLargestPart of a turn at the most.
WheelPlan plan_tyre_part(double radius, Span run, const std::vector<Span>& zones, double overhang,
                         const MeshSizes& sizes);

/// Half length of the stretch of track that a wheel in contact can touch [m].
double patch_reach(double wheel_radius);

}  // namespace tread
