#include "kernels/hexahedra/hex_force.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/element/hexahedron.hpp"
#include "kernels/hexahedra/hex_chunks.hpp"
#include "kernels/hexahedra/hex_fields.hpp"

namespace tread {

namespace {

static_assert(kHexPlace * (kChunkNodes + 8) < (1U << 16U));  // places of nodes have 16 bits

/// Nodes behind those of a chunk, for lanes without an element: a cube at rest.
constexpr std::size_t kIdleNodes = 8;
constexpr std::array<std::array<double, kHexNodeValues>, kIdleNodes> kIdleCorners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

constexpr std::int64_t kRow = kHexNodeValues;
typedef double Row __attribute__((vector_size(kRow * sizeof(double))));

Row row_at(const double* field, std::int64_t node) {
  Row row;
  std::memcpy(&row, field + kRow * node, sizeof row);
  return row;
}
void set_row(double* field, std::int64_t node, const Row& row) {
  std::memcpy(field + kRow * node, &row, sizeof row);
}

HexMaterial constants_of(const Material& material) {
  HexMaterial constants;
  constants.point.lambda = material.lame_lambda();
  constants.point.mu = constants.mu = material.shear_modulus();
  constants.point.inverse_volume = 1;
  constants.youngs_third = material.youngs_modulus / 3;
  constants.plate = material.youngs_modulus / (1 - material.poissons_ratio * material.poissons_ratio);
  constants.plate_nu = material.poissons_ratio * constants.plate;
  return constants;
}

/// Writes the shape of an element to a lane: polar decomposition of the centre Jacobian. [theory.md, Element]
void set_shape(const std::array<Vec3, 8>& corners, std::size_t lane, HexShapes& shapes) {
  const ElementGeometry geometry = element_geometry(corners);
  Eigen::Matrix3d map;
  for (int i = 0; i < 3; ++i)
    for (int m = 0; m < 3; ++m) map(i, m) = geometry.position[index(m)][i] / 8;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  const Eigen::Vector3d half = (rotation.transpose() * map).diagonal();
  const Eigen::Quaterniond turn(rotation);
  shapes.turn[0][lane] = turn.w();
  for (int i = 0; i < 3; ++i) {
    shapes.turn[1 + i][lane] = turn.vec()(i);
    shapes.scale[i][lane] = std::sqrt(geometry.volume / 192) / half(i);
  }
}

/// A thread's values at the nodes of a chunk.
double* scratch(std::size_t values) {
  thread_local AlignedVector<double> buffer;
  if (buffer.size() < values) buffer.resize(values);
  return buffer.data();
}

}  // namespace

HexForce::HexForce(const HexMesh& mesh, std::vector<Material> materials)
    : mesh_(&mesh), materials_(std::move(materials)), forces_(hex_forces().front()) {
  TREAD_EXPECT(materials_.size() == mesh.parts.size());
  for (const Material& material : materials_) constants_.push_back(constants_of(material));
  cut_into_chunks();
  share_nodes();
}

void HexForce::cut_into_chunks() {
  for (const std::vector<std::int32_t>& elements : hex_chunks(*mesh_))
    add_chunk(elements, nodes_of(*mesh_, elements));
  largest_chunk_ = kIdleNodes;
  for (const Chunk& chunk : chunks_) largest_chunk_ = std::max(largest_chunk_, chunk.nodes + kIdleNodes);
}

void HexForce::add_chunk(std::span<const std::int32_t> elements, const std::vector<std::int32_t>& nodes) {
  Chunk chunk;
  chunk.first_pack = packs_.size();
  chunk.first_node = places_.size();
  const Vec3& origin = mesh_->nodes[index(nodes.front())];  // a near one, for the sake of digits
  chunk.first_position = positions_.size() / kHexNodeValues;
  for (const std::int32_t node : nodes) {
    places_.push_back({node, -1});
    const Vec3 at = mesh_->nodes[index(node)] - origin;
    positions_.insert(positions_.end(), {at.x, at.y, at.z, 0.0});
  }
  for (const auto& corner : kIdleCorners) positions_.insert(positions_.end(), corner.begin(), corner.end());
  chunk.nodes = nodes.size();
  chunk.first_row = rows_.size();
  std::vector<std::int32_t> rest;
  for (const ElementRow& row : find_rows(*mesh_, elements, rest)) add_row(row, nodes);
  chunk.rows = rows_.size() - chunk.first_row;
  std::stable_sort(rest.begin(), rest.end(), [&](std::int32_t a, std::int32_t b) {
    return mesh_->part[index(a)] < mesh_->part[index(b)];
  });
  for (std::size_t i = 0; i < rest.size();) {
    std::size_t end = i + 1;
    while (end < rest.size() && end < i + kLanes &&
           mesh_->part[index(rest[end])] == mesh_->part[index(rest[i])])
      ++end;
    add_pack({rest.data() + i, end - i}, nodes);
    i = end;
  }
  chunk.packs = packs_.size() - chunk.first_pack;
  chunks_.push_back(chunk);
}

namespace {

/// Place of the n-th of a chunk's nodes, or of those behind them.
std::uint16_t place(std::size_t n) {
  return static_cast<std::uint16_t>(kHexPlace * n);
}
/// `nodes`: the chunk's, ascending.
std::uint16_t place_of(std::int32_t node, const std::vector<std::int32_t>& nodes) {
  return place(index(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()));
}

}  // namespace

void HexForce::add_row(const ElementRow& row, const std::vector<std::int32_t>& nodes) {
  HexRow& made = rows_.emplace_back();
  made.shapes.material = mesh_->part[index(row.element[0])];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::array<Vec3, 8> corners;
    for (std::size_t k = 0; k < 8; ++k) corners[k] = mesh_->nodes[index(row.line[k % 4][lane + k / 4])];
    set_shape(corners, lane, made.shapes);
  }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i <= kLanes; ++i) made.corner[k][i] = place_of(row.line[k][i], nodes);
}

