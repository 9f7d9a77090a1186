#pragma once
// Elastic solid of revolution in cylindrical harmonics, by finite elements of its section in the frequency
// domain: a reference without time step, without sweep and with other elements. [theory.md, Receptance of the
// wheelset]

#include <array>
#include <complex>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/material.hpp"
#include "core/mesh/section.hpp"

namespace tread {

/// A section in the half plane (p along the axis, q from the axis) and its material.
struct SolidPart {
  Section section;
  Material material;
};

/// Nodes on the secondary path follow the edges of the primary path; both run along +p.
struct SolidTie {
  std::size_t secondary = 0;
  std::string secondary_path;
  std::size_t primary = 0;
  std::string primary_path;
};

/// Receptance of one harmonic under its load, from the Lanczos vectors of that load.
class HarmonicReceptance {
 public:
  HarmonicReceptance() = default;
  /// `decay`: 1 / (k^2 + shift) of each Ritz vector [s2]; `weight`: its share of the receptance at the shift.
  HarmonicReceptance(std::vector<double> decay, std::vector<double> weight, double shift)
      : decay_(std::move(decay)), weight_(std::move(weight)), shift_(shift) {}

  /// Motion over force at e^(s t) [m/N]; s in 1/s.
  std::complex<double> at(std::complex<double> s) const;

 private:
  std::vector<double> decay_, weight_;
  double shift_ = 0;  ///< [1/s2]
};

/// Quads become elements with nine nodes. Displacements are around (component 0), along the axis (1) and
/// radial (2), as in SweptBlock; with n waves component 0 goes with sin(n angle), the others with cos(n
/// angle).
class HarmonicSolid {
 public:
  HarmonicSolid(std::vector<SolidPart> parts, const std::vector<SolidTie>& ties);

  /// Holds a component of all nodes of a path.
  void hold(std::size_t part, const std::string& path, int component);

  /// Nodal loads of a unit force in direction `component`, spread over the part's mass with this density of
  /// (p, q).
  std::vector<double> body_load(std::size_t part, int component,
                                const std::function<double(double, double)>& density) const;

  /// Receptances of the harmonic with so many waves for each of the loads, from `vectors` Lanczos vectors.
  std::vector<HarmonicReceptance> receptances(int waves, const std::vector<std::vector<double>>& loads,
                                              int vectors) const;

  int unknowns() const { return unknowns_; }

 private:
  struct Share {
    int node = 0;
    double weight = 0;
  };
  struct Element {
    std::array<int, 9> node{};
    std::size_t part = 0;
  };
  struct Matrices;
  struct GaussPoint;

  GaussPoint gauss_point(const Element& element, std::size_t a, std::size_t b) const;
  int edge_middle(std::size_t part, int a, int b) const;
  void tie(const SolidTie& tie);
  void number_unknowns();
  Matrices element_matrices(const Element& element, int waves) const;

  std::vector<SolidPart> parts_;
  std::vector<int> first_node_;                             ///< of each part
  std::vector<std::map<std::pair<int, int>, int>> middle_;  ///< of each part, by the corners of an edge
  std::vector<double> p_, q_;                               ///< of all nodes [m]
  std::vector<Element> elements_;
  std::vector<std::vector<Share>> follows_;  ///< nodes that a node follows; itself, unless tied
  std::vector<int> held_;                    ///< by node: bits of the held components
  std::vector<int> unknown_;                 ///< by node and component; -1: held or tied
  int unknowns_ = 0;
};

}  // namespace tread
