#pragma once
// Meshes drawn to scale as SVG.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.hpp"
#include "core/mesh/section.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

using Polygon = std::vector<std::array<double, 2>>;  ///< horizontal and vertical coordinate [m]

/// Shapes drawn in one colour.
struct Layer {
  std::string label;
  std::vector<Polygon> cells;  ///< closed and tinted polygons
  std::vector<Polygon> lines;  ///< open polygons
};

/// Lower left and upper right corner [m].
struct Window {
  std::array<double, 2> low;
  std::array<double, 2> high;
};

/// Returns true if the rectangle about the polygon and the window have a point in common.
bool touches(const Polygon& polygon, const Window& window);

struct Drawing {
  std::string title;
  std::vector<Layer> layers;
  std::optional<Window> window;  ///< shown window; absent: everything
  double width = 440;            ///< width [px of a page 920 px wide]
};

/// Drawings side by side if the page is wide enough.
struct Drawings {
  std::string name;  ///< name of their files; empty: they have none
  std::vector<Drawing> drawings;
};

/// Quads of a section seen along x, y to the right and z up: an extruded section at `origin` (y, z), a
/// revolved one below its axis at `origin`.
Layer section_layer(std::string label, const Section& section, Sweep sweep,
                    std::array<double, 2> origin = {0, 0});

/// Stations of a block seen from the side, x to the right and z up: lines across the section's outline and
/// along its ends, at the frame angle 0 and moved to `origin`.
Layer side_layer(std::string label, const SweptBlock& block, const Vec3& origin = {});

/// A `figure` element: title, SVG with a scale bar, legend.
std::string drawing_html(const Drawing& drawing);

/// The drawings with titles and legends as a self-contained SVG file.
std::string drawings_svg(const Drawings& drawings);

}  // namespace tread
