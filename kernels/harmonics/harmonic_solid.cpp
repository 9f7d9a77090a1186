#include "kernels/harmonics/harmonic_solid.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel/each_item.hpp"
#include "kernels/harmonics/harmonic_system.hpp"

namespace tread {

namespace {

constexpr std::array<double, 3> kPoint = {-0.7745966692414834, 0, 0.7745966692414834};
constexpr std::array<double, 3> kWeight = {5.0 / 9, 8.0 / 9, 5.0 / 9};

/// Quadratic functions of nodes at -1, 0 and 1, and their slopes.
struct Quadratic {
  std::array<double, 3> value, slope;
};

Quadratic quadratic(double t) {
  return {{0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)}, {t - 0.5, -2 * t, t + 0.5}};
}

}  // namespace

std::complex<double> HarmonicReceptance::at(std::complex<double> s) const {
  const std::complex<double> apart = s * s - shift_;
  std::complex<double> sum;
  for (std::size_t k = 0; k < decay_.size(); ++k) sum += weight_[k] / (1.0 + apart * decay_[k]);
  return sum;
}

using Matrix27 = Eigen::Matrix<double, 27, 27>;
/// Per radian around the axis or per metre of a bar.
struct HarmonicSolid::Matrices {
  std::array<Matrix27, 3> stiffness = {Matrix27::Zero(), Matrix27::Zero(),
                                       Matrix27::Zero()};  ///< by powers of the number of waves
  Matrix27 mass = Matrix27::Zero();
  Matrix27 turning = Matrix27::Zero();  ///< its part without waves
};

HarmonicSolid::HarmonicSolid(std::vector<SolidPart> parts, const std::vector<SolidTie>& ties, double length)
    : parts_(std::move(parts)), length_(length), middle_(parts_.size()) {
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const Section& section = parts_[part].section;
    const int first = static_cast<int>(p_.size());
    first_node_.push_back(first);
    p_.insert(p_.end(), section.p.begin(), section.p.end());
    q_.insert(q_.end(), section.q.begin(), section.q.end());
    const auto between = [&](std::initializer_list<int> nodes) {
      double p = 0, q = 0;
      for (const int node : nodes) {
        p += p_[index(node)];
        q += q_[index(node)];
      }
      p_.push_back(p / static_cast<double>(nodes.size()));
      q_.push_back(q / static_cast<double>(nodes.size()));
      return static_cast<int>(p_.size()) - 1;
    };
    for (const auto& quad : section.quads) {
      std::array<int, 4> corner{}, middle{};
      for (std::size_t i = 0; i < 4; ++i) corner[i] = first + quad[i];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        const auto [at, added] = middle_[part].try_emplace(std::minmax(quad[i], quad[next]), -1);
        if (added) at->second = between({corner[i], corner[next]});
        middle[i] = at->second;
      }
      const int centre = between({corner[0], corner[1], corner[2], corner[3]});
      elements_.push_back(
          {{corner[0], middle[0], corner[1], middle[3], centre, middle[1], corner[3], middle[2], corner[2]},
           part});
    }
  }
  held_.resize(p_.size());
  for (int node = 0; node < static_cast<int>(p_.size()); ++node) follows_.push_back({{node, 1}});
  for (const SolidTie& each : ties) tie(each);
  number_unknowns();
}

int HarmonicSolid::edge_middle(std::size_t part, int a, int b) const {
  return middle_[part].at(std::minmax(a, b));
}

void HarmonicSolid::tie(const SolidTie& tie) {
  const std::vector<int>& line = parts_[tie.primary].section.paths.at(tie.primary_path);
  const auto follow = [&](int node) {
    constexpr double kRounding = 1e-9;  // [m]
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const int a = first_node_[tie.primary] + line[i];
      const int b = first_node_[tie.primary] + line[i + 1];
      const double from = p_[index(a)] - kRounding;
      if (p_[index(node)] < from || p_[index(node)] > p_[index(b)] + kRounding) continue;
      const double t = 2 * (p_[index(node)] - p_[index(a)]) / (p_[index(b)] - p_[index(a)]) - 1;
      const auto n = quadratic(t).value;
      follows_[index(node)] = {{a, n[0]}, {edge_middle(tie.primary, line[i], line[i + 1]), n[1]}, {b, n[2]}};
      return;
    }
    throw NumericalError("a tied node of the section of a wheelset or rail lies beyond the other body");
  };
  const std::vector<int>& path = parts_[tie.secondary].section.paths.at(tie.secondary_path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    follow(first_node_[tie.secondary] + path[i]);
    if (i + 1 < path.size()) follow(edge_middle(tie.secondary, path[i], path[i + 1]));
  }
}

