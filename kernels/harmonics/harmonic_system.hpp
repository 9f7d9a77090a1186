#pragma once
// Matrices of a solid in harmonics and their Lanczos vectors; of kernels/harmonics alone, for Eigen's sake.

#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

namespace tread {

/// Below all elastic modes: the shifted system is regular whatever the solid is free to do [1/s2].
inline constexpr double kHarmonicShift = 4e6;

using HarmonicMatrix = Eigen::SparseMatrix<double>;

/// Matrices per radian around the axis or per metre of a bar, by powers of the number of waves.
struct HarmonicMatrices {
  std::array<HarmonicMatrix, 3> stiffness;
  HarmonicMatrix mass;
  std::array<HarmonicMatrix, 2> turning;
  HarmonicMatrix carried;  ///< mass that takes part in one wave, whole
  double whole = 0;        ///< radians of a turn or length of a bar
};

/// Matrices of one harmonic.
struct HarmonicSystem {
  HarmonicSystem(const HarmonicMatrices& matrices, int waves);

  HarmonicMatrix mass, turning;
  Eigen::SimplicialLDLT<HarmonicMatrix> factor;  ///< of stiffness + kHarmonicShift mass
};

/// Ritz vectors of a load.
struct HarmonicRitz {
  HarmonicRitz(const HarmonicSystem& system, const std::vector<double>& load, int vectors);

  Eigen::VectorXd decay;   ///< 1 / (omega^2 + kHarmonicShift), ascending
  Eigen::VectorXd weight;  ///< share of the load's receptance at the shift
  Eigen::MatrixXd shapes;  ///< of a modal mass of 1 kg
};

}  // namespace tread
