#include "core/mesh/swept_block.hpp"

#include <fmt/core.h>

#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"

namespace tread {

std::int64_t SweptBlock::elements() const {
  std::int64_t columns = 0;
  for (const Tile& tile : tiles) columns += tile.elements;
  return columns * static_cast<std::int64_t>(section.quads.size());
}

namespace {

int class_index(std::vector<PitchClass>& classes, const Segment& segment) {
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (classes[i].pitch == segment.pitch && classes[i].material_offset == segment.material_offset)
      return static_cast<int>(i);
  classes.push_back({segment.pitch, segment.material_offset});
  return static_cast<int>(classes.size()) - 1;
}

}  // namespace

SweptBlock make_swept_block(std::string name, Sweep sweep, Section section, std::vector<Material> materials,
                            double start, const std::vector<Segment>& segments) {
  validate(section, name);
  SweptBlock block;
  block.name = std::move(name);
  block.sweep = sweep;
  block.section = std::move(section);
  block.materials = std::move(materials);

  double length = 0;
  for (const Segment& segment : segments) {
    if (segment.elements < 1 || !(segment.pitch > 0))
      throw InputError(fmt::format("block '{}': a segment of {} elements of pitch {} is empty", block.name,
                                   segment.elements, segment.pitch));
    length += segment.elements * segment.pitch;
  }
  block.closed = sweep == Sweep::revolved && std::abs(length - 2 * std::numbers::pi) < 1e-9;

  double at = start;
  int station = 0;
  for (const Segment& segment : segments) {
    const int pitch_class = class_index(block.classes, segment);
    for (int done = 0; done < segment.elements; done += kLanes) {
      const int count = std::min(kLanes, segment.elements - done);
      block.tiles.push_back({station, count, count, pitch_class, static_cast<int>(block.tiles.size()) + 1});
      for (int i = 0; i < count; ++i) block.stations.push_back(at + (done + i) * segment.pitch);
      station += count;
    }
    at += segment.elements * segment.pitch;
  }
  if (block.closed) {
    block.tiles.back().next = 0;
  } else {
    block.tiles.push_back({station, 1, 0, block.tiles.back().pitch_class, -1});
    block.stations.push_back(at);
  }
  block.tile_of_station.resize(block.stations.size());
  for (std::size_t t = 0; t < block.tiles.size(); ++t)
    std::fill_n(block.tile_of_station.begin() + block.tiles[t].first_station, block.tiles[t].stations,
                static_cast<int>(t));
  return block;
}

Vec3 to_cartesian(const SweptBlock& block, int station, double angle, const Vec3& v) {
  if (block.sweep == Sweep::extruded) return v;
  const double phi = block.stations[static_cast<std::size_t>(station)] + angle;
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  return {-c * v.x - s * v.z, v.y, s * v.x - c * v.z};
}

Vec3 to_local(const SweptBlock& block, int station, double angle, const Vec3& v) {
  if (block.sweep == Sweep::extruded) return v;
  const double phi = block.stations[static_cast<std::size_t>(station)] + angle;
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  return {-c * v.x + s * v.z, v.y, -s * v.x - c * v.z};
}

Vec3 position(const SweptBlock& block, int section_node, int station) {
  const auto node = static_cast<std::size_t>(section_node);
  const double p = block.section.p[node];
  const double q = block.section.q[node];
  Vec3 local = block.sweep == Sweep::extruded ? Vec3{block.stations[static_cast<std::size_t>(station)], p, q}
                                              : Vec3{0, p, q};
  const auto shift = block.node_shift.find(block.slot(section_node, station));
  if (shift != block.node_shift.end()) local += shift->second;
  return to_cartesian(block, station, 0, local);
}

HexMesh hexahedra_of(const SweptBlock& block) {
  HexMesh mesh;
  const int stations = block.station_count();
  for (int station = 0; station < stations; ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      mesh.nodes.push_back(position(block, node, station));
      mesh.node_number.push_back(static_cast<std::int64_t>(mesh.nodes.size()));
    }
  for (const Material& material : block.materials) mesh.parts.push_back(material.name);
  for (const Tile& tile : block.tiles)
    for (int station = tile.first_station; station < tile.first_station + tile.elements; ++station)
      for (std::size_t quad = 0; quad < block.section.quads.size(); ++quad) {
        HexCorners corners;
        for (std::size_t k = 0; k < 8; ++k)
          corners[k] = (station + (k < 4 ? 0 : 1)) % stations * block.section.nodes() +
                       block.section.quads[quad][k % 4];
        mesh.elements.push_back(corners);
        mesh.element_number.push_back(static_cast<std::int64_t>(mesh.elements.size()));
        mesh.part.push_back(block.section.quad_material[quad] +
                            block.classes[index(tile.pitch_class)].material_offset);
      }
  return mesh;
}

int Mesh::add(SweptBlock block) {
  block.base = slots;
  slots += block.slots();
  blocks.push_back(std::move(block));
  return static_cast<int>(blocks.size()) - 1;
}

const std::string& Mesh::part_name(int part) const {
  const HexBody* body = body_of(part);
  return body != nullptr ? body->name : blocks[static_cast<std::size_t>(part)].name;
}

int Mesh::add(HexBody body) {
  body.base = slots;
  slots += body.slots();
  bodies.push_back(std::move(body));
  return static_cast<int>(bodies.size()) - 1;
}

}  // namespace tread
