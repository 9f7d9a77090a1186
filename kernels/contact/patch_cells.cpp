#include "kernels/contact/patch_cells.hpp"

#include <algorithm>
#include <iterator>

#include "core/index.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

namespace {

static_assert(kCellNodes == kSupport);

const SurfaceSupport& support_of(const ContactPoint& point, int body) {
  return body == 0 ? point.rail : point.wheel;
}

}  // namespace

PatchCells::PatchCells() : lanes_(tile_forces().front()) {}

void PatchCells::reserve(std::int64_t slots, std::size_t points, std::size_t nodes) {
  node_of_ = PageVector<int>(index(slots));
  nodes_.reserve(nodes);
  last_cell_.reserve(nodes);
  // No body has more cells than nodes.
  const std::size_t cells = std::min(2 * points, nodes);
  cells_.reserve(cells);
  cell_number_.reserve(2 * points);
  point_.reserve(2 * points);
  weights_.reserve(2 * points);
  cell_sums_.reserve(cells * kCellNodes);
  first_term_.reserve(nodes + 2);
  term_.reserve(cells * kCellNodes);
  for (std::vector<PatchVector>& sums : sums_) sums.reserve(points);
}

void PatchCells::link(const std::vector<ContactPoint>& points, const double* mass) {
  mass_ = mass;
  nodes_.clear();
  last_cell_.clear();
  cells_.clear();
  cell_number_.clear();
  for (const int body : {0, 1}) find_cells(points, body);
  for (const Node& node : nodes_) node_of_[index(node.slot)] = 0;
  list_points(points);
  list_terms();
  for (std::vector<PatchVector>& sums : sums_) sums.resize(points.size());
}

void PatchCells::find_cells(const std::vector<ContactPoint>& points, int body) {
  for (const ContactPoint& point : points) {
    const int cell = cell_of(point, body);
    cell_number_.push_back(cell);
    ++cells_[index(cell)].count;
  }
}

/// The number of the point's cell, a new one if no point before lies in it.
int PatchCells::cell_of(const ContactPoint& point, int body) {
  constexpr std::size_t kCorner = 5;  // of the face: no other face has this node there
  const SurfaceSupport& support = support_of(point, body);
  const auto same = [&](const Cell& cell) {
    for (std::size_t k = 0; k < kSupport; ++k)
      if (nodes_[index(cell.node[k])].slot != support.slot[k]) return false;
    return true;
  };
  const int corner = node_of_[index(support.slot[kCorner])];
  const int known = corner == 0 ? -1 : last_cell_[index(corner - 1)];
  if (known >= 0 && same(cells_[index(known)])) return known;
  Cell cell{};
  cell.body = body;
  for (std::size_t k = 0; k < kSupport; ++k) {
    Node node{support.slot[k], body == 1, 1, 0, 0};
    if (node.of_wheel) {
      node.cosine = point.wheel_cosine[k / 4];
      node.sine = point.wheel_sine[k / 4];
    }
    cell.node[k] = number(node);
  }
  const auto added = static_cast<int>(std::ssize(cells_));
  last_cell_[index(cell.node[kCorner])] = added;
  cells_.push_back(cell);
  return added;
}

/// The number of a node, a new one if no cell before has it.
int PatchCells::number(const Node& node) {
  int& known = node_of_[index(node.slot)];
  if (known == 0) {
    nodes_.push_back(node);
    nodes_.back().inverse_mass = inverse_mass(mass_[node.slot]);
    last_cell_.push_back(-1);
    known = static_cast<int>(std::ssize(nodes_));
  }
  return known - 1;
}

