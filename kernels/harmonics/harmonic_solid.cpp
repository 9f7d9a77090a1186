#include "kernels/harmonics/harmonic_solid.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace tread {

namespace {

/// Below all elastic modes: the shifted system is regular whatever the solid is free to do [1/s2].
constexpr double kShift = 4e6;

constexpr std::array<double, 3> kPoint = {-0.7745966692414834, 0, 0.7745966692414834};
constexpr std::array<double, 3> kWeight = {5.0 / 9, 8.0 / 9, 5.0 / 9};

/// Quadratic functions of nodes at -1, 0 and 1, and their slopes.
struct Quadratic {
  std::array<double, 3> value, slope;
};

Quadratic quadratic(double t) {
  return {{0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)}, {t - 0.5, -2 * t, t + 0.5}};
}

std::size_t index(int node) {
  return static_cast<std::size_t>(node);
}

}  // namespace

std::complex<double> HarmonicReceptance::at(std::complex<double> s) const {
  const std::complex<double> apart = s * s - shift_;
  std::complex<double> sum;
  for (std::size_t k = 0; k < decay_.size(); ++k) sum += weight_[k] / (1.0 + apart * decay_[k]);
  return sum;
}

struct HarmonicSolid::Matrices {
  Eigen::Matrix<double, 27, 27> stiffness = Eigen::Matrix<double, 27, 27>::Zero();
  Eigen::Matrix<double, 27, 27> mass = Eigen::Matrix<double, 27, 27>::Zero();
};

HarmonicSolid::HarmonicSolid(std::vector<SolidPart> parts, const std::vector<SolidTie>& ties)
    : parts_(std::move(parts)), middle_(parts_.size()) {
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
    throw NumericalError("verify: a tied node of the wheelset's section lies beyond the other body");
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
  double volume = 0;                        ///< of the point, a radian around the axis [m3]
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
  at.volume = at.q * jacobian * kWeight[a] * kWeight[b];
  return at;
}

/// Strains (rr, yy, around, yr, y-around, r-around) of the amplitudes, integrated around the axis.
HarmonicSolid::Matrices HarmonicSolid::element_matrices(const Element& element, int waves) const {
  const Material& material = parts_[element.part].material;
  const double turn = waves == 0 ? 2 * std::numbers::pi : std::numbers::pi;
  const double lambda = material.lame_lambda();
  const double mu = material.shear_modulus();
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law.topLeftCorner<3, 3>().setConstant(lambda);
  law.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
  Matrices out;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const GaussPoint at = gauss_point(element, a, b);
      Eigen::Matrix<double, 6, 27> strain = Eigen::Matrix<double, 6, 27>::Zero();
      Eigen::Matrix<double, 3, 27> motion = Eigen::Matrix<double, 3, 27>::Zero();
      for (std::size_t i = 0; i < 9; ++i) {
        const double np = at.along[i];
        const double nq = at.radial[i];
        const double over = at.value[i] / at.q;
        const auto around = static_cast<Eigen::Index>(3 * i);
        const Eigen::Index along = around + 1;
        const Eigen::Index radial = around + 2;
        strain(0, radial) = nq;
        strain(1, along) = np;
        strain(2, radial) = over;
        strain(2, around) = waves * over;
        strain(3, radial) = np;
        strain(3, along) = nq;
        strain(4, around) = np;
        strain(4, along) = -waves * over;
        strain(5, around) = nq - over;
        strain(5, radial) = -waves * over;
        motion(0, around) = motion(1, along) = motion(2, radial) = at.value[i];
      }
      const double volume = turn * at.volume;
      out.stiffness += volume * strain.transpose() * law * strain;
      out.mass += volume * material.density * motion.transpose() * motion;
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
        for (std::size_t i = 0; i < 9; ++i)
          for (const Share& share : follows_[index(element.node[i])]) {
            const int unknown = unknown_[3 * index(share.node) + index(component)];
            if (unknown >= 0) load[index(unknown)] += force * at.value[i] * share.weight;
          }
      }
  }
  for (double& force : load) force /= sum;
  return load;
}

std::vector<HarmonicReceptance> HarmonicSolid::receptances(int waves,
                                                           const std::vector<std::vector<double>>& loads,
                                                           int vectors) const {
  std::vector<Eigen::Triplet<double>> system, mass;
  for (const Element& element : elements_) {
    const Matrices m = element_matrices(element, waves);
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
        const double weight = a.weight * b.weight;
        system.emplace_back(a.unknown, b.unknown,
                            weight * (m.stiffness(a.own, b.own) + kShift * m.mass(a.own, b.own)));
        mass.emplace_back(a.unknown, b.unknown, weight * m.mass(a.own, b.own));
      }
  }
  Eigen::SparseMatrix<double> a(unknowns_, unknowns_), m(unknowns_, unknowns_);
  a.setFromTriplets(system.begin(), system.end());
  m.setFromTriplets(mass.begin(), mass.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a);
  if (factor.info() != Eigen::Success)
    throw NumericalError("verify: the harmonic system of the wheelset cannot be factorised");

  std::vector<HarmonicReceptance> out;
  for (const std::vector<double>& nodal : loads) {
    const Eigen::Map<const Eigen::VectorXd> load(nodal.data(), unknowns_);
    // Lanczos on A^-1 M in the inner product of M, orthogonalised against all vectors.
    Eigen::MatrixXd basis(unknowns_, vectors);
    Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(vectors, vectors);
    Eigen::VectorXd next = factor.solve(load);
    const double first = std::sqrt(next.dot(m * next));
    double length = first;
    int count = 0;
    for (; count < vectors; ++count) {
      if (length <= 1e-14 * first) break;
      basis.col(count) = next / length;
      next = factor.solve(m * basis.col(count));
      for (int pass = 0; pass < 2; ++pass) {
        const Eigen::VectorXd weighted = m * next;
        const Eigen::VectorXd along = basis.leftCols(count + 1).transpose() * weighted;
        next -= basis.leftCols(count + 1) * along;
        projected.col(count).head(count + 1) += along;
      }
      length = std::sqrt(std::max(0.0, next.dot(m * next)));
    }
    const Eigen::MatrixXd square = projected.topLeftCorner(count, count);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(square.selfadjointView<Eigen::Upper>());
    const Eigen::VectorXd seen = ritz.eigenvectors().transpose() * (basis.leftCols(count).transpose() * load);
    const Eigen::VectorXd excited = first * ritz.eigenvectors().row(0).transpose();
    const Eigen::VectorXd weight = seen.cwiseProduct(excited);
    out.push_back(
        {{ritz.eigenvalues().begin(), ritz.eigenvalues().end()}, {weight.begin(), weight.end()}, kShift});
  }
  return out;
}

}  // namespace tread
