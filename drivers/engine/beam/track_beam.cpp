#include "drivers/engine/beam/track_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contract.hpp"

namespace tread {

namespace {

/// Shape functions of deflection and rotation at xi = 0 ... 1 of an element of length l and their
/// derivatives. [Friedman, Kosmatka, An improved two-node Timoshenko beam finite element, Comput. Struct. 47
/// (1993)]
struct BeamShape {
  using Values = std::array<double, static_cast<std::size_t>(2 * TrackBeam::kOfBeam)>;
  Values deflection{}, slope{};    ///< w, dw/dx
  Values rotation{}, curvature{};  ///< theta, dtheta/dx
};

/// Motion of the centroid along x and its derivative: linear between the nodes, where it is that of the foot
/// plus the lever's part.
struct AxialShape {
  BeamShape::Values motion{}, strain{};
};

AxialShape axial_shape(double xi, double l, double foot) {
  return {{0, foot * (1 - xi), 1 - xi, 0, foot * xi, xi}, {0, -foot / l, -1 / l, 0, foot / l, 1 / l}};
}

BeamShape beam_shape(double xi, double l, double phi) {
  const double c = 1 / (1 + phi);
  const double x2 = xi * xi;
  const double x3 = x2 * xi;
  BeamShape s;
  s.deflection = {c * (2 * x3 - 3 * x2 - phi * xi + 1 + phi),
                  c * l * (x3 - (2 + 0.5 * phi) * x2 + (1 + 0.5 * phi) * xi),
                  0,
                  -c * (2 * x3 - 3 * x2 - phi * xi),
                  c * l * (x3 - (1 - 0.5 * phi) * x2 - 0.5 * phi * xi),
                  0};
  s.slope = {c / l * (6 * x2 - 6 * xi - phi),  c * (3 * x2 - (4 + phi) * xi + 1 + 0.5 * phi), 0,
             -c / l * (6 * x2 - 6 * xi - phi), c * (3 * x2 - (2 - phi) * xi - 0.5 * phi),     0};
  s.rotation = {6 * c / l * (x2 - xi),  c * (3 * x2 - (4 + phi) * xi + 1 + phi), 0,
                -6 * c / l * (x2 - xi), c * (3 * x2 - (2 - phi) * xi),           0};
  s.curvature = {6 * c / (l * l) * (2 * xi - 1),  c / l * (6 * xi - 4 - phi), 0,
                 -6 * c / (l * l) * (2 * xi - 1), c / l * (6 * xi - 2 + phi), 0};
  return s;
}

/// The foot's motion along x: of its plane section, between the nodes linear, and by shear.
BeamShape::Values foot_shape(double xi, double l, double phi, double warping) {
  BeamShape::Values foot = {0, 0, 1 - xi, 0, 0, xi};
  const BeamShape beam = beam_shape(xi, l, phi);
  for (std::size_t i = 0; i < foot.size(); ++i) foot[i] -= warping * (beam.slope[i] - beam.rotation[i]);
  return foot;
}

constexpr int kFoot = 2;     // of a node's unknowns
constexpr int kSleeper = 3;  // of a node's unknowns, where there are sleepers

int element_count(double length, double element) {
  return std::max(2, static_cast<int>(std::ceil(length / element - 1e-9)));
}

}  // namespace

TrackBeam::TrackBeam(const BeamProperties& properties, double left, double length, BeamEnds ends,
                     double element, bool sleepers)
    : left_(left),
      length_(length),
      pitch_(length / element_count(length, element)),
      per_node_(sleepers ? kOfBeam + 1 : kOfBeam),
      elements_(element_count(length, element)),
      phi_(properties.shear_stiffness > 0
               ? 12 * properties.bending_stiffness / (properties.shear_stiffness * pitch_ * pitch_)
               : 0),
      foot_(properties.has_foot() ? properties.foot : 0),
      foot_warping_(properties.foot_warping),
      foot_compliance_(properties.foot_compliance),
      held_(properties.bending_stiffness),
      stiffness_(per_node_ * (elements_ + 1), 2 * per_node_ - 1),
      damping_(stiffness_),
      mass_(stiffness_) {
  for (int e = 0; e < elements_; ++e) add_element(properties, e);
  if (!properties.has_foot())
    for (int node = 0; node <= elements_; ++node) hold(node, kFoot);
  if (sleepers)
    for (int node = 0; node <= elements_; ++node) hold(node, kSleeper);
  for (const int node : {0, elements_}) {
    if (ends == BeamEnds::pinned) hold(node, 0);
    if (ends != BeamEnds::guided) continue;
    hold(node, 1);
    hold(node, kFoot);
  }
}

void TrackBeam::add_outer(BandMatrix<double>& matrix, int first, double factor,
                          const BeamShape::Values& v) const {
  for (int i = 0; i < static_cast<int>(v.size()); ++i)
    for (int j = 0; j <= i; ++j)
      matrix.at(unknown(first, i), unknown(first, j)) +=
          factor * v[static_cast<std::size_t>(i)] * v[static_cast<std::size_t>(j)];
}

void TrackBeam::hold(int node, int component) {
  const int held = per_node_ * node + component;
  stiffness_.restrain(held, held_);
  damping_.restrain(held, 0);
  mass_.restrain(held, 0);
}

void TrackBeam::add_element(const BeamProperties& properties, int element) {
  // Four Gauss points integrate all products of the shape functions exactly.
  constexpr std::array<double, 2> kPoint = {0.33998104358485626, 0.86113631159405258};
  constexpr std::array<double, 2> kWeight = {0.65214515486254614, 0.34785484513745386};
  for (std::size_t k = 0; k < 2; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double xi = 0.5 + 0.5 * side * kPoint[k];
      const BeamShape s = beam_shape(xi, pitch_, phi_);
      const double weight = 0.5 * pitch_ * kWeight[k];
      BeamShape::Values shear{};
      for (std::size_t i = 0; i < shear.size(); ++i) shear[i] = s.slope[i] - s.rotation[i];
      const int first = per_node_ * element;
      add_outer(stiffness_, first, weight * properties.bending_stiffness, s.curvature);
      add_outer(stiffness_, first, weight * properties.shear_stiffness, shear);
      add_outer(mass_, first, weight * properties.mass, s.deflection);
      add_outer(mass_, first, weight * properties.rotary_inertia, s.rotation);
      if (!properties.has_foot()) continue;
      const AxialShape axial = axial_shape(xi, pitch_, properties.foot);
      add_outer(stiffness_, first, weight * properties.axial_stiffness, axial.strain);
      add_outer(mass_, first, weight * properties.mass, axial.motion);
    }
}

TrackBeam::Place TrackBeam::place(double x) const {
  const double at = (x - left_) / pitch_;
  const int element = std::clamp(static_cast<int>(at), 0, elements_ - 1);
  return {per_node_ * element, at - element};
}

TrackBeam::Shape TrackBeam::shape(double x) const {
  const Place at = place(x);
  return {at.first, beam_shape(at.xi, pitch_, phi_).deflection};
}

std::vector<double> TrackBeam::head_load(double x) const {
  constexpr double kReach = 3;  // in standard deviations
  constexpr int kParts = 60;    // of the reach to both sides
  std::vector<double> load(static_cast<std::size_t>(stiffness_.size()));
  const auto add = [&](double at, double share) {
    const Shape s = shape(std::clamp(at, left_, left_ + length_));
    for (int i = 0; i < 2 * kOfBeam; ++i)
      load[static_cast<std::size_t>(unknown(s.first, i))] += share * s.value[static_cast<std::size_t>(i)];
  };
  if (spread_ == 0) {
    add(x, 1);
    return load;
  }
  std::array<double, kParts> part{};
  double sum = 0;
  const auto offset = [](std::size_t i) {
    return kReach * (2 * (static_cast<double>(i) + 0.5) / kParts - 1);
  };
  for (std::size_t i = 0; i < kParts; ++i) sum += part[i] = std::exp(-0.5 * offset(i) * offset(i));
  for (std::size_t i = 0; i < kParts; ++i) add(x + offset(i) * spread_, part[i] / sum);
  return load;
}

void TrackBeam::support(double x, double stiffness, double damping) {
  const Shape s = shape(x);
  add_outer(stiffness_, s.first, stiffness, s.value);
  add_outer(damping_, s.first, damping, s.value);
}

void TrackBeam::support_on_sleeper(const SleeperSupport& fastening) {
  TREAD_EXPECT(per_node_ > kOfBeam);
  constexpr double kRigid = 1e6;  // of the springs at the sleeper
  const BeamSleeper& sleeper = fastening.sleeper;
  const auto unknown_at = [&](double x) { return place(x).first + kSleeper; };  // of an element's left node
  const auto [before, behind] = std::ranges::minmax(fastening.columns);
  const int first = unknown_at(fastening.x + std::min(before, 0.0));
  const int last = unknown_at(fastening.x + std::max(behind, 0.0));
  // One body: the unknowns of all nodes along the pad, held until now, and springs that keep them together.
  for (int at = first; at <= last; at += per_node_)
    for (BandMatrix<double>* matrix : {&stiffness_, &damping_, &mass_}) matrix->at(at, at) = 0;
  const double rigid = kRigid * (fastening.stiffness + sleeper.stiffness);
  for (int at = first; at < last; at += per_node_) {
    stiffness_.at(at, at) += rigid;
    stiffness_.at(at + per_node_, at + per_node_) += rigid;
    stiffness_.at(at + per_node_, at) -= rigid;
  }
  const int middle = unknown_at(fastening.x);
  stiffness_.at(middle, middle) += sleeper.stiffness;
  damping_.at(middle, middle) += sleeper.damping;
  mass_.at(middle, middle) += sleeper.mass;
  const auto columns = static_cast<double>(fastening.columns.size());
  for (const double offset : fastening.columns)
    join_to_sleeper(fastening.x + offset, fastening.stiffness / columns, fastening.damping / columns);
  sleepers_.push_back(fastening.x);
}

void TrackBeam::join_to_sleeper(double x, double stiffness, double damping) {
  const Shape s = shape(x);
  const int at = s.first + kSleeper;
  support(x, stiffness, damping);
  stiffness_.at(at, at) += stiffness;
  damping_.at(at, at) += damping;
  for (int i = 0; i < 2 * kOfBeam; ++i) {
    const int row = std::max(at, unknown(s.first, i));
    const int column = std::min(at, unknown(s.first, i));
    stiffness_.at(row, column) -= stiffness * s.value[static_cast<std::size_t>(i)];
    damping_.at(row, column) -= damping * s.value[static_cast<std::size_t>(i)];
  }
}

double TrackBeam::sleeper(const std::vector<double>& state, double x) const {
  TREAD_EXPECT(!sleepers_.empty());
  const double nearest = *std::min_element(sleepers_.begin(), sleepers_.end(), [&](double a, double b) {
    return std::abs(a - x) < std::abs(b - x);
  });
  return state[static_cast<std::size_t>(place(nearest).first + kSleeper)];
}

void TrackBeam::support_foot(double x, double stiffness, double damping) {
  const Place at = place(x);
  const BeamShape::Values foot = foot_shape(at.xi, pitch_, phi_, foot_warping_);
  add_outer(stiffness_, at.first, stiffness, foot);
  add_outer(damping_, at.first, damping, foot);
}

void TrackBeam::hold_foot(double first, double last) {
  const auto node_at = [&](double x) { return std::clamp((x - left_) / pitch_, 0.0, 1.0 * elements_); };
  if (!(last > first)) {
    constexpr double kRigid = 1e3;  // of an element
    support_foot(first, kRigid * held_ / (pitch_ * pitch_ * pitch_), 0);
  } else if (foot_compliance_ > 0) {
    hold_stretch(node_at(first), node_at(last));
  } else {
    constexpr double kRounding = 1e-9;
    for (int node = static_cast<int>(std::ceil(node_at(first) - kRounding));
         node <= node_at(last) + kRounding; ++node)
      hold(node, kFoot);
  }
}

void TrackBeam::hold_stretch(double first, double last) {
  const double point = 0.5 / std::numbers::sqrt3;  // Gauss, two points
  for (int e = static_cast<int>(first); e < last; ++e) {
    const double from = std::max(first - e, 0.0);
    const double to = std::min(last - e, 1.0);
    for (const double side : {-point, point})
      add_outer(stiffness_, per_node_ * e, 0.5 * (to - from) * pitch_ / foot_compliance_,
                foot_shape(0.5 * (from + to) + side * (to - from), pitch_, phi_, foot_warping_));
  }
}

std::vector<double> TrackBeam::static_state(double x, double force) const {
  BandMatrix<double> factor = stiffness_;
  factor.factorise();
  std::vector<double> load = head_load(x);
  for (double& value : load) value *= force;
  return factor.solve(std::move(load));
}

SectionMotion TrackBeam::motion(const std::vector<double>& state, int node) const {
  const auto first = static_cast<std::size_t>(per_node_ * node);
  return {state[first], state[first + 1], state[first + kFoot] + foot_ * state[first + 1]};
}

double TrackBeam::deflection(const std::vector<double>& state, double x) const {
  const Shape s = shape(x);
  double sum = 0;
  for (int i = 0; i < 2 * kOfBeam; ++i)
    sum += s.value[static_cast<std::size_t>(i)] * state[static_cast<std::size_t>(unknown(s.first, i))];
  return sum;
}

std::complex<double> TrackBeam::receptance(double x_force, double x, double frequency) const {
  const double omega = 2 * std::numbers::pi * frequency;
  BandMatrix<std::complex<double>> factor(stiffness_.size(), stiffness_.band());
  factor.add(1.0, stiffness_);
  factor.add({0, omega}, damping_);
  factor.add(-omega * omega, mass_);
  factor.factorise();
  std::vector<std::complex<double>> load(static_cast<std::size_t>(factor.size()));
  const Shape s = shape(x_force);
  for (int i = 0; i < 2 * kOfBeam; ++i)
    load[static_cast<std::size_t>(unknown(s.first, i))] = s.value[static_cast<std::size_t>(i)];
  const auto state = factor.solve(std::move(load));
  const Shape t = shape(x);
  std::complex<double> sum;
  for (int i = 0; i < 2 * kOfBeam; ++i)
    sum += t.value[static_cast<std::size_t>(i)] * state[static_cast<std::size_t>(unknown(t.first, i))];
  return sum;
}

}  // namespace tread
