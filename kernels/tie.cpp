#include "kernels/tie.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace tread {

namespace {

/// Where a secondary node sits on a primary face: two section nodes, two stations, fractions along both.
struct FacePoint {
  std::array<int, 2> section_node;
  std::array<int, 2> station;
  double across;  ///< fraction from section_node[0] to [1]
  double along;   ///< fraction from station[0] to [1]
};

/// Primary section edge under each secondary section node.
struct SectionPoint {
  std::array<int, 2> node;
  double fraction;
};

std::vector<SectionPoint> locate_in_section(const SweptBlock& fine, const std::vector<int>& fine_path,
                                            const SweptBlock& coarse, const std::vector<int>& coarse_path) {
  std::vector<SectionPoint> points;
  for (const int node : fine_path) {
    const double p = fine.section.p[static_cast<std::size_t>(node)];
    const double q = fine.section.q[static_cast<std::size_t>(node)];
    SectionPoint best{{-1, -1}, 0};
    double distance = 1e30;
    for (std::size_t i = 0; i + 1 < coarse_path.size(); ++i) {
      const auto a = static_cast<std::size_t>(coarse_path[i]);
      const auto b = static_cast<std::size_t>(coarse_path[i + 1]);
      const double dp = coarse.section.p[b] - coarse.section.p[a];
      const double dq = coarse.section.q[b] - coarse.section.q[a];
      const double length2 = dp * dp + dq * dq;
      const double fraction =
          std::clamp(((p - coarse.section.p[a]) * dp + (q - coarse.section.q[a]) * dq) / length2, 0.0, 1.0);
      const double off =
          std::hypot(coarse.section.p[a] + fraction * dp - p, coarse.section.q[a] + fraction * dq - q);
      if (off < distance) {
        distance = off;
        best = {{coarse_path[i], coarse_path[i + 1]}, fraction};
      }
    }
    if (distance > 1e-9)
      throw InputError(
          fmt::format("tie of '{}' to '{}': section node {} at ({:.6f}, {:.6f}) m lies {:.3e} m off the "
                      "coarse line; make both lines coincide",
                      fine.name, coarse.name, node, p, q, distance));
    if (best.fraction < 1e-9) best.fraction = 0;
    if (best.fraction > 1 - 1e-9) best.fraction = 1;
    points.push_back(best);
  }
  return points;
}

struct StationPoint {
  std::array<int, 2> station;
  double fraction;
};

StationPoint locate_along(const SweptBlock& fine, int station, const SweptBlock& coarse) {
  constexpr double turn = 2 * std::numbers::pi;
  constexpr double tolerance = 1e-9;
  double at = fine.stations[static_cast<std::size_t>(station)];
  const double first = coarse.stations.front();
  if (coarse.closed) at = first + std::fmod(std::fmod(at - first, turn) + turn, turn);
  if (coarse.closed && first + turn - at < tolerance) at = first;
  const auto above = std::upper_bound(coarse.stations.begin(), coarse.stations.end(), at + tolerance);
  int j = static_cast<int>(above - coarse.stations.begin()) - 1;
  const int count = coarse.station_count();
  if (!coarse.closed && j == count - 1 && at < coarse.stations.back() + tolerance) j = count - 2;
  if (j < 0 || (!coarse.closed && j >= count - 1))
    throw InputError(fmt::format("tie of '{}' to '{}': station {} at {:.6f} lies beyond the coarse block",
                                 fine.name, coarse.name, station, at));
  const int next = j + 1 < count ? j + 1 : 0;
  const double span = next > 0 ? coarse.stations[static_cast<std::size_t>(next)] : first + turn;
  const double here = coarse.stations[static_cast<std::size_t>(j)];
  double fraction = (at - here) / (span - here);
  if (fraction < tolerance) fraction = 0;
  if (fraction > 1 - tolerance) fraction = 1;
  return {{j, next}, fraction};
}

const std::vector<int>& path_of(const SweptBlock& block, const std::string& name) {
  const auto found = block.section.paths.find(name);
  if (found == block.section.paths.end())
    throw InputError(fmt::format("block '{}' has no section path '{}' to tie", block.name, name));
  return found->second;
}

template <class Visit>
void for_each_secondary(const Mesh& mesh, const TieSpec& spec, Visit visit) {
  const SweptBlock& fine = mesh.blocks[static_cast<std::size_t>(spec.secondary)];
  const SweptBlock& coarse = mesh.blocks[static_cast<std::size_t>(spec.primary)];
  const auto& fine_path = path_of(fine, spec.secondary_path);
  const auto across = locate_in_section(fine, fine_path, coarse, path_of(coarse, spec.primary_path));
  for (int station = 0; station < fine.station_count(); ++station) {
    const StationPoint along = locate_along(fine, station, coarse);
    for (std::size_t i = 0; i < fine_path.size(); ++i)
      visit(fine_path[i], station,
            FacePoint{across[i].node, along.station, across[i].fraction, along.fraction});
  }
}

double face_weight(const FacePoint& face, int corner) {
  const double across = corner % 2 == 0 ? 1 - face.across : face.across;
  const double along = corner / 2 == 0 ? 1 - face.along : face.along;
  return across * along;
}

}  // namespace

