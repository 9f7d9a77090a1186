#include "drivers/engine/beam/beam_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/math/band_matrix.hpp"

namespace tread {

namespace {

/// Bilinear shape functions of a quad at a Gauss point and their gradients.
struct QuadPoint {
  double y = 0, z = 0;
  double weight = 0;  ///< area that the point stands for [m2]
  std::array<double, 4> value{};
  std::array<double, 4> along_y{}, along_z{};  ///< [1/m]
};

std::array<QuadPoint, 4> quad_points(const Section& section, std::size_t quad) {
  constexpr std::array<double, 4> kXi = {-1, 1, 1, -1};
  constexpr std::array<double, 4> kEta = {-1, -1, 1, 1};
  const double g = 1 / std::numbers::sqrt3;
  std::array<QuadPoint, 4> points;
  for (std::size_t k = 0; k < 4; ++k) {
    QuadPoint& point = points[k];
    std::array<double, 4> d_xi{}, d_eta{};
    double y_xi = 0, y_eta = 0, z_xi = 0, z_eta = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double xi = g * kXi[k];
      const double eta = g * kEta[k];
      const auto node = static_cast<std::size_t>(section.quads[quad][i]);
      point.value[i] = 0.25 * (1 + kXi[i] * xi) * (1 + kEta[i] * eta);
      d_xi[i] = 0.25 * kXi[i] * (1 + kEta[i] * eta);
      d_eta[i] = 0.25 * kEta[i] * (1 + kXi[i] * xi);
      point.y += point.value[i] * section.p[node];
      point.z += point.value[i] * section.q[node];
      y_xi += d_xi[i] * section.p[node];
      y_eta += d_eta[i] * section.p[node];
      z_xi += d_xi[i] * section.q[node];
      z_eta += d_eta[i] * section.q[node];
    }
    point.weight = y_xi * z_eta - y_eta * z_xi;
    for (std::size_t i = 0; i < 4; ++i) {
      point.along_y[i] = (d_xi[i] * z_eta - d_eta[i] * z_xi) / point.weight;
      point.along_z[i] = (d_eta[i] * y_xi - d_xi[i] * y_eta) / point.weight;
    }
  }
  return points;
}

template <class Visit>
void for_points(const std::vector<const Section*>& parts, const Visit& visit) {
  for (std::size_t part = 0; part < parts.size(); ++part)
    for (std::size_t quad = 0; quad < parts[part]->quads.size(); ++quad)
      for (const QuadPoint& point : quad_points(*parts[part], quad)) visit(part, quad, point);
}

/// A node's value as a sum: unknowns and weights.
using Mixture = std::vector<std::pair<int, double>>;

/// Nodes of the first part on the tie take the values of the second part's, linear between two.
struct Unknowns {
  std::vector<std::vector<Mixture>> of;  ///< by part and node
  int count = 0;
};

Unknowns number_unknowns(const std::vector<const Section*>& parts) {
  Unknowns unknowns;
  unknowns.of.resize(parts.size());
  for (std::size_t part = parts.size(); part-- > 0;) {
    unknowns.of[part].resize(parts[part]->p.size());
    std::map<int, Mixture> tied;
    if (part == 0 && parts.size() == 2) {
      const Section& base = *parts[1];
      const std::vector<int>& line = base.paths.at("tie");
      const auto y = [&](std::size_t i) { return base.p[static_cast<std::size_t>(line[i])]; };
      for (const int node : parts[0]->paths.at("tie")) {
        const double at = parts[0]->p[static_cast<std::size_t>(node)];
        std::size_t i = 0;
        while (i + 2 < line.size() && y(i + 1) < at) ++i;
        const double share = std::clamp((at - y(i)) / (y(i + 1) - y(i)), 0.0, 1.0);
        const auto& of_base = unknowns.of[1];
        tied[node] = {{of_base[static_cast<std::size_t>(line[i])][0].first, 1 - share},
                      {of_base[static_cast<std::size_t>(line[i + 1])][0].first, share}};
      }
    }
    for (std::size_t node = 0; node < parts[part]->p.size(); ++node) {
      const auto found = tied.find(static_cast<int>(node));
      unknowns.of[part][node] = found != tied.end() ? found->second : Mixture{{unknowns.count++, 1.0}};
    }
  }
  return unknowns;
}

/// An edge of a quad at the bottom of a section.
struct BottomEdge {
  std::size_t part = 0;
  int first = 0, second = 0;  ///< nodes
  double length = 0;          ///< [m]
};

std::vector<BottomEdge> bottom_edges(const std::vector<const Section*>& parts, double bottom, double depth) {
  constexpr double kFlat = 1e-6;  // of the depth
  std::vector<BottomEdge> edges;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const Section& section = *parts[part];
    const auto at_bottom = [&](int node) {
      return section.q[static_cast<std::size_t>(node)] < bottom + kFlat * depth;
    };
    for (const std::array<int, 4>& quad : section.quads)
      for (std::size_t i = 0; i < 4; ++i) {
        const int first = quad[i];
        const int second = quad[(i + 1) % 4];
        const double length = std::abs(section.p[static_cast<std::size_t>(second)] -
                                       section.p[static_cast<std::size_t>(first)]);
        if (at_bottom(first) && at_bottom(second) && length > 0)
          edges.push_back({part, first, second, length});
      }
  }
  return edges;
}

