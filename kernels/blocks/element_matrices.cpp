#include "kernels/blocks/element_matrices.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

template <class Real>
ElementStiffness element_stiffness(const BlockElements<Real>& elements, const ElementPlace& at) {
  const auto& of_class = elements.elements(at);
  const SweptConstants<Real>& constants = of_class.constants[index(at.place)];
  ElementStiffness k;
  elements.with_element(at, [&](const auto& element) {
    for (int column = 0; column < 24; ++column) {
      Real s[4][3];
      Real d[4][3];
      elements.spread(
          at, [&](int node, int i) { return Real(3 * node + i == column); }, s, d);
      const Strain<Real> strain = element_strain(element, s, d);
      Strain<Real> force;
      strain_forces<false>(constants, element, strain, force);
      element_forces(element, force, s, d);
      for (int j = 0; j < 4; ++j) {
        if (elements.block().sweep == Sweep::revolved)
          turn_to_nodes(static_cast<Real>(of_class.cosine), static_cast<Real>(of_class.sine), s[j], d[j]);
        for (int i = 0; i < 3; ++i) {
          k[index(3 * j + i)][index(column)] = s[j][i] - d[j][i];
          k[index(3 * (j + 4) + i)][index(column)] = s[j][i] + d[j][i];
        }
      }
    }
  });
  return k;
}

template <class Real>
double element_frequency(const BlockElements<Real>& elements, const ElementPlace& at) {
  const double density = elements.block().material(at.quad, at.pitch_class).density;
  return largest_frequency(element_stiffness(elements, at), elements.geometry(at).nodal_volume, density);
}

template <class Real>
ElementFrequency max_frequency(const BlockElements<Real>& elements) {
  const SweptBlock& swept = elements.block();
  const std::size_t quads = swept.section.quads.size();
  std::vector<ElementPlace> candidates;  // one of each shape
  // Quad and pitch class; of elements at moved nodes, what shifts their eight nodes have in which lane.
  std::set<std::array<int, 11>> shapes;
  elements.for_each_element([&](const ElementPlace& at) {
    std::array<int, 11> shape = {static_cast<int>(index(at.pitch_class) * quads + index(at.quad))};
    if (at.perturbed) {
      const int stations[2] = {at.station, far_station(swept, at.station)};
      for (int node = 0; node < 8; ++node)
        shape[index(1 + node)] =
            elements.shift_entry(swept.section.quads[index(at.quad)][index(node % 4)], stations[node / 4]);
      for (int end = 0; end < 2; ++end)
        shape[index(9 + end)] = 1 + static_cast<int>(swept.slot(0, stations[end]) % kLanes);
    }
    if (shapes.insert(shape).second) candidates.push_back(at);
  });
  std::vector<double> omega(candidates.size());
  parallel_ranges(static_cast<std::int64_t>(omega.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      omega[i] = element_frequency(elements, candidates[i]);
  });
  const auto highest = std::max_element(omega.begin(), omega.end());
  if (highest == omega.end()) return {};
  const ElementPlace& at = candidates[static_cast<std::size_t>(highest - omega.begin())];
  return {*highest, at.quad, at.station};
}

namespace {

/// compute(element) by quad and pitch class, of elements that touch no moved nodes.
template <class Real, class Compute>
auto values_of_classes(const BlockElements<Real>& elements, const Compute& compute) {
  const std::int64_t quads = std::ssize(elements.plan().quads);
  std::vector<decltype(compute(ElementPlace{}))> values(index(quads * std::ssize(elements.classes())));
  parallel_ranges(std::ssize(values), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto place = static_cast<int>(i % quads);
      values[index(i)] =
          compute({elements.plan().quads[index(place)].quad, 0, place, static_cast<int>(i / quads), false});
    }
  });
  return values;
}