/// Lists points and weights by cells.
void PatchCells::list_points(const std::vector<ContactPoint>& points) {
  int first = 0;
  for (Cell& cell : cells_) {
    cell.first = first;
    first += cell.count;
    cell.count = 0;
  }
  point_.resize(cell_number_.size());
  weights_.resize(cell_number_.size());
  for (std::size_t i = 0; i < cell_number_.size(); ++i) {
    Cell& cell = cells_[index(cell_number_[i])];
    const std::size_t point = i % points.size();
    const std::size_t place = index(cell.first + cell.count++);
    const SurfaceSupport& support = support_of(points[point], cell.body);
    point_[place] = static_cast<int>(point);
    std::copy(support.along.begin(), support.along.end(), weights_[place].along);
    std::copy(support.across.begin(), support.across.end(), weights_[place].across);
  }
}

/// Lists the cells' sums by nodes.
void PatchCells::list_terms() {
  cell_sums_.resize(cells_.size() * kCellNodes);
  term_.resize(cell_sums_.size());
  first_term_.assign(nodes_.size() + 2, 0);
  for (const Cell& cell : cells_)
    for (const int node : cell.node) ++first_term_[index(node) + 2];
  for (std::size_t n = 2; n < first_term_.size(); ++n) first_term_[n] += first_term_[n - 1];
  int term = 0;
  for (const Cell& cell : cells_)
    for (const int node : cell.node) term_[index(first_term_[index(node) + 1]++)] = term++;
}

CellPoints PatchCells::points_of(const Cell& cell) const {
  return {cell.count, point_.data() + cell.first, weights_.data() + cell.first};
}

void PatchCells::to_nodes(const std::vector<PatchVector>& points, std::vector<PatchVector>& nodes) {
  share_patch(points.size(), cells_.size(), [&](std::size_t c) {
    lanes_->cell_to_nodes(points_of(cells_[c]), points.data(), cell_sums_.data() + c * kCellNodes);
  });
  share_patch(points.size(), nodes_.size(), [&](std::size_t n) {
    PatchVector sum;
    for (int t = first_term_[n]; t < first_term_[n + 1]; ++t)
      for (int c = 0; c < 4; ++c) sum.value[c] += cell_sums_[index(term_[index(t)])].value[c];
    for (double& value : sum.value) value *= nodes_[n].inverse_mass;
    nodes[n] = sum;
  });
}

void PatchCells::to_points(const std::vector<PatchVector>& nodes) {
  share_patch(sums_[0].size(), cells_.size(), [&](std::size_t c) {
    const Cell& cell = cells_[c];
    lanes_->cell_to_points(points_of(cell), cell.node.data(), nodes.data(), sums_[index(cell.body)].data());
  });
}

Vec3 PatchCells::sum(std::size_t point) const {
  const double* rail = sums_[0][point].value;
  const double* wheel = sums_[1][point].value;
  return {rail[0] + wheel[0], rail[1] + wheel[1], rail[2] + wheel[2]};
}

void PatchCells::own_mobility(std::vector<double>& of_points) const {
  std::fill(of_points.begin(), of_points.end(), 0.0);
  for (const Cell& cell : cells_) {
    double mobility[kCellNodes];
    for (std::size_t k = 0; k < kCellNodes; ++k) mobility[k] = nodes_[index(cell.node[k])].inverse_mass;
    const CellPoints points = points_of(cell);
    for (int p = 0; p < points.count; ++p) {
      double& own = of_points[index(points.number[p])];
      for (int k = 0; k < kCellNodes; ++k) {
        const double weight = points.weights[p].along[k / 4] * points.weights[p].across[k % 4];
        own += weight * weight * mobility[k];
      }
    }
  }
}

std::int64_t PatchCells::bytes() const {
  const std::size_t numbers = node_of_.size() + last_cell_.capacity() + cell_number_.capacity() +
                              point_.capacity() + term_.capacity() + first_term_.capacity();
  const std::size_t vectors = cell_sums_.capacity() + sums_[0].capacity() + sums_[1].capacity();
  return static_cast<std::int64_t>(numbers * sizeof(int) + vectors * sizeof(PatchVector) +
                                   nodes_.capacity() * sizeof(Node) + cells_.capacity() * sizeof(Cell) +
                                   weights_.capacity() * sizeof(PatchWeights));
}

}  // namespace tread
