#include "kernels/device/device_contact.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/contract.hpp"
#include "core/index.hpp"
#include "kernels/device/patch_links.hpp"

namespace tread {

/// Largest numbers of a step.
struct DeviceContact::Sizes {
  std::size_t candidates, faces, places, nodes;

  explicit Sizes(const Contact& contact) {
    const ContactSearch& search = contact.searching();
    const auto [first, last] = search.edges();
    faces = search.window_capacity() * index(last - first);
    candidates = faces * index(search.quadrature().size());
    places = kCellNodes * (faces + candidates);  // a point has a wheel's cell of its own at most
    const SurfacePair& surfaces = search.surfaces();
    nodes = index(surfaces.rail().station_count()) * index(surfaces.rail_profile().edges() + 1) +
            index(surfaces.wheel().station_count()) * index(surfaces.wheel_profile().edges() + 1);
    nodes = std::min(nodes, places);
  }
};

namespace {

std::int64_t bytes_of(const MonotoneCubicView& line) {
  return 3 * line.places * static_cast<std::int64_t>(sizeof(double));
}

std::int64_t bytes_of(const PlacedDepth& depth) {
  std::int64_t sum = depth.shape.rows * static_cast<std::int64_t>(sizeof(MonotoneCubicView) + sizeof(double));
  for (int row = 0; row < depth.shape.rows; ++row) sum += bytes_of(depth.shape.line[row]);
  return sum;
}

std::int64_t bytes_of(const RunningSurfaceView& surface) {
  std::int64_t sum = surface.shapes * static_cast<std::int64_t>(sizeof(PlacedDepth));
  for (int i = 0; i < surface.shapes; ++i) sum += bytes_of(surface.shape[i]);
  return sum;
}

std::int64_t bytes_of(const SurfaceDepths& depths) {
  return bytes_of(depths.corrugation.curve) + bytes_of(depths.corrugation.map) + bytes_of(depths.rail_depth) +
         bytes_of(depths.wheel_depth);
}

}  // namespace

template <class T>
T* DeviceContact::room(std::size_t count) {
  const auto array = std::make_shared<DeviceArray<T>>(*device_, count);
  kept_.push_back(array);
  return array->data();
}

template <class T>
const T* DeviceContact::keep(std::span<const T> values) {
  T* const to = room<T>(values.size());
  if (!values.empty()) device_->upload(to, values.data(), values.size_bytes());
  return to;
}

DeviceContact::DeviceContact(Device& device, Contact& contact, const double* mass)
    : device_(&device), contact_(&contact), law_(contact.options().friction) {
  const ContactSearch& search = contact.searching();
  const SurfacePair& surfaces = search.surfaces();
  task_.surfaces.rail_side = side(surfaces.rail(), surfaces.rail_profile(), surfaces.rail_stations());
  task_.surfaces.wheel_side = side(surfaces.wheel(), surfaces.wheel_profile(), surfaces.wheel_stations());
  task_.surfaces.kind = surfaces.kind();
  task_.surfaces.kind_across = surfaces.kind_across();
  task_.surfaces.depths = depths(contact.surfaces().depths());
  std::vector<FaceQuadrature::Point> quadrature;
  quadrature.reserve(index(search.quadrature().size()));
  for (int k = 0; k < search.quadrature().size(); ++k) quadrature.push_back(search.quadrature().point(k));
  task_.quadrature = keep(quadrature);
  task_.springs = contact.springs_of_points();
  task_.end = search.end();
  task_.mass = mass;
  task_.window.rail_edges = surfaces.rail_profile().edges();
  task_.window.points = search.quadrature().size();
  keep_law();
  make_room();
}

SurfaceSide DeviceContact::side(const SweptBlock& block, const SurfaceProfile& profile,
                                const StationFinder& stations) {
  SurfaceSide side{stations.line(), profile.view(), keep(block.section.p), keep(block.section.q)};
  StationLine& line = side.stations;
  line.stations = keep(block.stations);
  line.pitches = keep(std::span(line.pitches, index(line.count)));
  line.bucket = keep(std::span(line.bucket, index(line.buckets)));
  line.slot = keep(std::span(line.slot, index(line.count)));
  side.profile.edge = keep(std::span(side.profile.edge, index(side.profile.edges)));
  side.profile.bucket = keep(std::span(side.profile.bucket, index(side.profile.buckets)));
  return side;
}

MonotoneCubicView DeviceContact::line(MonotoneCubicView view) {
  const auto places = index(view.places);
  view.x = keep(std::span(view.x, places));
  view.y = keep(std::span(view.y, places));
  view.slope = keep(std::span(view.slope, places));
  return view;
}

PlacedDepth DeviceContact::placed(PlacedDepth depth) {
  DepthShapeView& shape = depth.shape;
  std::vector<MonotoneCubicView> lines;
  lines.reserve(index(shape.rows));
  for (int row = 0; row < shape.rows; ++row) lines.push_back(line(shape.line[row]));
  shape.line = keep(lines);
  shape.y = keep(std::span(shape.y, index(shape.rows)));
  return depth;
}

RunningSurfaceView DeviceContact::surface(RunningSurfaceView view) {
  std::vector<PlacedDepth> shapes;
  shapes.reserve(index(view.shapes));
  for (int i = 0; i < view.shapes; ++i) shapes.push_back(placed(view.shape[i]));
  view.shape = keep(shapes);
  return view;
}

SurfaceDepths DeviceContact::depths(SurfaceDepths depths) {
  depths.corrugation.curve = line(depths.corrugation.curve);
  depths.corrugation.map = placed(depths.corrugation.map);
  depths.rail_depth = surface(depths.rail_depth);
  depths.wheel_depth = surface(depths.wheel_depth);
  return depths;
}

/// Room for the law's states, and copies of its arrays.
void DeviceContact::keep_law() {
  const auto keep_values = [this](const double* values, int count) {
    return keep(std::span(values, index(count)));
  };
  std::visit([&](auto& law) { law.keep_arrays(keep_values); }, law_);
  std::visit(
      [&](const auto& of) {
        using State = typename std::decay_t<decltype(of.law)>::State;
        law_state_bytes_ = of.state.size() * sizeof(State);
        if (law_state_bytes_ > 0) law_state_ = room<State>(of.state.size());
      },
      contact_->friction());
}

void DeviceContact::make_room() {
  const Sizes most(*contact_);
  const std::size_t points = most.candidates;
  points_ = HostArray<ContactPoint>(*device_, points);
  result_ = HostArray<PatchResult>(*device_, 1);
  task_.history = room<PointHistory>(contact_->history().size());
  task_.wake_time = room<double>(contact_->searching().wake_time().size());
  for (Candidates& of : candidates_)
    of = {room<ContactPoint>(points), room<int>(points), room<double>(points), room<int>(points)};
  task_.point = room<ContactPoint>(points);
  const auto table = index(table_size(static_cast<int>(most.places)));
  const std::size_t entries = 2 * points;
  task_.links = {room<int>(entries),
                 room<int>(entries + 1),
                 room<int>(entries),
                 room<int>(most.places),
                 room<PatchNode>(most.nodes),
                 room<double>(most.nodes),
                 room<int>(most.nodes + 1),
                 room<int>(most.places),
                 room<int>(table),
                 room<int>(table),
                 room<int>(table),
                 room<int>(most.places),
                 room<int>(entries),
                 room<int>(most.places),
                 room<int>(most.places),
                 room<int>(most.places)};
  task_.counts = room<PatchCounts>(1);
  // The runs of teams may be longer by one point or node each.
  const std::size_t points_of_teams = points + kMostTeams;
  const std::size_t nodes_of_teams = most.nodes + kMostTeams;
  task_.vectors = {room<TeamSupport>(2 * points),
                   room<NodeItem>(kCellNodes * entries),
                   room<int>(most.nodes + 1),
                   room<int>(most.places),
                   room<double>(3 * points),
                   room<double>(3 * most.nodes),
                   room<double>(kPartStride * nodes_of_teams),
                   room<double>(6 * points_of_teams),
                   room<TeamTile>(points_of_teams / kLanes + kMostTeams),
                   room<PointOutcome>(points),
                   room<double>(kPatchParts * PointOutcome::kSums)};
  const SurfaceGrid& grid = contact_->nodes().grid();
  task_.record = {room<double>(grid.nodes()), room<double>(grid.nodes()), room<double>(grid.nodes()),
                  keep(grid.length),          keep(grid.width),           grid.rows(),
                  room<int>(most.faces + 1)};
  task_.result = room<PatchResult>(1);
}

/// Histories and record to the device.
void DeviceContact::send() {
  if (sent_) return;
  device_->after(kSearchQueue);
  const auto copy = [&](auto* to, const auto& from) {
    if (!from.empty()) device_->upload(to, from.data(), from.size() * sizeof(from[0]));
  };
  copy(task_.history, contact_->history());
  copy(task_.wake_time, contact_->searching().wake_time());
  std::visit([&](const auto& of) { copy(static_cast<char*>(law_state_), of.state); }, contact_->friction());
  record_ = contact_->record();
  if (record_ != nullptr) {
    const SurfaceFields::StepFields fields = record_->step_fields();
    copy(task_.record.max_pressure, fields.max_pressure);
    copy(task_.record.max_shear, fields.max_shear);
    copy(task_.record.frictional_work, fields.frictional_work);
  }
  sent_ = true;
}

void DeviceContact::find(NodeField displacement, NodeField velocity, const Instant& at,
                         const ContactSearch::Aim& aim) {
  const ContactSearch& search = contact_->searching();
  const auto [first_edge, last_edge] = search.edges();
  task_.window.first_station = aim.first_station;
  task_.window.stations = aim.last_station - aim.first_station;
  task_.window.first_edge = first_edge;
  task_.window.edges = last_edge - first_edge;
  task_.bounds = search.bounds(aim, at.time);
  task_.dt = at.dt;
  task_.wheel = at.wheel;
  task_.u = displacement;
  task_.v = velocity;
  task_.candidates = candidates_[1 - solved_];
  const Beside beside(*device_, kSearchQueue);
  device_->after(kPatchQueue);
  device_->search(task_);
  device_->after(kRecordQueue);
  device_->find_patch(task_);
}

void DeviceContact::search(NodeField displacement, NodeField velocity, const Instant& at) {
  searched_ = true;
  if (std::exchange(ahead_, std::nullopt) == at) return;
  send();
  find(displacement, velocity, at, contact_->searching().aimed());
}

void DeviceContact::search_ahead(NodeField displacement, NodeField velocity, const Instant& at) {
  const auto aim = contact_->searching().aim_at(at.wheel, at.dt);
  if (!aim) return;
  find(displacement, velocity, at, *aim);
  ahead_ = at;
}

void DeviceContact::start(NodeField displacement, NodeField velocity) {
  if (!std::exchange(searched_, false)) return;
  task_.u = displacement;
  task_.v = velocity;
  solved_ = 1 - solved_;
  {
    const Beside beside(*device_, kPatchQueue);
    device_->after(kSearchQueue);
    device_->resolve(task_, law_, law_state_);
  }
  const Beside beside(*device_, kRecordQueue);
  device_->after(kPatchQueue);
  device_->record(task_);
  device_->start_download(result_.data(), task_.result, sizeof(PatchResult));
}

void DeviceContact::resolve() {
  device_->finish(kRecordQueue);
  const PatchResult& result = *result_.data();
  contact_->take({result.force_on_rail, result.frictional_work, result.contact_loss, result.unsettled});
  if (result.at_the_end != 0) fetch_points();
}

void DeviceContact::fetch_points() {
  TREAD_EXPECT(!searched_);
  const int count = result_.data()->points;
  if (count > 0) {
    ContactTask solved = task_;
    solved.candidates = candidates_[solved_];
    device_->gather(solved, count);
    device_->download(points_.data(), task_.point, index(count) * sizeof(ContactPoint));
  }
  contact_->take_points({points_.data(), index(count)});
}

void DeviceContact::fetch_record() {
  if (!sent_ || record_ == nullptr) return;
  const auto copy = [&](PageVector<double>& to, const double* from) {
    device_->download(to.data(), from, to.size() * sizeof(double));
  };
  const SurfaceFields::StepFields fields = record_->step_fields();
  copy(fields.max_pressure, task_.record.max_pressure);
  copy(fields.max_shear, task_.record.max_shear);
  copy(fields.frictional_work, task_.record.frictional_work);
}

void DeviceContact::release() {
  if (!sent_) return;
  fetch_record();
  const auto copy = [&](auto& to, const auto* from) {
    if (!to.empty()) device_->download(to.data(), from, to.size() * sizeof(to[0]));
  };
  forget();
  copy(contact_->history(), task_.history);
  copy(contact_->searching().wake_time(), task_.wake_time);
  std::visit([&](auto& of) { copy(of.state, static_cast<const char*>(law_state_)); }, contact_->friction());
  sent_ = false;
}

std::int64_t DeviceContact::bytes(const Contact& contact) {
  const Sizes most(contact);
  const std::size_t of_point = 3 * sizeof(ContactPoint) + sizeof(TeamTile) / kLanes +
                               2 * sizeof(TeamSupport) + 2 * kCellNodes * sizeof(NodeItem) +
                               sizeof(PointOutcome) + 11 * sizeof(double) + 12 * sizeof(int);
  const std::size_t of_node = sizeof(PatchNode) + (4 + kPartStride) * sizeof(double) + 2 * sizeof(int);
  const auto table = index(table_size(static_cast<int>(most.places)));
  const std::size_t ints = 3 * table + 7 * most.places;
  return static_cast<std::int64_t>(most.candidates * of_point + most.nodes * of_node + ints * sizeof(int)) +
         contact.bytes() + bytes_of(contact.surfaces().depths());
}

}  // namespace tread