void HexForce::add_pack(std::span<const std::int32_t> elements, const std::vector<std::int32_t>& nodes) {
  HexPack& pack = packs_.emplace_back();
  pack.shapes.material = mesh_->part[index(elements[0])];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const bool idle = lane >= elements.size();
    const std::size_t e = index(elements[idle ? 0 : lane]);
    set_shape(mesh_->corners(e), lane, pack.shapes);
    for (std::size_t k = 0; k < 8; ++k)
      pack.corner[k][lane] = idle ? place(nodes.size() + k) : place_of(mesh_->elements[e][k], nodes);
  }
}

void HexForce::share_nodes() {
  std::vector<std::int32_t> chunks_at(mesh_->nodes.size(), 0);
  for (const NodePlace& place : places_) ++chunks_at[index(place.node)];
  std::vector<std::int32_t> next(mesh_->nodes.size(), -1);
  std::int32_t partial = 0;
  for (std::size_t node = 0; node < chunks_at.size(); ++node) {
    if (chunks_at[node] < 2) continue;
    next[node] = partial;
    partial += chunks_at[node];
    shared_.push_back({static_cast<std::int32_t>(node), next[node], partial});
  }
  for (NodePlace& place : places_)  // chunk by chunk
    if (next[index(place.node)] >= 0) place.partial = next[index(place.node)]++;
  partial_.assign(index(kRow * partial), 0.0);
}

HexView HexForce::view(const Chunk& chunk) const {
  HexView view;
  view.rows = rows_.data() + chunk.first_row;
  view.row_count = static_cast<std::ptrdiff_t>(chunk.rows);
  view.packs = packs_.data() + chunk.first_pack;
  view.pack_count = static_cast<std::ptrdiff_t>(chunk.packs);
  view.materials = constants_.data();
  return view;
}

