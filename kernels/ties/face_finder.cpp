#include "kernels/ties/face_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/section.hpp"

namespace tread {

double longest_edge(const FaceCorners& face) {
  double longest = 0;
  for (std::size_t k = 0; k < 4; ++k) longest = std::max(longest, norm(face[(k + 1) % 4] - face[k]));
  return longest;
}

double face_area(const FaceCorners& face) {
  return 0.5 * norm(cross(face[2] - face[0], face[3] - face[1]));
}

namespace {

/// The values 0 and 1 where a coordinate is next to them: digits of a file must not give a corner a share.
double snapped(double value) {
  constexpr double kDigits = 1e-6;
  if (value < kDigits) return 0;
  return value > 1 - kDigits ? 1 : value;
}

Vec3 point_at(const FaceCorners& face, const std::array<double, 4>& share) {
  Vec3 at;
  for (std::size_t k = 0; k < 4; ++k) at += share[k] * face[k];
  return at;
}

/// Place of the face that is nearest to the point, by Gauss's and Newton's method.
FacePlace place_on(const FaceCorners& face, const Vec3& point) {
  constexpr int kIterations = 20;
  double xi = 0.5, eta = 0.5;
  for (int i = 0; i < kIterations; ++i) {
    const Vec3 along_xi = (1 - eta) * (face[1] - face[0]) + eta * (face[2] - face[3]);
    const Vec3 along_eta = (1 - xi) * (face[3] - face[0]) + xi * (face[2] - face[1]);
    const Vec3 rest = point - point_at(face, QuadPlace{xi, eta}.weights());
    const double a = dot(along_xi, along_xi), b = dot(along_xi, along_eta), c = dot(along_eta, along_eta);
    const double f = dot(along_xi, rest), g = dot(along_eta, rest);
    const double determinant = a * c - b * b;
    if (!(determinant > 0)) break;
    const double step_xi = (c * f - b * g) / determinant;
    const double step_eta = (a * g - b * f) / determinant;
    xi = std::clamp(xi + step_xi, -1.0, 2.0);
    eta = std::clamp(eta + step_eta, -1.0, 2.0);
    if (std::abs(step_xi) + std::abs(step_eta) < 1e-14) break;
  }
  FacePlace place;
  place.share = QuadPlace{snapped(xi), snapped(eta)}.weights();
  place.at = point_at(face, place.share);
  place.distance = norm(point - place.at);
  return place;
}

}  // namespace

std::size_t FaceFinder::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const std::int64_t i : cell) hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15U;
  return hash;
}

FaceFinder::Cell FaceFinder::cell_of(const Vec3& point) const {
  Cell cell;
  for (int c = 0; c < 3; ++c)
    cell[static_cast<std::size_t>(c)] = static_cast<std::int64_t>(std::floor(point[c] / size_));
  return cell;
}

FaceFinder::FaceFinder(std::vector<FaceCorners> faces, double reach) : faces_(std::move(faces)) {
  double longest = reach;
  for (const FaceCorners& face : faces_) longest = std::max(longest, longest_edge(face));
  if (longest > 0) size_ = longest;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    Vec3 low = faces_[i][0], high = low;
    for (const Vec3& corner : faces_[i])
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], corner[c] - reach);
        high[c] = std::max(high[c], corner[c] + reach);
      }
    const Cell first = cell_of(low), last = cell_of(high);
    for (std::int64_t x = first[0]; x <= last[0]; ++x)
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
        for (std::int64_t z = first[2]; z <= last[2]; ++z) cells_[{x, y, z}].push_back(i);
  }
}

FacePlace FaceFinder::nearest(const Vec3& point) const {
  FacePlace best;
  const auto found = cells_.find(cell_of(point));
  if (found == cells_.end()) return best;
  for (const std::size_t i : found->second) {
    FacePlace place = place_on(faces_[i], point);
    if (best.face >= 0 && best.distance <= place.distance) continue;
    best = place;
    best.face = static_cast<std::ptrdiff_t>(i);
  }
  return best;
}

}  // namespace tread
