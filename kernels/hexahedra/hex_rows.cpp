#include "kernels/hexahedra/hex_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/contract.hpp"
#include "core/index.hpp"

namespace tread {

namespace {

constexpr std::size_t kRowLength = 8;

/// Opposite faces in kHexFaces, and the corner at the other end of the edge between them, by axis of a row.
constexpr std::array<std::array<std::size_t, 2>, 3> kEnds = {{{0, 1}, {2, 4}, {3, 5}}};
constexpr std::array<std::array<std::size_t, 8>, 3> kPartner = {
    {{4, 5, 6, 7, 0, 1, 2, 3}, {3, 2, 1, 0, 7, 6, 5, 4}, {1, 0, 3, 2, 5, 4, 7, 6}}};

using FaceNodes = std::array<std::int32_t, 4>;

class RowFinder {
 public:
  RowFinder(const HexMesh& mesh, std::span<const std::int32_t> elements)
      : mesh_(mesh),
        elements_(elements),
        taken_(elements.size(), 0),
        line_of_(elements.size(), -1),
        faces_(6 * elements.size()) {
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (std::size_t f = 0; f < 6; ++f)
        faces_[6 * e + f] = {nodes_of(e, f), static_cast<std::int32_t>(6 * e + f)};
    std::sort(faces_.begin(), faces_.end());
    beside_.assign(faces_.size(), -1);
    for (std::size_t i = 1; i < faces_.size(); ++i)
      if (faces_[i].first == faces_[i - 1].first &&
          part(index(faces_[i].second) / 6) == part(index(faces_[i - 1].second) / 6)) {
        beside_[index(faces_[i].second)] = faces_[i - 1].second;
        beside_[index(faces_[i - 1].second)] = faces_[i].second;
      }
  }

  std::vector<ElementRow> run(std::vector<std::int32_t>& rest) {
    for (std::size_t axis = 0; axis < kEnds.size(); ++axis)
      for (std::size_t e = 0; e < elements_.size(); ++e)
        if (taken_[e] == 0) take_line(e, axis);
    for (std::size_t e = 0; e < elements_.size(); ++e)
      if (taken_[e] == 0) rest.push_back(elements_[e]);
    return std::move(rows_);
  }

 private:
  /// An element, and the face through which a line enters it.
  struct Step {
    std::size_t element, face;
  };

  std::int32_t part(std::size_t e) const { return mesh_.part[index(elements_[e])]; }
  FaceNodes nodes_of(std::size_t e, std::size_t face) const {
    FaceNodes nodes;
    for (std::size_t i = 0; i < 4; ++i) nodes[i] = mesh_.elements[index(elements_[e])][kHexFaces[face][i]];
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }
  static std::size_t axis_of(std::size_t face) {
    std::size_t axis = 0;
    while (kEnds[axis][0] != face && kEnds[axis][1] != face) ++axis;
    return axis;
  }
  static std::size_t opposite(std::size_t face) {
    const auto& ends = kEnds[axis_of(face)];
    return ends[0] == face ? ends[1] : ends[0];
  }

  /// Elements behind a face, until one is taken or the line meets or crosses itself; `line_of_` marks them.
  std::vector<Step> walk(std::size_t e, std::size_t through) {
    std::vector<Step> steps;
    for (;;) {
      const std::int32_t next = beside_[6 * e + through];
      if (next < 0 || taken_[index(next) / 6] != 0 || line_of_[index(next) / 6] == line_) return steps;
      e = index(next) / 6;
      line_of_[e] = line_;
      steps.push_back({e, index(next) % 6});
      through = opposite(index(next) % 6);
    }
  }

  /// Cuts the line through an element along an axis of it into rows.
  void take_line(std::size_t e, std::size_t axis) {
    ++line_;
    line_of_[e] = line_;
    const std::vector<Step> before = walk(e, kEnds[axis][0]);
    std::vector<Step> line;
    for (auto step = before.rbegin(); step != before.rend();
         ++step)  // from there they are entered at the other end
      line.push_back({step->element, opposite(step->face)});
    line.push_back({e, kEnds[axis][0]});
    const std::vector<Step> behind = walk(e, kEnds[axis][1]);
    line.insert(line.end(), behind.begin(), behind.end());
    for (std::size_t first = 0; first + kRowLength <= line.size(); first += kRowLength)
      add_row({line.data() + first, kRowLength});
  }

  void add_row(std::span<const Step> steps) {
    ElementRow row;
    // Seen from the opposite face the nodes run the other way round.
    const auto& entered = kHexFaces[steps[0].face];
    const HexCorners& first = mesh_.elements[index(elements_[steps[0].element])];
    for (std::size_t k = 0; k < 4; ++k) row.line[k][0] = first[entered[(4 - k) % 4]];
    for (std::size_t i = 0; i < steps.size(); ++i) {
      TREAD_EXPECT(taken_[steps[i].element] == 0);
      taken_[steps[i].element] = 1;
      row.element[i] = elements_[steps[i].element];
      const HexCorners& corners = mesh_.elements[index(row.element[i])];
      const auto& partner = kPartner[axis_of(steps[i].face)];
      for (std::size_t k = 0; k < 4; ++k) {
        const auto here = std::find(corners.begin(), corners.end(), row.line[k][i]) - corners.begin();
        row.line[k][i + 1] = corners[partner[index(here)]];
      }
    }
    rows_.push_back(row);
  }

  const HexMesh& mesh_;
  std::span<const std::int32_t> elements_;
  std::vector<char> taken_;
  std::vector<std::int64_t> line_of_;  ///< number of the last line through the element
  std::int64_t line_ = -1;
  std::vector<std::pair<FaceNodes, std::int32_t>> faces_;  ///< and 6 element + face
  std::vector<std::int32_t> beside_;                       ///< face on the other side, likewise, or -1
  std::vector<ElementRow> rows_;
};

}  // namespace

std::vector<ElementRow> find_rows(const HexMesh& mesh, std::span<const std::int32_t> elements,
                                  std::vector<std::int32_t>& rest) {
  return RowFinder(mesh, elements).run(rest);
}

}  // namespace tread