void HarmonicSolid::hold(std::size_t part, const std::string& path, int component) {
  const std::vector<int>& line = parts_[part].section.paths.at(path);
  for (std::size_t i = 0; i < line.size(); ++i) {
    held_[index(first_node_[part] + line[i])] |= 1 << component;
    if (i + 1 < line.size()) held_[index(edge_middle(part, line[i], line[i + 1]))] |= 1 << component;
  }
  number_unknowns();
}

void HarmonicSolid::number_unknowns() {
  unknown_.assign(3 * p_.size(), -1);
  int count = 0;
  for (std::size_t node = 0; node < p_.size(); ++node) {
    if (follows_[node].front().node != static_cast<int>(node)) continue;
    for (int c = 0; c < 3; ++c)
      if ((held_[node] >> c & 1) == 0) unknown_[3 * node + index(c)] = count++;
  }
  unknowns_ = count;
}

/// Shape functions of an element's nodes at an integration point and their gradient.
struct HarmonicSolid::GaussPoint {
  std::array<double, 9> value{};
  std::array<double, 9> along{}, radial{};  ///< derivatives [1/m]
  double p = 0, q = 0;                      ///< place [m]
  double volume = 0;  ///< of the point, a radian around the axis or a metre along a bar [m3]
};

HarmonicSolid::GaussPoint HarmonicSolid::gauss_point(const Element& element, std::size_t a,
                                                     std::size_t b) const {
  const Quadratic x = quadratic(kPoint[a]);
  const Quadratic y = quadratic(kPoint[b]);
  GaussPoint at;
  std::array<double, 9> nx{}, ny{};
  double px = 0, py = 0, qx = 0, qy = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    at.value[i] = x.value[i % 3] * y.value[i / 3];
    nx[i] = x.slope[i % 3] * y.value[i / 3];
    ny[i] = x.value[i % 3] * y.slope[i / 3];
    const double p = p_[index(element.node[i])];
    const double q = q_[index(element.node[i])];
    px += nx[i] * p;
    py += ny[i] * p;
    qx += nx[i] * q;
    qy += ny[i] * q;
    at.p += at.value[i] * p;
    at.q += at.value[i] * q;
  }
  const double jacobian = px * qy - py * qx;
  for (std::size_t i = 0; i < 9; ++i) {
    at.along[i] = (nx[i] * qy - ny[i] * qx) / jacobian;
    at.radial[i] = (ny[i] * px - nx[i] * py) / jacobian;
  }
  at.volume = (length_ > 0 ? 1 : at.q) * jacobian * kWeight[a] * kWeight[b];
  return at;
}

/// Strains (rr, yy, around, yr, y-around, r-around) of the amplitudes, integrated over the section.
HarmonicSolid::Matrices HarmonicSolid::element_matrices(const Element& element) const {
  const Material& material = parts_[element.part].material;
  const double lambda = material.lame_lambda();
  const double mu = material.shear_modulus();
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law.topLeftCorner<3, 3>().setConstant(lambda);
  law.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
  const bool bar = length_ > 0;
  Matrices out;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const GaussPoint at = gauss_point(element, a, b);
      const double curvature = bar ? 0 : 1 / at.q;
      const double wave = bar ? std::numbers::pi / length_ : 1 / at.q;  // wave number of one wave
      Eigen::Matrix<double, 6, 27> still = Eigen::Matrix<double, 6, 27>::Zero();
      Eigen::Matrix<double, 6, 27> waved = still;  // of one wave
      Eigen::Matrix<double, 3, 27> motion = Eigen::Matrix<double, 3, 27>::Zero();
      for (std::size_t i = 0; i < 9; ++i) {
        const double np = at.along[i];
        const double nq = at.radial[i];
        const double over = at.value[i] * curvature;
        const double one = at.value[i] * wave;
        const auto around = static_cast<Eigen::Index>(3 * i);
        const Eigen::Index along = around + 1;
        const Eigen::Index radial = around + 2;
        still(0, radial) = nq;
        still(1, along) = np;
        still(2, radial) = over;
        waved(2, around) = one;
        still(3, radial) = np;
        still(3, along) = nq;
        still(4, around) = np;
        waved(4, along) = -one;
        still(5, around) = nq - over;
        waved(5, radial) = -one;
        motion(0, around) = motion(1, along) = motion(2, radial) = at.value[i];
      }
      out.stiffness[0] += at.volume * still.transpose() * law * still;
      const Matrix27 mixed = at.volume * still.transpose() * law * waved;
      out.stiffness[1] += mixed + mixed.transpose();
      out.stiffness[2] += at.volume * waved.transpose() * law * waved;
      const double mass = at.volume * material.density;
      out.mass += mass * motion.transpose() * motion;
      if (bar) continue;
      // A turn also turns the directions around and radial into one another.
      const Matrix27 across = mass * motion.row(0).transpose() * motion.row(2);
      out.turning += across + across.transpose();
    }
  return out;
}

