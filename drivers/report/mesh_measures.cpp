#include "drivers/report/mesh_measures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/mesh/structured.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

namespace {

using Corners = std::array<Vec3, 8>;  ///< quad at one station, quad at the next

// Neighbours of a corner along the sweep, along the quad's next edge and its edge before, with the sign that
// makes the Jacobian of a good element positive.
double corner_jacobian(const Corners& x, std::size_t corner) {
  const std::size_t face = corner / 4 * 4;
  const std::size_t next = face + (corner + 1) % 4;
  const std::size_t before = face + (corner + 3) % 4;
  const std::size_t across = (corner + 4) % 8;
  const double sign = corner < 4 ? 1 : -1;
  return sign * dot(x[across] - x[corner], cross(x[next] - x[corner], x[before] - x[corner]));
}

double quality(const Corners& x) {
  double smallest = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const double jacobian = corner_jacobian(x, corner);
    smallest = std::min(smallest, jacobian);
    sum += jacobian;
  }
  return sum > 0 ? 8 * smallest / sum : -1;
}

void keep_smaller(Extreme& extreme, double value, const Vec3& at) {
  if (value < extreme.value) extreme = {value, at};
}

void measure_element(const Corners& x, BlockMeasures& out) {
  const Vec3 middle = 0.5 * (x[0] + x[6]);
  for (std::size_t i = 0; i < 4; ++i)
    for (const double edge :
         {norm(x[i] - x[(i + 1) % 4]), norm(x[i + 4] - x[(i + 1) % 4 + 4]), norm(x[i] - x[i + 4])}) {
      keep_smaller(out.shortest_edge, edge, middle);
      if (edge > out.longest_edge.value) out.longest_edge = {edge, middle};
    }
  keep_smaller(out.worst_quality, quality(x), middle);
}

void measure_elements(const SweptBlock& block, BlockMeasures& out) {
  const auto nodes_at = [&](int station) {
    std::vector<Vec3> nodes;
    nodes.reserve(static_cast<std::size_t>(block.section.nodes()));
    for (int node = 0; node < block.section.nodes(); ++node) nodes.push_back(position(block, node, station));
    return nodes;
  };
  std::vector<Vec3> here = nodes_at(0);
  const int layers = block.closed ? block.station_count() : block.station_count() - 1;
  for (int station = 0; station < layers; ++station) {
    std::vector<Vec3> there = nodes_at((station + 1) % block.station_count());
    for (const auto& quad : block.section.quads) {
      Corners x;
      for (std::size_t i = 0; i < 4; ++i) {
        x[i] = here[static_cast<std::size_t>(quad[i])];
        x[i + 4] = there[static_cast<std::size_t>(quad[i])];
      }
      measure_element(x, out);
    }
    here = std::move(there);
  }
}

/// Area (extruded, per metre) or first moment of area about the axis (revolved, per radian) of a quad.
double swept_measure(const SweptBlock& block, int quad) {
  if (block.sweep == Sweep::extruded) return quad_area(block.section, quad);
  Section one;
  for (const int node : block.section.quads[static_cast<std::size_t>(quad)]) {
    one.p.push_back(block.section.p[static_cast<std::size_t>(node)]);
    one.q.push_back(block.section.q[static_cast<std::size_t>(node)]);
  }
  one.quads = {{0, 1, 2, 3}};
  return revolved_moments(one).volume / (2 * std::numbers::pi);
}

double swept_mass(const SweptBlock& block) {
  std::vector<double> sweep(block.classes.size(), 0.0);  // [m or rad] by class
  for (const Tile& tile : block.tiles) {
    const auto c = static_cast<std::size_t>(tile.pitch_class);
    sweep[c] += tile.elements * block.classes[c].pitch;
  }
  double sum = 0;
  for (int quad = 0; quad < static_cast<int>(block.section.quads.size()); ++quad) {
    const double measure = swept_measure(block, quad);
    for (std::size_t c = 0; c < sweep.size(); ++c)
      sum += sweep[c] * measure * block.material(quad, static_cast<int>(c)).density;
  }
  return sum;
}

}  // namespace

std::string place(const Vec3& at) {
  return fmt::format("({:.3f}, {:.4f}, {:.4f})", at.x, at.y, at.z);
}

