#include "kernels/hexahedron.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tread {

namespace {

using Matrix83 = Eigen::Matrix<double, 8, 3>;
using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;

/// Columns xi, eta, zeta of the nodes.
Matrix83 corners() {
  Matrix83 c;
  for (int end = 0; end < 2; ++end) {
    c.row(4 * end + 0) << 2 * end - 1, -1, -1;
    c.row(4 * end + 1) << 2 * end - 1, 1, -1;
    c.row(4 * end + 2) << 2 * end - 1, 1, 1;
    c.row(4 * end + 3) << 2 * end - 1, -1, 1;
  }
  return c;
}

Matrix83 to_matrix(const std::array<Vec3, 8>& nodes) {
  Matrix83 m;
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i) m(node, i) = nodes[static_cast<std::size_t>(node)][i];
  return m;
}

/// Derivatives of the shape functions by (xi, eta, zeta) at a point.
Matrix83 shape_derivatives(const Eigen::Vector3d& at) {
  const Matrix83 c = corners();
  Matrix83 d;
  for (int node = 0; node < 8; ++node)
    for (int k = 0; k < 3; ++k) {
      double value = c(node, k) / 8;
      for (int other = 0; other < 3; ++other)
        if (other != k) value *= 1 + c(node, other) * at(other);
      d(node, k) = value;
    }
  return d;
}

/// Volume averages of the shape functions' gradients, and the volume.
std::pair<Matrix83, double> mean_gradients(const Matrix83& nodes) {
  Matrix83 sum = Matrix83::Zero();
  double volume = 0;
  const Matrix83 c = corners();
  for (int gauss = 0; gauss < 8; ++gauss) {
    const Matrix83 derivative = shape_derivatives(c.row(gauss).transpose() / std::sqrt(3.0));
    const Eigen::Matrix3d map = nodes.transpose() * derivative;
    sum += derivative * map.inverse() * map.determinant();
    volume += map.determinant();
  }
  return {sum / volume, volume};
}

/// Stiffness of the hourglass amplitudes [3 alpha + i], Cartesian components i.
Eigen::Matrix<double, 12, 12> hourglass_stiffness(const Matrix83& reference, const Material& material) {
  const Eigen::Matrix3d map = reference.transpose() * corners() / 8;
  const double volume = mean_gradients(reference).second;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  const Eigen::Vector3d half = (rotation.transpose() * map).diagonal();
  const Eigen::Matrix3d h = volume / 3 * half.cwiseInverse() * half.cwiseInverse().transpose();

  const double mu = material.shear_modulus();
  const double nu = material.poissons_ratio;
  const double e = material.youngs_modulus;
  const double plate = e / (1 - nu * nu);
  Eigen::Matrix<double, 12, 12> local = Eigen::Matrix<double, 12, 12>::Zero();
  const auto at = [](int i, int alpha) { return 3 * alpha + i; };
  for (int i = 0; i < 3; ++i) {
    local(at(i, 3), at(i, 3)) = e * h(i, i) / 3;
    for (int j = 0; j < 3; ++j) {
      if (i == j) {
        local(at(i, i), at(i, i)) = mu * (h.trace() - h(i, i));
      } else {
        local(at(i, i), at(j, j)) = mu * h(i, j);
        local(at(i, j), at(i, j)) = plate * h(i, i);
        local(at(i, j), at(j, i)) = plate * nu * h(i, j);
      }
    }
  }
  Eigen::Matrix<double, 12, 12> turn = Eigen::Matrix<double, 12, 12>::Zero();
  for (int alpha = 0; alpha < 4; ++alpha) turn.block<3, 3>(3 * alpha, 3 * alpha) = rotation;
  return turn * local * turn.transpose();
}

Eigen::Matrix<double, 6, 6> elasticity(const Material& material) {
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(material.lame_lambda());
  d.diagonal().head<3>().array() += 2 * material.shear_modulus();
  d.diagonal().tail<3>().setConstant(material.shear_modulus());
  return d;
}

/// Strains (xx, yy, zz, 2yz, 2zx, 2xy) from nodal displacements.
Eigen::Matrix<double, 6, 24> strain_matrix(const Matrix83& b) {
  Eigen::Matrix<double, 6, 24> m = Eigen::Matrix<double, 6, 24>::Zero();
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      m(i, 3 * node + i) = b(node, i);
      m(3 + i, 3 * node + j) = b(node, k);
      m(3 + i, 3 * node + k) = b(node, j);
    }
  return m;
}

}  // namespace

HexahedronStiffness hexahedron_stiffness(const HexahedronShape& shape) {
  const Matrix83 nodes = to_matrix(shape.nodes);
  const auto [b, volume] = mean_gradients(nodes);
  const Eigen::Matrix<double, 6, 24> strain = strain_matrix(b);
  Matrix24 k = volume * strain.transpose() * elasticity(shape.material) * strain;

  Eigen::Matrix3d initial;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      initial(i, j) = shape.initial_stress[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Eigen::Matrix<double, 8, 8> geometric = volume * b * initial * b.transpose();

  const Matrix83 c = corners();
  Eigen::Matrix<double, 8, 4> h;
  h << c.col(1).cwiseProduct(c.col(2)), c.col(2).cwiseProduct(c.col(0)), c.col(0).cwiseProduct(c.col(1)),
      c.rowwise().prod();
  const Eigen::Matrix<double, 8, 4> gamma = (h - b * (nodes.transpose() * h)) / 8;
  const Eigen::Matrix<double, 12, 12> hourglass =
      hourglass_stiffness(to_matrix(shape.reference), shape.material);
  Eigen::Matrix<double, 12, 24> amplitude = Eigen::Matrix<double, 12, 24>::Zero();
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i)
      for (int alpha = 0; alpha < 4; ++alpha) amplitude(3 * alpha + i, 3 * node + i) = gamma(node, alpha);
  k += amplitude.transpose() * hourglass * amplitude;

  HexahedronStiffness result;
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 24; ++column)
      result[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          k(row, column) + (row % 3 == column % 3 ? geometric(row / 3, column / 3) : 0);
  return result;
}

std::array<double, 6> hexahedron_stress(const HexahedronShape& shape,
                                        const std::array<Vec3, 8>& displacement) {
  const Matrix83 b = mean_gradients(to_matrix(shape.nodes)).first;
  Eigen::Matrix<double, 24, 1> u;
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i) u(3 * node + i) = displacement[static_cast<std::size_t>(node)][i];
  const Eigen::Matrix<double, 6, 1> stress = elasticity(shape.material) * strain_matrix(b) * u;
  std::array<double, 6> result{};
  for (int i = 0; i < 6; ++i) result[static_cast<std::size_t>(i)] = stress(i);
  return result;
}

GeneralForce::GeneralForce(std::vector<Element> elements) : elements_(std::move(elements)) {
  for (const Element& element : elements_) stiffness_.push_back(hexahedron_stiffness(element.shape));
}

std::vector<Vec3> GeneralForce::apply(const std::vector<Vec3>& u) const {
  std::vector<Vec3> f(u.size());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int row = 0; row < 24; ++row) {
      double sum = 0;
      for (int column = 0; column < 24; ++column)
        sum +=
            stiffness_[e][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] *
            u[static_cast<std::size_t>(elements_[e].node[static_cast<std::size_t>(column / 3)])][column % 3];
      f[static_cast<std::size_t>(elements_[e].node[static_cast<std::size_t>(row / 3)])][row % 3] += sum;
    }
  return f;
}

}  // namespace tread
