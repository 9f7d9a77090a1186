#pragma once
// The plane quad mesh that is swept into a block.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tread {

/// One edge of a running surface: two section nodes and the exact profile's unit tangents at both ends.
/// Between the ends the exact profile is the cubic Hermite curve through them. [theory.md, Surfaces]
struct SurfaceEdge {
  int quad = -1;                                      ///< index of the quad that owns the edge
  std::array<int, 2> node = {-1, -1};                 ///< section nodes, in the direction of increasing p
  std::array<std::array<double, 2>, 2> tangent = {};  ///< unit tangents (dp, dq) at node[0] and node[1]
};

/// A conforming mesh of convex quads in the plane (p, q). Extruded blocks: p = y, q = z. Revolved blocks: p =
/// y along the axis, q = r the distance from the axis. Quads run counter-clockwise in (p, q).
struct Section {
  std::vector<double> p;                  ///< first coordinate of the nodes [m]
  std::vector<double> q;                  ///< second coordinate of the nodes [m]
  std::vector<std::array<int, 4>> quads;  ///< nodes of each quad, counter-clockwise
  std::vector<int> quad_material;         ///< material of each quad: an index into the block's materials

  /// Edges of the running surface by increasing p; the outward normal (-dq, dp) points out of the body. Empty
  /// if the section has none.
  std::vector<SurfaceEdge> surface;

  /// Named lists of section nodes, ordered along their line if they form one.
  std::map<std::string, std::vector<int>> paths;

  int nodes() const { return static_cast<int>(p.size()); }
};

/// A point's parameters in a quad: 0 to 1 inside, xi from node 0 to 1, eta from node 0 to 3.
struct QuadPlace {
  double xi = 0, eta = 0;

  /// Distance of the parameters from the unit square; 0 inside.
  double excess() const;
  /// Bilinear weights of the quad's nodes.
  std::array<double, 4> weights() const;
};

/// Inverse of the bilinear map of a quad at (p, q) [m], by Newton's method; nothing where it does not
/// converge.
std::optional<QuadPlace> place_in_quad(const Section& section, int quad, double p, double q);

/// Mean (p, q) of the quad's nodes [m].
std::array<double, 2> quad_middle(const Section& section, int quad);

/// Area enclosed by the quad [m2], positive if counter-clockwise.
double quad_area(const Section& section, int quad);

/// Smallest of the four corner Jacobians divided by the quad's mean Jacobian [-]: 1 for a parallelogram, <= 0
/// for a quad that is not convex.
double quad_quality(const Section& section, int quad);

/// Throws InputError that lists inverted, flat or repeated quads and nodes without a quad.
void validate(const Section& section, const std::string& name);

}  // namespace tread
