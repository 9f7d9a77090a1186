#include "drivers/engine/beam/track_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"

namespace tread {

namespace {

/// Shape functions of deflection and rotation at xi = 0 ... 1 of an element of length l and their
/// derivatives. [Friedman, Kosmatka, An improved two-node Timoshenko beam finite element, Comput. Struct. 47
/// (1993)]
struct BeamShape {
  using Values = std::array<double, static_cast<std::size_t>(2 * TrackBeam::kPerNode)>;
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

/// The foot's motion along x, between the nodes linear.
BeamShape::Values foot_shape(double xi) {
  return {0, 0, 1 - xi, 0, 0, xi};
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

void add_outer(BandMatrix<double>& matrix, int first, double factor, const BeamShape::Values& v) {
  for (int i = 0; i < static_cast<int>(v.size()); ++i)
    for (int j = 0; j <= i; ++j)
      matrix.at(first + i, first + j) +=
          factor * v[static_cast<std::size_t>(i)] * v[static_cast<std::size_t>(j)];
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

constexpr int kBand = 2 * TrackBeam::kPerNode - 1;
constexpr int kFoot = 2;  // of a node's unknowns

int element_count(double length, double element) {
  return std::max(2, static_cast<int>(std::ceil(length / element - 1e-9)));
}

}  // namespace

TrackBeam::TrackBeam(const BeamProperties& properties, double left, double length, BeamEnds ends,
                     double element)
    : left_(left),
      length_(length),
      pitch_(length / element_count(length, element)),
      elements_(element_count(length, element)),
      phi_(properties.shear_stiffness > 0
               ? 12 * properties.bending_stiffness / (properties.shear_stiffness * pitch_ * pitch_)
               : 0),
      foot_(properties.has_foot() ? properties.foot : 0),
      held_(properties.bending_stiffness),
      stiffness_(kPerNode * (elements_ + 1), kBand),
      damping_(stiffness_),
      mass_(stiffness_) {
  for (int e = 0; e < elements_; ++e) add_element(properties, e);
  if (!properties.has_foot())
    for (int node = 0; node <= elements_; ++node) hold(node, kFoot);
  for (const int node : {0, elements_}) {
    if (ends == BeamEnds::pinned) hold(node, 0);
    if (ends != BeamEnds::guided) continue;
    hold(node, 1);
    hold(node, kFoot);
  }
}

void TrackBeam::hold(int node, int component) {
  const int unknown = kPerNode * node + component;
  stiffness_.restrain(unknown, held_);
  damping_.restrain(unknown, 0);
  mass_.restrain(unknown, 0);
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
      const int first = kPerNode * element;
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

TrackBeam::Shape TrackBeam::shape(double x) const {
  const double at = (x - left_) / pitch_;
  const int element = std::clamp(static_cast<int>(at), 0, elements_ - 1);
  return {kPerNode * element, beam_shape(at - element, pitch_, phi_).deflection};
}

std::vector<double> TrackBeam::head_load(double x) const {
  constexpr double kReach = 3;  // in standard deviations
  constexpr int kParts = 60;    // of the reach to both sides
  std::vector<double> load(static_cast<std::size_t>(stiffness_.size()));
  const auto add = [&](double at, double share) {
    const Shape s = shape(std::clamp(at, left_, left_ + length_));
    for (std::size_t i = 0; i < s.value.size(); ++i)
      load[static_cast<std::size_t>(s.first) + i] += share * s.value[i];
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

void TrackBeam::support_foot(double x, double stiffness, double damping) {
  const double at = (x - left_) / pitch_;
  const int element = std::clamp(static_cast<int>(at), 0, elements_ - 1);
  const BeamShape::Values foot = foot_shape(at - element);
  add_outer(stiffness_, kPerNode * element, stiffness, foot);
  add_outer(damping_, kPerNode * element, damping, foot);
}

void TrackBeam::hold_foot(double first, double last) {
  constexpr double kRounding = 1e-9;
  const auto node_at = [&](double x) { return std::clamp((x - left_) / pitch_, 0.0, 1.0 * elements_); };
  hold(static_cast<int>(std::lround(node_at(0.5 * (first + last)))), kFoot);
  for (int node = static_cast<int>(std::ceil(node_at(first) - kRounding)); node <= node_at(last) + kRounding;
       ++node)
    hold(node, kFoot);
}

std::vector<double> TrackBeam::static_state(double x, double force) const {
  BandMatrix<double> factor = stiffness_;
  factor.factorise();
  std::vector<double> load = head_load(x);
  for (double& value : load) value *= force;
  return factor.solve(std::move(load));
}

SectionMotion TrackBeam::motion(const std::vector<double>& state, int node) const {
  const auto first = static_cast<std::size_t>(kPerNode * node);
  return {state[first], state[first + 1], state[first + kFoot] + foot_ * state[first + 1]};
}

double TrackBeam::deflection(const std::vector<double>& state, double x) const {
  const Shape s = shape(x);
  double sum = 0;
  for (std::size_t i = 0; i < s.value.size(); ++i)
    sum += s.value[i] * state[static_cast<std::size_t>(s.first) + i];
  return sum;
}

std::complex<double> TrackBeam::receptance(double x_force, double x, double frequency) const {
  const double omega = 2 * std::numbers::pi * frequency;
  BandMatrix<std::complex<double>> factor(stiffness_.size(), kBand);
  factor.add(1.0, stiffness_);
  factor.add({0, omega}, damping_);
  factor.add(-omega * omega, mass_);
  factor.factorise();
  std::vector<std::complex<double>> load(static_cast<std::size_t>(factor.size()));
  const Shape s = shape(x_force);
  for (std::size_t i = 0; i < s.value.size(); ++i) load[static_cast<std::size_t>(s.first) + i] = s.value[i];
  const auto state = factor.solve(std::move(load));
  const Shape t = shape(x);
  std::complex<double> sum;
  for (std::size_t i = 0; i < t.value.size(); ++i)
    sum += t.value[i] * state[static_cast<std::size_t>(t.first) + i];
  return sum;
}

/// Sylvester's law of inertia: K - omega^2 M has as many negative pivots as there are modes below omega.
int TrackBeam::modes_below(double omega) const {
  BandMatrix<double> factor = stiffness_;
  factor.add(-omega * omega, mass_);
  factor.factorise();
  int count = 0;
  for (int i = 0; i < factor.size(); ++i) count += factor.at(i, i) < 0 ? 1 : 0;
  return count;
}

double TrackBeam::eigenfrequency(int n) const {
  double low = 0;
  double high = 1;
  while (modes_below(high) <= n) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (modes_below(middle) <= n ? low : high) = middle;
  }
  return 0.5 * (low + high) / (2 * std::numbers::pi);
}

namespace {

/// The columns of a scene's fastenings as parts of spring-dampers of a whole fastening.
std::vector<BeamSupport> column_supports(const Scene& scene, int more_spans, double stiffness,
                                         double damping) {
  const FasteningSpec& f = *scene.fastenings;
  std::vector<BeamSupport> supports;
  for (int i = -more_spans; i < f.count; ++i)
    for (int column = 0; column < f.columns; ++column)
      supports.push_back({f.position(i) + f.column_offset(column) - scene.rail->origin, stiffness / f.columns,
                          damping / f.columns});
  return supports;
}

}  // namespace

std::vector<BeamSupport> rail_supports(const Scene& scene, int more_spans) {
  if (!scene.rail) throw InputError("a rail beam needs [rail]");
  if (!scene.fastenings) return {};
  return column_supports(scene, more_spans, scene.fastenings->stiffness, scene.fastenings->damping);
}

std::vector<BeamSupport> rail_foot_supports(const Scene& scene, int more_spans) {
  if (!scene.fastenings || scene.fastenings->along.kind != "elastic") return {};
  const FootHold& along = scene.fastenings->along;
  return column_supports(scene, more_spans, along.stiffness, along.damping);
}

std::vector<FootStretch> rail_foot_holds(const Scene& scene, int more_spans) {
  if (!scene.fastenings || scene.fastenings->along.kind != "held") return {};
  const FasteningSpec& f = *scene.fastenings;
  std::vector<FootStretch> holds;
  if (f.held_at == "springs") {
    for (const BeamSupport& s : column_supports(scene, more_spans, 0, 0)) holds.push_back({s.x, s.x});
    return holds;
  }
  for (int i = -more_spans; i < f.count; ++i) {
    const double middle = f.position(i) - scene.rail->origin;
    holds.push_back({middle - 0.5 * f.pad_length, middle + 0.5 * f.pad_length});
  }
  return holds;
}

double head_spread(const Scene& scene, const BeamProperties& properties) {
  if (!scene.fastenings || properties.depth == 0) return 0;
  return head_spread(properties.depth, scene.rail_material().poissons_ratio,
                     2 * std::numbers::pi / scene.fastenings->spacing);
}

TrackBeam rail_beam(const Scene& scene, const BeamProperties& properties, int more_spans) {
  const std::vector<BeamSupport> supports = rail_supports(scene, more_spans);
  const RailSpec& rail = *scene.rail;
  const double more = scene.fastenings ? more_spans * scene.fastenings->spacing : 0;
  TrackBeam beam(properties, -rail.origin - more, rail.length + more, BeamEnds::guided);
  beam.spread_head_load(head_spread(scene, properties));
  for (const BeamSupport& s : supports) beam.support(s.x, s.stiffness, s.damping);
  if (!properties.has_foot()) return beam;
  for (const BeamSupport& s : rail_foot_supports(scene, more_spans))
    beam.support_foot(s.x, s.stiffness, s.damping);
  for (const FootStretch& s : rail_foot_holds(scene, more_spans)) beam.hold_foot(s.first, s.last);
  return beam;
}

BeamPassage::BeamPassage(const TrackBeam& beam, const BeamVehicle& vehicle, double x, double dt)
    : beam_(&beam), vehicle_(vehicle), dt_(dt), factor_(beam.stiffness()) {
  factor_.add(2 / dt, beam.damping());
  factor_.add(4 / (dt * dt), beam.mass());
  factor_.factorise();
  force_ = vehicle.load();
  u_ = beam.static_state(x, force_);
  v_.resize(u_.size());
  a_.resize(u_.size());
  rail_ = dot(beam.head_load(x), u_);
  approach_ = std::pow(force_ / vehicle.contact, 2.0 / 3);
  wheel_[0] = rail_ + approach_;
  if (vehicle.bending)
    wheel_[1] = (vehicle.sprung_mass * vehicle.gravity + vehicle.pressed +
                 vehicle.bending->coupling * vehicle.gravity) /
                vehicle.bending->stiffness;
  wheel_[2] = wheel_[0] + wheel_[1] + vehicle.static_stretch();
  assemble_vehicle();
}

void BeamPassage::add_sprung_mass(double mass) {
  const double before = vehicle_.static_stretch();
  vehicle_.sprung_mass += mass;
  wheel_[2] += vehicle_.static_stretch() - before;
  assemble_vehicle();
}

void BeamPassage::move_sprung_mass(double lower, double faster) {
  wheel_[2] += lower;
  wheel_speed_[2] += faster;
}

double BeamPassage::suspension() const {
  return vehicle_.stiffness * (wheel_[2] - wheel_[0] - wheel_[1]) +
         vehicle_.damping * (wheel_speed_[2] - wheel_speed_[0] - wheel_speed_[1]);
}

void BeamPassage::assemble_vehicle() {
  const BeamVehicle::Bending bending = vehicle_.bending.value_or(BeamVehicle::Bending{});
  vehicle_mass_ = {{{vehicle_.unsprung_mass, bending.coupling, 0},
                    {bending.coupling, bending.mass, 0},
                    {0, 0, vehicle_.sprung_mass}}};
  const Three stretch = {1, vehicle_.bending ? 1.0 : 0.0, -1};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double both = stretch[i] * stretch[j];
      vehicle_damping_[i][j] = vehicle_.damping * both;
      vehicle_system_[i][j] = vehicle_.stiffness * both + 2 / dt_ * vehicle_damping_[i][j] +
                              4 / (dt_ * dt_) * vehicle_mass_[i][j];
    }
  vehicle_system_[1][1] += bending.stiffness;
  // What is not there does not move.
  for (std::size_t i = 0; i < 3; ++i)
    if (vehicle_mass_[i][i] == 0) {
      for (std::size_t j = 0; j < 3; ++j) vehicle_system_[i][j] = vehicle_system_[j][i] = 0;
      vehicle_system_[i][i] = 1;
    }
}

BeamPassage::Three BeamPassage::static_load() const {
  const double g = vehicle_.gravity;
  if (!vehicle_.bending) return {vehicle_.unsprung_mass * g + vehicle_.pressed, 0, vehicle_.sprung_mass * g};
  return {vehicle_.unsprung_mass * g + vehicle_.pressed, vehicle_.bending->coupling * g + vehicle_.pressed,
          vehicle_.sprung_mass * g};
}

namespace {

using Three = std::array<double, 3>;

Three times(const std::array<Three, 3>& matrix, const Three& x) {
  Three y{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) y[i] += matrix[i][j] * x[j];
  return y;
}

/// Solution of a symmetric positive definite system.
Three solve(std::array<Three, 3> a, Three b) {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < 3; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t j = k + 1; j < 3; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// Solves approach + flexibility C approach^1.5 = gap by Newton's method. [m, m/N, N/m^1.5]
double hertz_approach(double gap, double flexibility, double contact, double first_guess) {
  double d = first_guess;
  for (int i = 0; i < 50; ++i) {
    const double root = std::sqrt(std::max(d, 0.0));
    const double change =
        (d + flexibility * contact * root * root * root - gap) / (1 + 1.5 * flexibility * contact * root);
    d -= change;
    if (std::abs(change) < 1e-15) break;
  }
  return d;
}

}  // namespace

void BeamPassage::step(double x, double roughness) {
  const double h1 = 2 / dt_;
  const double h2 = 4 / (dt_ * dt_);
  // Beam without contact, and under a unit force at x.
  const std::size_t n = u_.size();
  std::vector<double> inertia(n), drag(n);
  for (std::size_t i = 0; i < n; ++i) {
    inertia[i] = h2 * u_[i] + 2 * h1 * v_[i] + a_[i];
    drag[i] = h1 * u_[i] + v_[i];
  }
  std::vector<double> load = beam_->mass().times(inertia);
  const std::vector<double> damped = beam_->damping().times(drag);
  for (std::size_t i = 0; i < n; ++i) load[i] += damped[i];
  const std::vector<double> head = beam_->head_load(x);
  std::vector<double> next = factor_.solve(std::move(load));
  const std::vector<double> response = factor_.solve(head);

  // Vehicle without contact, and under a unit force on the wheel.
  Three inertia_of{}, drag_of{};
  for (std::size_t i = 0; i < 3; ++i) {
    inertia_of[i] = h2 * wheel_[i] + 2 * h1 * wheel_speed_[i] + wheel_acceleration_[i];
    drag_of[i] = h1 * wheel_[i] + wheel_speed_[i];
  }
  Three push = static_load();
  const Three accelerated = times(vehicle_mass_, inertia_of);
  const Three dragged = times(vehicle_damping_, drag_of);
  for (std::size_t i = 0; i < 3; ++i) push[i] += accelerated[i] + dragged[i];
  const Three free = solve(vehicle_system_, push);
  const Three pushed = solve(vehicle_system_, {-1, 0, 0});

  // approach = wheel - rail - roughness, both linear in the force.
  const double gap = free[0] - dot(head, next) - roughness;
  const double flexibility = dot(head, response) - pushed[0];
  approach_ = hertz_approach(gap, flexibility, vehicle_.contact, std::max(approach_, 1e-9));
  force_ = vehicle_.contact * std::pow(std::max(approach_, 0.0), 1.5);

  for (std::size_t i = 0; i < n; ++i) {
    next[i] += force_ * response[i];
    const double acceleration = h2 * (next[i] - u_[i]) - 2 * h1 * v_[i] - a_[i];
    v_[i] += 0.5 * dt_ * (a_[i] + acceleration);
    a_[i] = acceleration;
    u_[i] = next[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double moved = free[i] + force_ * pushed[i];
    const double acceleration = h2 * (moved - wheel_[i]) - 2 * h1 * wheel_speed_[i] - wheel_acceleration_[i];
    wheel_speed_[i] += 0.5 * dt_ * (wheel_acceleration_[i] + acceleration);
    wheel_acceleration_[i] = acceleration;
    wheel_[i] = moved;
  }
  rail_ = dot(head, u_);
  time_ += dt_;
}

}  // namespace tread