template <class U, class V>
void HexForce::load(const Chunk& chunk, const U& u, const V* added, double* values) const {
  const NodePlace* const places = places_.data() + chunk.first_node;
  const double* const positions = positions_.data() + index(kRow) * chunk.first_position;
  const auto nodes = static_cast<std::int64_t>(chunk.nodes);
  for (std::int64_t n = 0; n < nodes; ++n) {
    HexValues moved, more = {};
    u.get(places[n].node, moved);
    if (added != nullptr) added->get(places[n].node, more);
    set_row(values, 2 * n, row_at(positions, n));
    double* const to = values + kRow * (2 * n + 1);
    for (int c = 0; c < 3; ++c) to[c] = added != nullptr ? moved[c] + damping_ * more[c] : moved[c];
    to[3] = 0;
  }
  for (std::int64_t n = nodes; n < nodes + static_cast<std::int64_t>(kIdleNodes); ++n) {
    set_row(values, 2 * n, row_at(positions, n));
    set_row(values, 2 * n + 1, Row{});
  }
}

/// `added`: null where there is no damping.
template <class U, class V, class F>
void HexForce::evaluate(const U& u, const V* added, const F& f, bool finite_rotation) const {
  parallel_ranges(static_cast<std::int64_t>(chunks_.size()), [&](std::int64_t first, std::int64_t last) {
    const std::size_t values = kHexNodeValues * largest_chunk_;
    double* const nodes = scratch(3 * values);
    double* const force = nodes + 2 * values;
    for (std::int64_t i = first; i < last; ++i) {
      const Chunk& chunk = chunks_[index(i)];
      load(chunk, u, added, nodes);
      std::fill_n(force, kHexNodeValues * (chunk.nodes + kIdleNodes), 0.0);
      HexView at = view(chunk);
      at.nodes = nodes;
      at.f = force;
      forces_->force[finite_rotation ? 1 : 0](at);
      const NodePlace* const places = places_.data() + chunk.first_node;
      for (std::int64_t n = 0; n < static_cast<std::int64_t>(chunk.nodes); ++n)
        if (places[n].partial >= 0)
          set_row(partial_.data(), places[n].partial, row_at(force, n));
        else
          f.set(places[n].node, force + kRow * n);
    }
  });
  parallel_ranges(static_cast<std::int64_t>(shared_.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const SharedNode& node = shared_[index(i)];
      Row sum{};
      for (std::int64_t k = node.first; k < node.last; ++k) sum += row_at(partial_.data(), k);
      double row[kRow];
      std::memcpy(row, &sum, sizeof row);
      f.set(node.node, row);
    }
  });
}

void HexForce::internal_force(const double* u, const double* added, double* f) const {
  const HexRows<const double> damped{added};
  evaluate(HexRows<const double>{u}, added != nullptr && damping_ != 0 ? &damped : nullptr,
           HexRows<double>{f}, finite_rotation_);
}

void HexForce::apply(const double* u, double* f) const {
  evaluate<HexRows<const double>, HexRows<const double>>({u}, nullptr, HexRows<double>{f}, false);
}

template <class U, class Real>
void HexForce::internal_force_at(std::int64_t slot, const U* u, const Real* added, Real* f) const {
  const HexSlots<const Real> damped{added, slot};
  evaluate(HexSlots<const U>{u, slot}, added != nullptr && damping_ != 0 ? &damped : nullptr,
           HexSlots<Real>{f, slot}, finite_rotation_);
}

template void HexForce::internal_force_at(std::int64_t, const double*, const double*, double*) const;
template void HexForce::internal_force_at(std::int64_t, const double*, const float*, float*) const;
template void HexForce::internal_force_at(std::int64_t, const float*, const float*, float*) const;

void HexForce::apply_at(std::int64_t slot, const double* u, double* f) const {
  using Field = HexSlots<const double>;
  evaluate<Field, Field>({u, slot}, nullptr, HexSlots<double>{f, slot}, false);
}

