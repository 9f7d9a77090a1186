#include "kernels/contact/face_quadrature.hpp"

#include <fmt/core.h>

#include <cmath>

#include "core/error.hpp"

namespace tread {

namespace {

/// Points and weights of Gauss on [0, 1].
std::vector<std::array<double, 2>> gauss(int points) {
  switch (points) {
    case 1:
      return {{0.5, 1.0}};
    case 2: {
      const double a = 0.5 / std::sqrt(3.0);
      return {{0.5 - a, 0.5}, {0.5 + a, 0.5}};
    }
    case 3: {
      const double a = 0.5 * std::sqrt(0.6);
      return {{0.5 - a, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + a, 5.0 / 18}};
    }
    case 4: {
      const double a = 0.5 * std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
      const double b = 0.5 * std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
      const double wa = (18 + std::sqrt(30.0)) / 72;
      const double wb = (18 - std::sqrt(30.0)) / 72;
      return {{0.5 - b, wb}, {0.5 - a, wa}, {0.5 + a, wa}, {0.5 + b, wb}};
    }
    default:
      throw InputError(
          fmt::format("contact.points = {}: 1 to 4 integration points per direction are available", points));
  }
}

}  // namespace

FaceQuadrature::FaceQuadrature(int per_line) : line_(gauss(per_line)) {
  for (const auto& along : line_)
    for (const auto& across : line_) points_.push_back({along[0], across[0], along[1] * across[1]});
}

}  // namespace tread