std::vector<double> HarmonicSolid::body_load(std::size_t part, int component,
                                             const std::function<double(double, double)>& density) const {
  std::vector<double> load(index(unknowns_), 0.0);
  double sum = 0;
  for (const Element& element : elements_) {
    if (element.part != part) continue;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        const GaussPoint at = gauss_point(element, a, b);
        const double force = at.volume * density(at.p, at.q);
        sum += force;
        for (std::size_t i = 0; i < 9; ++i) add_load(load, element.node[i], component, force * at.value[i]);
      }
  }
  for (double& force : load) force /= sum;
  return load;
}

std::vector<double> HarmonicSolid::surface_load(std::size_t part, int component,
                                                const std::function<double(double)>& density) const {
  constexpr int kPoints = 8;  // midpoints of an edge: a density may change within an edge
  std::vector<double> load(index(unknowns_), 0.0);
  double sum = 0;
  for (const SurfaceEdge& edge : parts_[part].section.surface) {
    const std::array<int, 3> node = {first_node_[part] + edge.node[0],
                                     edge_middle(part, edge.node[0], edge.node[1]),
                                     first_node_[part] + edge.node[1]};
    const double from = p_[index(node[0])];
    const double to = p_[index(node[2])];
    for (int point = 0; point < kPoints; ++point) {
      const double t = (2 * point + 1.0) / kPoints - 1;
      const double force = density(0.5 * ((1 - t) * from + (1 + t) * to)) * (to - from);
      if (force == 0) continue;
      sum += force;
      const Quadratic shape = quadratic(t);
      for (std::size_t i = 0; i < 3; ++i) add_load(load, node[i], component, force * shape.value[i]);
    }
  }
  for (double& force : load) force /= sum;
  return load;
}

std::vector<double> HarmonicSolid::path_load(std::size_t part, int component, const std::string& path) const {
  constexpr std::array<double, 3> kSimpson = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  std::vector<double> load(index(unknowns_), 0.0);
  const std::vector<int>& line = parts_[part].section.paths.at(path);
  const auto at = [&](int node) { return p_[index(first_node_[part] + node)]; };
  const double length = at(line.back()) - at(line.front());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const std::array<int, 3> node = {first_node_[part] + line[i], edge_middle(part, line[i], line[i + 1]),
                                     first_node_[part] + line[i + 1]};
    const double share = (at(line[i + 1]) - at(line[i])) / length;
    for (std::size_t k = 0; k < 3; ++k) add_load(load, node[k], component, share * kSimpson[k]);
  }
  return load;
}

void HarmonicSolid::add_load(std::vector<double>& load, int node, int component, double force) const {
  for (const Share& share : follows_[index(node)]) {
    const int unknown = unknown_[3 * index(share.node) + index(component)];
    if (unknown >= 0) load[index(unknown)] += force * share.weight;
  }
}

void HarmonicSolid::carry(std::size_t part, const std::string& path, double mass) {
  carried_mass_ = mass;
  carried_ = path_load(part, 2, path);
  const std::vector<double> around = path_load(part, 0, path);
  // Around the axis U cos^2 and -W sin^2 have the mean of a half.
  for (std::size_t i = 0; i < carried_.size(); ++i) carried_[i] = 0.5 * (carried_[i] - around[i]);
}