template <class U>
DeformationEnergy HexForce::energy_of(const U& u, bool finite_rotation) const {
  std::vector<DeformationEnergy> parts(chunks_.size());
  parallel_ranges(static_cast<std::int64_t>(chunks_.size()), [&](std::int64_t first, std::int64_t last) {
    double* const nodes = scratch(2 * kHexNodeValues * largest_chunk_);
    for (std::int64_t i = first; i < last; ++i) {
      load<U, U>(chunks_[index(i)], u, nullptr, nodes);
      HexView at = view(chunks_[index(i)]);
      at.nodes = nodes;
      parts[index(i)] = forces_->energy[finite_rotation ? 1 : 0](at);
    }
  });
  DeformationEnergy sum;
  for (const DeformationEnergy& part : parts) {
    sum.strain += part.strain;
    sum.hourglass += part.hourglass;
  }
  return sum;
}

DeformationEnergy HexForce::energy(const double* u) const {
  return energy_of(HexRows<const double>{u}, finite_rotation_);
}

DeformationEnergy HexForce::energy_at(std::int64_t slot, ConstNodeField u) const {
  return energy_of(HexViewedSlots{u, slot}, finite_rotation_);
}

DeformationEnergy HexForce::linear_energy_at(std::int64_t slot, ConstNodeField u) const {
  return energy_of(HexViewedSlots{u, slot}, false);
}

std::vector<double> HexForce::lumped_mass() const {
  std::vector<double> mass(mesh_->nodes.size(), 0.0);
  for (std::size_t e = 0; e < mesh_->elements.size(); ++e) {
    const std::array<double, 8> volume = element_geometry(mesh_->corners(e)).nodal_volume;
    for (std::size_t k = 0; k < 8; ++k)
      mass[index(mesh_->elements[e][k])] += materials_[index(mesh_->part[e])].density * volume[k];
  }
  return mass;
}

std::vector<double> HexForce::diagonal() const {
  std::vector<double> diagonal(kRow * mesh_->nodes.size(), 0.0);
  for (std::size_t e = 0; e < mesh_->elements.size(); ++e) {
    const auto corners = mesh_->corners(e);
    const Material& material = materials_[index(mesh_->part[e])];
    const HexahedronCoefficients c = hexahedron_coefficients({corners, corners, material});
    for (std::size_t k = 0; k < 8; ++k)
      for (int i = 0; i < 3; ++i) {
        const double own = c.gradient[k][i] * c.gradient[k][i];
        const double all = dot(c.gradient[k], c.gradient[k]);
        const std::size_t row = 3 * k + index(i);
        diagonal[kRow * index(mesh_->elements[e][k]) + index(i)] +=
            c.volume * (material.lame_lambda() * own + material.shear_modulus() * (all + own)) +
            c.hourglass_stiffness[row][row];
      }
  }
  return diagonal;
}

HexFrequency HexForce::max_frequency() const {
  std::vector<double> omega(mesh_->elements.size());
  parallel_ranges(static_cast<std::int64_t>(omega.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::size_t e = index(first); e < index(last); ++e) {
      const auto corners = mesh_->corners(e);
      omega[e] = hexahedron_frequency({corners, corners, materials_[index(mesh_->part[e])]});
    }
  });
  const auto highest = std::max_element(omega.begin(), omega.end());
  if (highest == omega.end()) return {};
  return {*highest, index(highest - omega.begin())};
}

std::int64_t HexForce::bytes() const {
  const auto of = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return static_cast<std::int64_t>(of(rows_) + of(packs_) + of(positions_) + of(chunks_) + of(places_) +
                                   of(shared_) + of(partial_));
}

std::vector<const char*> HexForce::instruction_sets() {
  std::vector<const char*> names;
  for (const HexForces* forces : hex_forces()) names.push_back(forces->name);
  return names;
}

void HexForce::use_instruction_set(const char* name) {
  for (const HexForces* forces : hex_forces())
    if (std::string_view(forces->name) == name) {
      forces_ = forces;
      return;
    }
  throw InputError(std::string("this program on this processor has no instruction set ") + name);
}

}  // namespace tread