std::vector<BlockMeasures> measure_blocks(const Model& model) {
  AlignedVector<double> mass(static_cast<std::size_t>(model.mesh.slots), 0.0);
  model.add_lumped_mass(mass.data());
  std::vector<BlockMeasures> list;
  for (const SweptBlock& block : model.mesh.blocks) {
    BlockMeasures out;
    out.name = block.name;
    out.elements = block.elements();
    out.nodes = block.nodes();
    out.quads = static_cast<int>(block.section.quads.size());
    out.stations = block.station_count();
    out.shortest_edge.value = out.worst_quality.value = std::numeric_limits<double>::infinity();
    measure_elements(block, out);
    for (std::int64_t slot = block.base; slot < block.base + block.slots(); ++slot)
      out.mass += mass[static_cast<std::size_t>(slot)];
    out.swept_mass = swept_mass(block);
    list.push_back(out);
  }
  for (const HexBody& body : model.mesh.bodies) {
    BlockMeasures out;
    out.name = body.name;
    out.elements = body.elements();
    out.nodes = body.nodes();
    out.shortest_edge.value = out.worst_quality.value = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) measure_element(body.mesh.corners(e), out);
    for (std::int64_t slot = body.base; slot < body.base + body.slots(); ++slot)
      out.mass += mass[static_cast<std::size_t>(slot)];
    out.swept_mass = out.mass;
    list.push_back(out);
  }
  return list;
}

std::vector<BlockGroup> block_groups(const Model& model) {
  const std::vector<int>& sleepers = model.index.sleepers;
  std::vector<BlockGroup> groups;
  for (int b = 0; b < model.mesh.parts(); ++b) {
    if (!sleepers.empty() && b == sleepers.front())
      groups.push_back({fmt::format("{} half sleepers", sleepers.size()), sleepers});
    else if (std::find(sleepers.begin(), sleepers.end(), b) == sleepers.end())
      groups.push_back({model.mesh.part_name(b), {b}});
  }
  return groups;
}

std::vector<BlockMeasures> by_group(const Model& model, const std::vector<BlockMeasures>& blocks) {
  std::vector<BlockMeasures> list;
  for (const BlockGroup& group : block_groups(model)) {
    BlockMeasures all = blocks[static_cast<std::size_t>(group.blocks.front())];
    all.name = group.name;
    for (std::size_t i = 1; i < group.blocks.size(); ++i) {
      const BlockMeasures& one = blocks[static_cast<std::size_t>(group.blocks[i])];
      all.elements += one.elements;
      all.nodes += one.nodes;
      all.mass += one.mass;
      all.swept_mass += one.swept_mass;
      keep_smaller(all.shortest_edge, one.shortest_edge.value, one.shortest_edge.at);
      keep_smaller(all.worst_quality, one.worst_quality.value, one.worst_quality.at);
      if (one.longest_edge.value > all.longest_edge.value) all.longest_edge = one.longest_edge;
    }
    list.push_back(all);
  }
  return list;
}

Table count_table(const std::vector<BlockMeasures>& blocks) {
  Table table{"",
              {{"Block"},
               {"Elements", Align::right},
               {"Nodes", Align::right},
               {"Quads of the section", Align::right},
               {"Stations", Align::right}},
              {}};
  std::int64_t elements = 0;
  std::int64_t nodes = 0;
  for (const BlockMeasures& b : blocks) {
    const bool swept = b.stations > 0;
    table.rows.push_back({b.name, grouped(b.elements), grouped(b.nodes), swept ? grouped(b.quads) : "",
                          swept ? grouped(b.stations) : ""});
    elements += b.elements;
    nodes += b.nodes;
  }
  if (blocks.size() > 1) table.rows.push_back({"all", grouped(elements), grouped(nodes), "", ""});
  return table;
}

Table quality_table(const std::vector<BlockMeasures>& blocks) {
  Table table{"",
              {{"Block"},
               {"Shortest edge [mm]", Align::right},
               {"at (x, y, z) [m]"},
               {"Longest edge [mm]", Align::right},
               {"Worst quality", Align::right},
               {"at (x, y, z) [m]"}},
              {}};
  for (const BlockMeasures& b : blocks)
    table.rows.push_back({b.name, fmt::format("{:.3f}", 1e3 * b.shortest_edge.value),
                          place(b.shortest_edge.at), fmt::format("{:.1f}", 1e3 * b.longest_edge.value),
                          fmt::format("{:.3f}", b.worst_quality.value), place(b.worst_quality.at)});
  return table;
}

}  // namespace tread
