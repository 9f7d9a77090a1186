#include "kernels/element/hexahedron.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/index.hpp"
#include "kernels/element/element.hpp"
#include "kernels/element/element_frequency.hpp"

namespace tread {

namespace {

using Matrix83 = Eigen::Matrix<double, 8, 3>;

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

Eigen::Matrix3d stress_of(const HexahedronShape& shape, const Eigen::Matrix3d& g) {
  Eigen::Matrix3d strain = (g + g.transpose()) / 2;
  if (shape.finite_rotation) strain += g.transpose() * g / 2;
  return shape.material.lame_lambda() * strain.trace() * Eigen::Matrix3d::Identity() +
         2 * shape.material.shear_modulus() * strain;
}

/// Nodal forces of one element.
std::array<Vec3, 8> element_force(const HexahedronShape& shape, const HexahedronCoefficients& c,
                                  const std::array<Vec3, 8>& u) {
  const Eigen::Matrix3d g = to_matrix(u).transpose() * to_matrix(c.gradient);
  Eigen::Matrix3d p = stress_of(shape, g);
  if (shape.finite_rotation) p = (Eigen::Matrix3d::Identity() + g) * p;
  const Matrix83 stress_force = c.volume * to_matrix(c.gradient) * p.transpose();
  std::array<Vec3, 8> f;
  for (int row = 0; row < 24; ++row) {
    double sum = stress_force(row / 3, row % 3);
    for (int column = 0; column < 24; ++column)
      sum += c.hourglass_stiffness[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] *
             u[static_cast<std::size_t>(column / 3)][column % 3];
    f[static_cast<std::size_t>(row / 3)][row % 3] = sum;
  }
  return f;
}

}  // namespace

HexahedronCoefficients hexahedron_coefficients(const HexahedronShape& shape) {
  const Matrix83 nodes = to_matrix(shape.nodes);
  const auto [b, volume] = mean_gradients(nodes);
  const Matrix83 c = corners();
  Eigen::Matrix<double, 8, 4> h;
  h << c.col(1).cwiseProduct(c.col(2)), c.col(2).cwiseProduct(c.col(0)), c.col(0).cwiseProduct(c.col(1)),
      c.rowwise().prod();
  const Eigen::Matrix<double, 8, 4> gamma = (h - b * (nodes.transpose() * h)) / 8;
  Eigen::Matrix<double, 12, 24> amplitude = Eigen::Matrix<double, 12, 24>::Zero();
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i)
      for (int alpha = 0; alpha < 4; ++alpha) amplitude(3 * alpha + i, 3 * node + i) = gamma(node, alpha);
  const Eigen::Matrix<double, 24, 24> k =
      amplitude.transpose() * hourglass_stiffness(to_matrix(shape.reference), shape.material) * amplitude;

  HexahedronCoefficients result;
  result.volume = volume;
  for (std::size_t node = 0; node < 8; ++node)
    for (int j = 0; j < 3; ++j) result.gradient[node][j] = b(static_cast<int>(node), j);
  for (std::size_t row = 0; row < 24; ++row)
    for (std::size_t column = 0; column < 24; ++column)
      result.hourglass_stiffness[row][column] = k(static_cast<int>(row), static_cast<int>(column));
  return result;
}

std::array<double, 6> hexahedron_stress(const HexahedronShape& shape,
                                        const std::array<Vec3, 8>& displacement) {
  const Matrix83 b = mean_gradients(to_matrix(shape.nodes)).first;
  const Eigen::Matrix3d s = stress_of(shape, to_matrix(displacement).transpose() * b);
  return {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(2, 0), s(0, 1)};
}

double hexahedron_frequency(const HexahedronShape& shape) {
  HexahedronShape linear = shape;
  linear.finite_rotation = false;
  const HexahedronCoefficients c = hexahedron_coefficients(linear);
  ElementStiffness stiffness;
  for (int column = 0; column < 24; ++column) {
    std::array<Vec3, 8> u;
    u[index(column / 3)][column % 3] = 1;
    const std::array<Vec3, 8> force = element_force(linear, c, u);
    for (int row = 0; row < 24; ++row) stiffness[index(row)][index(column)] = force[index(row / 3)][row % 3];
  }
  return largest_frequency(stiffness, element_geometry(shape.nodes).nodal_volume, shape.material.density);
}

GeneralForce::GeneralForce(std::vector<Element> elements) : elements_(std::move(elements)) {
  for (const Element& element : elements_) coefficients_.push_back(hexahedron_coefficients(element.shape));
}

std::vector<Vec3> GeneralForce::apply(const std::vector<Vec3>& u) const {
  std::vector<Vec3> f(u.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    std::array<Vec3, 8> values;
    for (std::size_t node = 0; node < 8; ++node)
      values[node] = u[static_cast<std::size_t>(elements_[e].node[node])];
    const auto force = element_force(elements_[e].shape, coefficients_[e], values);
    for (std::size_t node = 0; node < 8; ++node)
      f[static_cast<std::size_t>(elements_[e].node[node])] += force[node];
  }
  return f;
}

}  // namespace tread