void place_on_chords(Mesh& mesh, const TieSpec& spec) {
  SweptBlock& fine = mesh.blocks[static_cast<std::size_t>(spec.secondary)];
  const SweptBlock& coarse = mesh.blocks[static_cast<std::size_t>(spec.primary)];
  if (fine.sweep == Sweep::extruded) return;  // straight: the nodes lie there already
  for_each_secondary(mesh, spec, [&](int node, int station, const FacePoint& face) {
    Vec3 target;
    for (int corner = 0; corner < 4; ++corner)
      target += face_weight(face, corner) * position(coarse,
                                                     face.section_node[static_cast<std::size_t>(corner % 2)],
                                                     face.station[static_cast<std::size_t>(corner / 2)]);
    const Vec3 shift = to_local(fine, station, 0, target - position(fine, node, station));
    if (norm(shift) > 1e-12) fine.node_shift[fine.slot(node, station)] += shift;
  });
}

Ties::Ties(const Mesh& mesh, const std::vector<TieSpec>& specs) {
  std::map<std::int64_t, std::vector<Link>> by_primary;
  for (const TieSpec& spec : specs) {
    const SweptBlock& fine = mesh.blocks[static_cast<std::size_t>(spec.secondary)];
    const SweptBlock& coarse = mesh.blocks[static_cast<std::size_t>(spec.primary)];
    for_each_secondary(mesh, spec, [&](int node, int station, const FacePoint& face) {
      const std::int64_t slot = fine.base + fine.slot(node, station);
      std::array<Link, 4> links{};
      for (int corner = 0; corner < 4; ++corner) {
        const int primary_station = face.station[static_cast<std::size_t>(corner / 2)];
        const double turn = fine.sweep == Sweep::extruded
                                ? 0.0
                                : fine.stations[static_cast<std::size_t>(station)] -
                                      coarse.stations[static_cast<std::size_t>(primary_station)];
        const std::int64_t primary =
            coarse.base +
            coarse.slot(face.section_node[static_cast<std::size_t>(corner % 2)], primary_station);
        const double weight = face_weight(face, corner);
        links[static_cast<std::size_t>(corner)] = {primary, weight, std::cos(turn), std::sin(turn)};
        if (weight > 0) by_primary[primary].push_back({slot, weight, std::cos(turn), std::sin(turn)});
      }
      secondary_.push_back(slot);
      primaries_of_.push_back(links);
    });
  }
  for (const auto& [slot, links] : by_primary) {
    primary_.push_back(slot);
    first_secondary_.push_back(static_cast<std::int64_t>(secondaries_of_.size()));
    secondaries_of_.insert(secondaries_of_.end(), links.begin(), links.end());
  }
  first_secondary_.push_back(static_cast<std::int64_t>(secondaries_of_.size()));
  for (const std::int64_t slot : secondary_)
    if (by_primary.count(slot) > 0)
      throw InputError("a node is both secondary and primary of a tie; tie its block on another line");
}

std::vector<TiedSlot> Ties::tied_slots() const {
  std::vector<TiedSlot> slots;
  for (std::size_t i = 0; i < secondary_.size(); ++i) {
    TiedSlot tied{secondary_[i], {}};
    for (const Link& link : primaries_of_[i])
      if (link.weight > 0) tied.primaries.push_back(link.other);
    slots.push_back(std::move(tied));
  }
  return slots;
}