HarmonicMatrices HarmonicSolid::assembled() const {
  using Entries = std::vector<Eigen::Triplet<double>>;
  std::array<Entries, 3> stiffness;
  std::array<Entries, 2> turning;
  Entries mass, carried;
  for (const Element& element : elements_) {
    const Matrices m = element_matrices(element);
    struct Term {
      Eigen::Index own;
      int unknown;
      double weight;
    };
    std::vector<Term> terms;
    for (std::size_t i = 0; i < 9; ++i)
      for (const Share& share : follows_[index(element.node[i])])
        for (std::size_t c = 0; c < 3; ++c) {
          const int unknown = unknown_[3 * index(share.node) + c];
          if (unknown >= 0) terms.push_back({static_cast<Eigen::Index>(3 * i + c), unknown, share.weight});
        }
    for (const Term& a : terms)
      for (const Term& b : terms) {
        const auto add = [&](Entries& entries, const Matrix27& matrix) {
          const double value = a.weight * b.weight * matrix(a.own, b.own);
          if (value != 0) entries.emplace_back(a.unknown, b.unknown, value);
        };
        for (std::size_t power = 0; power < 3; ++power) add(stiffness[power], m.stiffness[power]);
        add(mass, m.mass);
        add(turning[0], m.turning);
        add(turning[1], m.mass);
      }
  }
  std::vector<int> carries;
  for (int i = 0; carried_mass_ > 0 && i < unknowns_; ++i)
    if (carried_[index(i)] != 0) carries.push_back(i);
  for (const int i : carries)
    for (const int j : carries)
      carried.emplace_back(i, j, carried_mass_ * carried_[index(i)] * carried_[index(j)]);
  HarmonicMatrices out;
  const auto fill = [&](HarmonicMatrix& matrix, const Entries& entries) {
    matrix.resize(unknowns_, unknowns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
  };
  for (std::size_t power = 0; power < 3; ++power) fill(out.stiffness[power], stiffness[power]);
  for (std::size_t power = 0; power < 2; ++power) fill(out.turning[power], turning[power]);
  fill(out.mass, mass);
  fill(out.carried, carried);
  out.whole = length_ > 0 ? length_ : 2 * std::numbers::pi;
  return out;
}

std::vector<HarmonicModes> HarmonicSolid::modes(const std::vector<int>& waves, const Loads& loads,
                                                const Loads& others,
                                                const std::function<int(int)>& vectors) const {
  constexpr int kOfFlexibility = 12;  // Lanczos vectors for the response at rest alone
  const HarmonicMatrices matrices = assembled();
  Loads all = loads;
  all.insert(all.end(), others.begin(), others.end());
  std::vector<HarmonicModes> out(waves.size());
  each_item(waves.size(), [&](std::size_t i) {
    const HarmonicSystem system(matrices, waves[i]);
    for (const std::vector<double>& load : loads) {
      const bool first = &load == &loads.front();
      const HarmonicRitz found(system, load, first ? vectors(waves[i]) : kOfFlexibility);
      double flexibility = 0;
      for (Eigen::Index k = found.decay.size(); k-- > 0;) {
        HarmonicMode mode;
        mode.stiffness = 1 / found.decay[k] - kHarmonicShift;
        // Waves of a bar bend, however slowly.
        mode.rigid = !(mode.stiffness > (length_ > 0 && waves[i] > 0 ? 0 : 10));
        if (!mode.rigid) mode.flexibility = found.weight[k] / (1 - kHarmonicShift * found.decay[k]);
        flexibility += mode.flexibility;
        if (!first) continue;
        const auto shape = found.shapes.col(k);
        for (const std::vector<double>& each : all)
          mode.amplitude.push_back(Eigen::Map<const Eigen::VectorXd>(each.data(), unknowns_).dot(shape));
        mode.turning = shape.dot(system.turning * shape);
        out[i].modes.push_back(std::move(mode));
      }
      out[i].flexibility.push_back(flexibility);
    }
  });
  return out;
}

std::vector<HarmonicReceptance> HarmonicSolid::receptances(int waves, const Loads& loads, int vectors) const {
  const HarmonicSystem system(assembled(), waves);
  std::vector<HarmonicReceptance> out;
  for (const std::vector<double>& load : loads) {
    const HarmonicRitz found(system, load, vectors);
    out.push_back({{found.decay.begin(), found.decay.end()},
                   {found.weight.begin(), found.weight.end()},
                   kHarmonicShift});
  }
  return out;
}

}  // namespace tread