/// Warping of a section by shear: its motion along the beam is Psi / G, its shear stresses are grad Psi - d.
class Warping {
 public:
  Warping(const std::vector<const Section*>& parts, const BeamSection& s, double nu)
      : parts_(parts),
        section_(s),
        poisson_(nu / (2 * (1 + nu))),
        unknowns_(number_unknowns(parts)),
        laplace_(unknowns_.count, unknowns_.count - 1),
        bottom_(bottom_edges(parts, s.height - s.foot, s.depth)) {
    for (const BottomEdge& edge : bottom_) width_ += edge.length;
    for_points(parts, [&](std::size_t part, std::size_t quad, const QuadPoint& p) {
      middle_ += p.weight * p.y / s.area;
      for (std::size_t i = 0; i < 4; ++i)
        for (const auto& [row, share] : mixture(part, quad, i))
          for (std::size_t j = 0; j < 4; ++j)
            for (const auto& [column, other] : mixture(part, quad, j))
              if (row >= column)
                laplace_.at(row, column) +=
                    share * other * p.weight * (p.along_y[i] * p.along_y[j] + p.along_z[i] * p.along_z[j]);
    });
    laplace_.restrain(0, 1);  // Psi is known but for a constant
    laplace_.factorise();
  }

  bool has_bottom() const { return !bottom_.empty(); }
  double bottom_width() const { return width_; }  ///< [m]

  /// Sums of Psi and d over the section.
  struct Sums {
    double d_z = 0;     ///< integral of d_z
    double mean = 0;    ///< of Psi
    double moment = 0;  ///< integral of z Psi
    double foot = 0;    ///< mean of Psi over the bottom
  };

  /// Under a stress along the beam that grows with x by `constant` + `by_height` z, z from the centroid, and
  /// a shear stress `traction` along x at the bottom. [theory.md, eqs. B3, B6]
  Sums solve(double constant, double by_height, double traction) const;

 private:
  const Mixture& of_node(std::size_t part, int node) const {
    return unknowns_.of[part][static_cast<std::size_t>(node)];
  }
  const Mixture& mixture(std::size_t part, std::size_t quad, std::size_t i) const {
    return of_node(part, parts_[part]->quads[quad][i]);
  }

  const std::vector<const Section*>& parts_;
  const BeamSection& section_;
  double poisson_;  ///< nu / (2 (1 + nu))
  Unknowns unknowns_;
  BandMatrix<double> laplace_;
  std::vector<BottomEdge> bottom_;
  double width_ = 0;   ///< of the bottom [m]
  double middle_ = 0;  ///< y of the line of symmetry [m]
};

Warping::Sums Warping::solve(double constant, double by_height, double traction) const {
  Sums sums;
  std::vector<double> load(static_cast<std::size_t>(unknowns_.count));
  for_points(parts_, [&](std::size_t part, std::size_t quad, const QuadPoint& p) {
    const double y = p.y - middle_;
    const double z = p.z - section_.height;
    const double d_y = poisson_ * y * (constant + by_height * z);
    const double d_z = poisson_ * (constant * z + 0.5 * by_height * (z * z - y * y));
    sums.d_z += p.weight * d_z;
    for (std::size_t i = 0; i < 4; ++i)
      for (const auto& [row, share] : mixture(part, quad, i))
        load[static_cast<std::size_t>(row)] +=
            share * p.weight *
            (p.value[i] * (constant + by_height * z) + p.along_y[i] * d_y + p.along_z[i] * d_z);
  });
  for (const BottomEdge& edge : bottom_)
    for (const int node : {edge.first, edge.second})
      for (const auto& [row, share] : of_node(edge.part, node))
        load[static_cast<std::size_t>(row)] += 0.5 * share * traction * edge.length;
  load[0] = 0;
  const std::vector<double> psi = laplace_.solve(load);
  const auto value = [&](const Mixture& of) {
    double sum = 0;
    for (const auto& [row, share] : of) sum += share * psi[static_cast<std::size_t>(row)];
    return sum;
  };
  for_points(parts_, [&](std::size_t part, std::size_t quad, const QuadPoint& p) {
    double at = 0;
    for (std::size_t i = 0; i < 4; ++i) at += p.value[i] * value(mixture(part, quad, i));
    sums.mean += p.weight * at / section_.area;
    sums.moment += p.weight * (p.z - section_.height) * at;
  });
  for (const BottomEdge& edge : bottom_)
    sums.foot += 0.5 * edge.length / width_ *
                 (value(of_node(edge.part, edge.first)) + value(of_node(edge.part, edge.second)));
  return sums;
}