/// add(slot, element, compute(element), node of the element), at each slot in the order of tiles, the plan's
/// quads and stations. A tile has its slots to itself, and computes the elements that end in it anew.
template <class Real, class Compute, class Add>
void add_at_nodes(const BlockElements<Real>& elements, const Compute& compute, const Add& add) {
  const SweptBlock& swept = elements.block();
  const std::size_t quads = swept.section.quads.size();
  const auto of_class = values_of_classes(elements, compute);
  const auto add_end = [&](const ElementPlace& at, const auto& values, int first_node, int station) {
    for (int node = first_node; node < first_node + 4; ++node)
      add(swept.base + swept.slot(swept.section.quads[index(at.quad)][index(node % 4)], station), at, values,
          node);
  };
  const auto with_values = [&](const ElementPlace& at, const auto& use) {
    if (at.perturbed)
      use(compute(at));
    else
      use(of_class[index(at.pitch_class) * quads + index(at.place)]);
  };
  const auto add_before = [&](int tile) {
    const Tile& before = swept.tiles[index(elements.previous(tile))];
    for (const FrontPlan::Quad& entry : elements.plan().quads) {
      const ElementPlace at = elements.locate(entry.quad, before.first_station + before.elements - 1);
      with_values(at, [&](const auto& values) { add_end(at, values, 4, far_station(swept, at.station)); });
    }
  };
  const auto add_own = [&](int tile) {
    const Tile& own = swept.tiles[index(tile)];
    for (const FrontPlan::Quad& entry : elements.plan().quads)
      for (int lane = 0; lane < own.elements; ++lane) {
        const ElementPlace at = elements.locate(entry.quad, own.first_station + lane);
        with_values(at, [&](const auto& values) {
          add_end(at, values, 0, at.station);
          if (lane + 1 < own.elements) add_end(at, values, 4, at.station + 1);
        });
      }
  };
  parallel_ranges(std::ssize(swept.tiles), [&](std::int64_t first, std::int64_t last) {
    for (auto tile = static_cast<int>(first); tile < static_cast<int>(last); ++tile) {
      const bool follows = elements.previous(tile) >= 0;
      if (follows && tile > 0) add_before(tile);
      add_own(tile);
      if (follows && tile == 0) add_before(tile);
    }
  });
}

}  // namespace

template <class Real>
void add_lumped_mass(const BlockElements<Real>& elements, double* mass) {
  const auto volume_of = [&](const ElementPlace& at) { return elements.geometry(at).nodal_volume; };
  add_at_nodes(
      elements, volume_of, [&](std::int64_t slot, const ElementPlace& at, const auto& volume, int node) {
        mass[slot] += elements.block().material(at.quad, at.pitch_class).density * volume[index(node)];
      });
}

template <class Real>
void add_diagonal(const BlockElements<Real>& elements, double* d) {
  const auto diagonal_of = [&](const ElementPlace& at) {
    const ElementStiffness k = element_stiffness(elements, at);
    std::array<double, 24> values{};
    for (std::size_t i = 0; i < 24; ++i) values[i] = k[i][i];
    return values;
  };
  add_at_nodes(elements, diagonal_of,
               [&](std::int64_t slot, const ElementPlace& /*at*/, const auto& values, int node) {
                 for (int i = 0; i < 3; ++i) d[dof(slot, i)] += values[index(3 * node + i)];
               });
}

template ElementStiffness element_stiffness(const BlockElements<double>&, const ElementPlace&);
template double element_frequency(const BlockElements<double>&, const ElementPlace&);
template ElementFrequency max_frequency(const BlockElements<double>&);
template void add_lumped_mass(const BlockElements<double>&, double*);
template void add_diagonal(const BlockElements<double>&, double*);
template ElementStiffness element_stiffness(const BlockElements<float>&, const ElementPlace&);
template double element_frequency(const BlockElements<float>&, const ElementPlace&);
template ElementFrequency max_frequency(const BlockElements<float>&);
template void add_lumped_mass(const BlockElements<float>&, double*);
template void add_diagonal(const BlockElements<float>&, double*);

}  // namespace tread
