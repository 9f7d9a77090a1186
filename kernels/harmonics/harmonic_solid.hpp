#pragma once
// Elastic solid of revolution in cylindrical harmonics, or a straight bar in cosines along it, by finite
// elements of its section in the frequency domain: a reference without time step, without sweep and with
// other elements. [theory.md, Receptance of the wheelset]

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

struct HarmonicMatrices;

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

/// Natural motion of one harmonic, scaled to a modal mass of 1 kg.
struct HarmonicMode {
  double stiffness = 0;           ///< square of the angular frequency, about 0 of a rigid motion [1/s2]
  std::vector<double> amplitude;  ///< motion that each load works on [kg^-1/2]
  double flexibility = 0;         ///< part in the first load's; 0 of a rigid motion [m/N]
  double turning = 0;  ///< coupling of the cosine wave to the sine wave by the spin, u_s . du_c / d angle [-]
  bool rigid = false;  ///< moves without strain
};

struct HarmonicModes {
  std::vector<HarmonicMode> modes;  ///< ascending
  std::vector<double> flexibility;  ///< motion of each load over its force at rest, less rigid motions [m/N]
};

/// Quads become elements with nine nodes. Displacements are around (component 0), along the axis (1) and
/// radial (2), as in SweptBlock; with n waves component 0 goes with sin(n angle), the others with cos(n
/// angle). A bar of a length has components along it (0), across (1) and upwards (2); its ends do not move
/// along, and n half waves, with sin(n pi x / length) and cos, take the place of n waves around.
class HarmonicSolid {
 public:
  /// `length`: of a straight bar [m]; 0: a solid of revolution.
  HarmonicSolid(std::vector<SolidPart> parts, const std::vector<SolidTie>& ties, double length = 0);

  /// Holds a component of all nodes of a path.
  void hold(std::size_t part, const std::string& path, int component);

  /// Nodal loads of a unit force in direction `component`, spread over the part's mass with this density of
  /// (p, q).
  std::vector<double> body_load(std::size_t part, int component,
                                const std::function<double(double, double)>& density) const;

  /// Nodal loads of a unit force in direction `component` on the running surface of a part, with this density
  /// over p.
  std::vector<double> surface_load(std::size_t part, int component,
                                   const std::function<double(double)>& density) const;

  /// Nodal loads of a unit force spread evenly along p over a path; times the displacements: their mean.
  std::vector<double> path_load(std::size_t part, int component, const std::string& path) const;

  /// Mass that shares the mean motion of a path's nodes across the axis of a solid of revolution [kg].
  void carry(std::size_t part, const std::string& path, double mass);

  using Loads = std::vector<std::vector<double>>;

  /// Natural motions of harmonics from `vectors(waves)` Lanczos vectors of the first load, which are exact at
  /// low frequencies; flexibilities under all loads; amplitudes at loads and then at `others`.
  std::vector<HarmonicModes> modes(const std::vector<int>& waves, const Loads& loads, const Loads& others,
                                   const std::function<int(int)>& vectors) const;

  /// Receptances of the harmonic with so many waves for each of the loads, from `vectors` Lanczos vectors.
  std::vector<HarmonicReceptance> receptances(int waves, const Loads& loads, int vectors) const;

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
  void add_load(std::vector<double>& load, int node, int component, double force) const;
  void number_unknowns();
  Matrices element_matrices(const Element& element) const;
  HarmonicMatrices assembled() const;

  std::vector<SolidPart> parts_;
  double length_;                ///< of a bar; 0: a solid of revolution [m]
  std::vector<double> carried_;  ///< mean motion that the carried mass shares, by unknown
  double carried_mass_ = 0;      ///< [kg]
  std::vector<int> first_node_;  ///< of each part
  std::vector<std::map<std::pair<int, int>, int>> middle_;  ///< of each part, by the corners of an edge
  std::vector<double> p_, q_;                               ///< of all nodes [m]
  std::vector<Element> elements_;
  std::vector<std::vector<Share>> follows_;  ///< nodes that a node follows; itself, unless tied
  std::vector<int> held_;                    ///< by node: bits of the held components
  std::vector<int> unknown_;                 ///< by node and component; -1: held or tied
  int unknowns_ = 0;
};

}  // namespace tread
