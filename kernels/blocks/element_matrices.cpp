#include "kernels/blocks/element_matrices.hpp"

#include <algorithm>
#include <array>
#include <optional>
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

/// compute(element), once for the elements of a quad and pitch class that touch no moved nodes.
template <class Real, class Compute>
auto shared_by_class(const BlockElements<Real>& elements, const Compute& compute) {
  const SweptBlock& swept = elements.block();
  const std::size_t quads = swept.section.quads.size();
  std::vector<std::optional<decltype(compute(ElementPlace{}))>> known(quads * swept.classes.size());
  return [&compute, quads, known = std::move(known)](const ElementPlace& at) mutable {
    if (at.perturbed) return compute(at);
    auto& shared = known[index(at.pitch_class) * quads + index(at.quad)];
    if (!shared) shared = compute(at);
    return *shared;
  };
}

}  // namespace

template <class Real>
void add_lumped_mass(const BlockElements<Real>& elements, double* mass) {
  const SweptBlock& swept = elements.block();
  const auto volume_of = [&](const ElementPlace& at) { return elements.geometry(at).nodal_volume; };
  auto shared_volume = shared_by_class(elements, volume_of);
  elements.for_each_element([&](const ElementPlace& at) {
    const double density = swept.material(at.quad, at.pitch_class).density;
    const std::array<double, 8> volume = shared_volume(at);
    for (int node = 0; node < 8; ++node) {
      const int station = node < 4 ? at.station : far_station(swept, at.station);
      const int section_node = swept.section.quads[index(at.quad)][index(node % 4)];
      mass[swept.base + swept.slot(section_node, station)] += density * volume[index(node)];
    }
  });
}

template <class Real>
void add_diagonal(const BlockElements<Real>& elements, double* d) {
  const SweptBlock& swept = elements.block();
  const auto diagonal_of = [&](const ElementPlace& at) {
    const ElementStiffness k = element_stiffness(elements, at);
    std::array<double, 24> values{};
    for (std::size_t i = 0; i < 24; ++i) values[i] = k[i][i];
    return values;
  };
  auto shared_diagonal = shared_by_class(elements, diagonal_of);
  elements.for_each_element([&](const ElementPlace& at) {
    const std::array<double, 24> values = shared_diagonal(at);
    for (int node = 0; node < 8; ++node) {
      const int station = node < 4 ? at.station : far_station(swept, at.station);
      const int section_node = swept.section.quads[index(at.quad)][index(node % 4)];
      const std::int64_t slot = swept.base + swept.slot(section_node, station);
      for (int i = 0; i < 3; ++i) d[dof(slot, i)] += values[index(3 * node + i)];
    }
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