/// Psi of the bottom less that of the plane with the mean and the moment of Psi.
double beyond_plane(const BeamSection& s, const Warping::Sums& sums) {
  return sums.foot - sums.mean + s.foot / s.vertical * sums.moment;
}

}  // namespace

BeamSection beam_section(const std::vector<const Section*>& parts, double poissons_ratio) {
  BeamSection s;
  double first = 0;
  double lateral_first = 0;
  for_points(parts, [&](std::size_t, std::size_t, const QuadPoint& p) {
    s.area += p.weight;
    first += p.weight * p.z;
    lateral_first += p.weight * p.y;
    s.vertical += p.weight * p.z * p.z;
    s.lateral += p.weight * p.y * p.y;
  });
  s.height = first / s.area;
  s.vertical -= first * s.height;
  s.lateral -= lateral_first * lateral_first / s.area;
  double top = -1e9, bottom = 1e9;
  for (const Section* part : parts) {
    const auto [low, high] = std::minmax_element(part->q.begin(), part->q.end());
    bottom = std::min(bottom, *low);
    top = std::max(top, *high);
  }
  s.depth = top - bottom;
  s.foot = s.height - bottom;
  const Warping warping(parts, s, poissons_ratio);
  const Warping::Sums sheared = warping.solve(0, 1, 0);  // by a shear force of the size of I
  s.shear_coefficient = s.vertical / (s.area / s.vertical * sheared.moment - sheared.d_z);
  if (!warping.has_bottom()) return s;
  s.foot_warping = beyond_plane(s, sheared) / s.vertical;
  s.foot_shear = beyond_plane(s, warping.solve(-1 / s.area, s.foot / s.vertical, 1 / warping.bottom_width()));
  return s;
}

BeamProperties timoshenko(const BeamSection& section, const Material& material) {
  const double sheared = section.shear_coefficient * section.area;
  BeamProperties beam;
  beam.bending_stiffness = material.youngs_modulus * section.vertical;
  beam.shear_stiffness = material.shear_modulus() * sheared;
  beam.mass = material.density * section.area;
  beam.rotary_inertia = material.density * section.vertical;
  beam.depth = section.depth;
  beam.axial_stiffness = material.youngs_modulus * section.area;
  beam.foot = section.foot;
  beam.foot_warping = sheared * section.foot_warping;
  beam.foot_compliance =
      (section.foot_shear - beam.foot_warping * section.foot_warping) / material.shear_modulus();
  return beam;
}

BeamProperties euler(const BeamSection& section, const Material& material) {
  return {material.youngs_modulus * section.vertical, 0, material.density * section.area, 0, 0};
}

double head_spread(double depth, double poissons_ratio, double wave_number) {
  const double x = wave_number * depth;
  const double sine = std::sinh(x);
  const double strip = 2 * (sine + x * std::cosh(x)) / (sine * sine - x * x);
  const double beam = 12 / (x * x * x) + (12 + 11 * poissons_ratio) / (5 * x);
  return std::sqrt(2 * std::log(beam / strip)) / wave_number;
}

namespace {

/// Squares of both branches' angular frequencies, lower first, which solve a x^2 - b x + c = 0. [rad2/s2]
std::pair<double, double> squared_frequencies(const BeamProperties& beam, double wave_number) {
  const double k2 = wave_number * wave_number;
  const double a = beam.mass * beam.rotary_inertia;
  const double b = beam.mass * (beam.bending_stiffness * k2 + beam.shear_stiffness) +
                   beam.rotary_inertia * beam.shear_stiffness * k2;
  const double c = beam.shear_stiffness * beam.bending_stiffness * k2 * k2;
  const double twice_upper = b + std::sqrt(b * b - 4 * a * c);
  return {2 * c / twice_upper, 0.5 * twice_upper / a};
}

}  // namespace

double wave_frequency(const BeamProperties& beam, double wave_number) {
  const double k2 = wave_number * wave_number;
  if (beam.shear_stiffness == 0)
    return std::sqrt(beam.bending_stiffness / beam.mass) * k2 / (2 * std::numbers::pi);
  return std::sqrt(squared_frequencies(beam, wave_number).first) / (2 * std::numbers::pi);
}

double upper_wave_frequency(const BeamProperties& beam, double wave_number) {
  return std::sqrt(squared_frequencies(beam, wave_number).second) / (2 * std::numbers::pi);
}

double wave_number(const BeamProperties& beam, double frequency) {
  double low = 0;
  double high = 1;
  while (wave_frequency(beam, high) < frequency) high *= 2;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (wave_frequency(beam, middle) < frequency ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace tread