std::int64_t Ties::bytes() const {
  return static_cast<std::int64_t>(
      (secondary_.size() + primary_.size() + first_secondary_.size()) * sizeof(std::int64_t) +
      primaries_of_.size() * sizeof(primaries_of_[0]) + secondaries_of_.size() * sizeof(secondaries_of_[0]));
}

namespace {

/// How many nodes ahead their data are fetched: neighbours in a tie lie far apart in memory.
constexpr std::int64_t kAhead = 4;

void prefetch(const double* field, std::int64_t slot) {
  for (int c = 0; c < 3; ++c) __builtin_prefetch(field + dof(slot, c));
}

}  // namespace

void Ties::follow(std::initializer_list<double*> fields) const {
  parallel_ranges(secondary_count(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto ahead = static_cast<std::size_t>(std::min(i + kAhead, last - 1));
      for (const double* field : fields) {
        for (const Link& link : primaries_of_[ahead]) prefetch(field, link.other);
        prefetch(field, secondary_[ahead]);
      }
      const std::int64_t slot = secondary_[static_cast<std::size_t>(i)];
      for (double* field : fields) {
        double t = 0;
        double y = 0;
        double r = 0;
        for (const Link& link : primaries_of_[static_cast<std::size_t>(i)]) {
          const double a = field[dof(link.other, 0)];
          const double b = field[dof(link.other, 2)];
          t += link.weight * (link.cosine * a - link.sine * b);
          y += link.weight * field[dof(link.other, 1)];
          r += link.weight * (link.sine * a + link.cosine * b);
        }
        field[dof(slot, 0)] = t;
        field[dof(slot, 1)] = y;
        field[dof(slot, 2)] = r;
      }
    }
  });
}

void Ties::gather(double* force) const {
  parallel_ranges(static_cast<std::int64_t>(primary_.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto ahead = static_cast<std::size_t>(std::min(i + kAhead, last - 1));
      for (std::int64_t k = first_secondary_[ahead]; k < first_secondary_[ahead + 1]; ++k)
        prefetch(force, secondaries_of_[static_cast<std::size_t>(k)].other);
      double t = 0;
      double y = 0;
      double r = 0;
      for (std::int64_t k = first_secondary_[static_cast<std::size_t>(i)];
           k < first_secondary_[static_cast<std::size_t>(i) + 1]; ++k) {
        const Link& link = secondaries_of_[static_cast<std::size_t>(k)];
        const double a = force[dof(link.other, 0)];
        const double b = force[dof(link.other, 2)];
        t += link.weight * (link.cosine * a + link.sine * b);
        y += link.weight * force[dof(link.other, 1)];
        r += link.weight * (-link.sine * a + link.cosine * b);
      }
      const std::int64_t slot = primary_[static_cast<std::size_t>(i)];
      force[dof(slot, 0)] += t;
      force[dof(slot, 1)] += y;
      force[dof(slot, 2)] += r;
    }
  });
  parallel_ranges(secondary_count(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      for (int c = 0; c < 3; ++c) force[dof(secondary_[static_cast<std::size_t>(i)], c)] = 0;
  });
}

void Ties::gather_diagonal(double* diagonal) const {
  for (std::size_t i = 0; i < primary_.size(); ++i)
    for (std::int64_t k = first_secondary_[i]; k < first_secondary_[i + 1]; ++k) {
      const Link& link = secondaries_of_[static_cast<std::size_t>(k)];
      for (int c = 0; c < 3; ++c)
        diagonal[dof(primary_[i], c)] += link.weight * link.weight * diagonal[dof(link.other, c)];
    }
  for (const std::int64_t slot : secondary_)
    for (int c = 0; c < 3; ++c) diagonal[dof(slot, c)] = 0;
}

void Ties::gather_mass(double* mass) const {
  for (std::size_t i = 0; i < primary_.size(); ++i)
    for (std::int64_t k = first_secondary_[i]; k < first_secondary_[i + 1]; ++k) {
      const Link& link = secondaries_of_[static_cast<std::size_t>(k)];
      mass[primary_[i]] += link.weight * mass[link.other];
    }
  for (const std::int64_t slot : secondary_) mass[slot] = 0;
}

}  // namespace tread
