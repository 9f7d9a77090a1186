#include "drivers/results/frame_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/results/root_attributes.hpp"
#include "io/files/output_file.hpp"
#include "io/files/step_files.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "frames";
constexpr const char* kSeries = "frames.hdf.series";
constexpr std::string_view kSuffix = ".hdf";

/// Name of the mesh file beside its frames. A run may go on with other cells: older frames keep their mesh.
const char* mesh_name(VtkCells kind) {
  return kind == VtkCells::faces ? "mesh-faces.hdf" : "mesh-elements.hdf";
}

/// Row of the contact's surface grid at a node of the rail's section, and the tangent across the surface
/// there.
struct SurfaceRow {
  int row = -1;  ///< -1: none
  Vec3 across;   ///< unit vector to the field side
};

std::vector<SurfaceRow> rows_of_nodes(const Section& section, const SurfaceGrid& grid) {
  std::vector<SurfaceRow> rows(static_cast<std::size_t>(section.nodes()));
  for (int row = 0; row < grid.rows(); ++row) {
    const bool last = row + 1 == grid.rows();
    const SurfaceEdge& edge =
        section.surface[static_cast<std::size_t>(grid.first_edge + row - (last ? 1 : 0))];
    const auto [y, z] = edge.tangent[last ? 1 : 0];
    rows[static_cast<std::size_t>(edge.node[last ? 1 : 0])] = {row, {0, y, z}};
  }
  return rows;
}

void append(std::vector<float>& values, const Vec3& vector) {
  for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(vector[i]));
}

/// Slot of a point's node and the axes of its vectors.
struct PointBasis {
  std::int64_t slot;
  bool spins;
  double angle;  ///< of its station [rad]

  PointBasis(const Mesh& mesh, const VtkGrid::Point& point) {
    if (const HexBody* body = mesh.body_of(point.block)) {
      slot = body->slot(point.node);
      spins = body->spins;
      angle = kCartesianAngle;
      return;
    }
    const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(point.block)];
    slot = block.base + block.slot(point.node, point.station);
    spins = block.sweep == Sweep::revolved;
    angle = spins ? block.stations[static_cast<std::size_t>(point.station)] : 0;
  }
  /// `frame`: angle of the wheel's frame [rad].
  Vec3 turned(const Vec3& value, double frame) const {
    return spins ? cylindrical_to_cartesian(angle + frame, value) : value;
  }
};

template <class Real>
Vec3 local_vector(const FieldCopy<Real>& field, std::int64_t slot) {
  Vec3 value;
  for (int i = 0; i < 3; ++i) value[i] = static_cast<double>(field[static_cast<std::size_t>(dof(slot, i))]);
  return value;
}

}  // namespace

template <class Real>
void FieldCopy<Real>::take(ConstNodeField from, std::int64_t slots) {
  const std::int64_t n = 3 * slots;
  values_ = std::make_unique_for_overwrite<Real[]>(static_cast<std::size_t>(n));
  parallel_ranges(n, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      values_[static_cast<std::size_t>(i)] = static_cast<Real>(from[i]);
  });
}

std::vector<Placement> resting_places(const Model& model) {
  std::vector<Placement> places(static_cast<std::size_t>(model.mesh.parts()));
  const double height = model.contact ? model.contact->touching_height() : 0;
  for (const int b : model.wheel_parts())
    places[static_cast<std::size_t>(b)].origin = {model.scene.start_x(), 0, height};
  return places;
}

VtkCells frame_cells(const Scene& scene) {
  return scene.output.frame_cells == "faces" ? VtkCells::faces : VtkCells::elements;
}

FrameBytes frame_bytes(const VtkGrid& grid) {
  constexpr std::int64_t kOfPoint =
      (3 + 3 + 3) * sizeof(float);  // place, displacement, velocity; contact fields vanish when compressed
  constexpr std::int64_t kOfCell = sizeof(float);  // stress
  constexpr std::int64_t kOfMeshPoint = 3 * sizeof(double);
  constexpr std::int64_t kOfMeshCell = 8 + 1 + 4 + 4 + 8;  // offset, type, block, material, pitch
  constexpr std::int64_t kTree = 10000;                    // groups, names, links
  const auto points = static_cast<std::int64_t>(grid.points.size());
  const auto cells = static_cast<std::int64_t>(grid.cells.size());
  const auto corners = static_cast<std::int64_t>(grid.connectivity.size() * sizeof(std::int64_t));
  return {kOfPoint * points + kOfCell * cells + kTree,
          kOfMeshPoint * points + kOfMeshCell * cells + corners + kTree};
}

std::vector<std::int64_t> frame_steps(int count, std::int64_t steps) {
  std::vector<std::int64_t> due;
  for (int i = 1; i <= count; ++i) {
    const std::int64_t step = i == count ? steps : 1 + (steps - 1) * (i - 1) / (count - 1);
    if (step >= 1 && step <= steps && (due.empty() || step > due.back())) due.push_back(step);
  }
  return due;
}

FrameFiles::FrameFiles(const Model& model, fs::path directory, std::int64_t steps, double dt,
                       std::int64_t reached)
    : model_(&model),
      directory_(std::move(directory)),
      dt_(dt),
      due_(frame_steps(model.scene.output.frames, steps)) {
  remove_parts(folder());
  remove_later(reached, steps);
  for (const std::int64_t step : steps_in(folder(), kSuffix))
    if (!begins_as_hdf5(step_file(folder(), step, kSuffix))) damaged_.push_back(step);
  const std::vector<std::int64_t> frames = there();
  std::erase_if(due_,
                [&](std::int64_t step) { return std::binary_search(frames.begin(), frames.end(), step); });
  std::error_code ignored;
  if (!frames.empty() || !damaged_.empty())
    write_series();
  else
    fs::remove(directory_ / kSeries, ignored);
}

void FrameFiles::remove_later(std::int64_t reached, std::int64_t end) const {
  std::error_code ignored;
  for (const std::int64_t step : steps_in(folder(), kSuffix))
    if (step > end || (step > reached && due(step))) fs::remove(step_file(folder(), step, kSuffix), ignored);
}

std::vector<std::int64_t> FrameFiles::there() const {
  std::vector<std::int64_t> steps = steps_in(folder(), kSuffix);
  std::erase_if(
      steps, [&](std::int64_t step) { return std::binary_search(damaged_.begin(), damaged_.end(), step); });
  return steps;
}

std::vector<std::string> FrameFiles::gaps(std::int64_t steps) const {
  std::vector<std::string> texts;
  for (const std::int64_t step : damaged_)
    texts.push_back(fmt::format("{}: it is no HDF5 file, so {} leaves it out; remove it",
                                step_file(folder(), step, kSuffix).string(),
                                (directory_ / kSeries).string()));
  if (const auto lacking = std::upper_bound(due_.begin(), due_.end(), steps) - due_.begin(); lacking > 0)
    texts.push_back(fmt::format(
        "{}: {} of the frames up to step {} are not there, and this run writes only later ones; start the "
        "run anew for all",
        folder().string(), lacking, steps));
  return texts;
}

fs::path FrameFiles::folder() const {
  return directory_ / kFolder;
}

bool FrameFiles::due(std::int64_t steps) const {
  return std::binary_search(due_.begin(), due_.end(), steps);
}

std::size_t FrameFiles::count() const {
  return there().size();
}

void FrameFiles::copy(const Simulation& simulation) {
  at_.steps = simulation.steps();
  at_.time = simulation.time();
  const std::int64_t slots = model_->mesh.slots;
  at_.displacement.take(simulation.displacement(), slots);
  at_.velocity.take(simulation.velocity(), slots);
  if (const ConstNodeField lag = simulation.fields().lag()) at_.lag.take(lag, slots);
  if (const ConstLawState laws = simulation.fields().laws()) {
    if (!at_.laws) at_.laws.emplace(model_->mesh);
    at_.laws->copy(laws);
  }
  at_.wheel = simulation.wheel();
  if (model_->contact) at_.patch = model_->contact->nodes();
  std::erase(damaged_, at_.steps);  // not in write(), beside which count() reads them
}

void FrameFiles::begin() {
  if (std::exchange(begun_, true)) return;
  create_folder(folder());
  grid_ = make_vtk_grid(model_->mesh, frame_cells(model_->scene));
  write_vtk_mesh(folder() / mesh_name(grid_.kind), model_->mesh, grid_, resting_places(*model_),
                 root_attributes(model_->scene));
}

void FrameFiles::write() {
  write_copy();
  at_ = {};  // frees a field or two as large as the run's own
}

void FrameFiles::write_copy() {
  begin();
  places_.assign(static_cast<std::size_t>(model_->mesh.parts()), {});
  for (const int block : model_->wheel_parts())
    places_[static_cast<std::size_t>(block)] = {at_.wheel.origin, at_.wheel.angle};
  write_vtk_frame(step_file(folder(), at_.steps, kSuffix),
                  {mesh_name(grid_.kind), at_.time, points(), arrays(), root_attributes(model_->scene)});
  write_series();
}

void FrameFiles::write_series() const {
  Json files = Json::array();
  for (const std::int64_t steps : there())
    files.push_back(
        {{"name", step_file(kFolder, steps, kSuffix).string()}, {"time", static_cast<double>(steps) * dt_}});
  write_text_file(directory_ / kSeries, json_text({{"file-series-version", "1.0"}, {"files", files}}));
}

std::vector<float> FrameFiles::points() const {
  std::vector<float> values;
  values.reserve(3 * grid_.points.size());
  for (const VtkGrid::Point& point : grid_.points)
    append(values, placed(places_[static_cast<std::size_t>(point.block)], position(model_->mesh, point)));
  return values;
}

/// Arrays in Cartesian axes; velocities include the rigid motion of the wheel's frame.
std::vector<VtkArray> FrameFiles::arrays() const {
  VtkArray displacement{
      "displacement [m]", "m", "from the points, which move rigidly with their body", 3, false, {}};
  VtkArray velocity{"velocity [m s-1]", "m/s", "half a step before the frame's time", 3, false, {}};
  displacement.values.reserve(3 * grid_.points.size());
  velocity.values.reserve(3 * grid_.points.size());
  for (const VtkGrid::Point& point : grid_.points) {
    const Placement& place = places_[static_cast<std::size_t>(point.block)];
    const PointBasis basis(model_->mesh, point);
    const Vec3 u = basis.turned(local_vector(at_.displacement, basis.slot), place.angle);
    Vec3 v = basis.turned(local_vector(at_.velocity, basis.slot), place.angle);
    if (basis.spins) {
      const Vec3 arm = placed({{}, place.angle}, position(model_->mesh, point)) + u;
      v += at_.wheel.velocity + at_.wheel.spin * Vec3{arm.z, 0, -arm.x};
    }
    append(displacement.values, u);
    append(velocity.values, v);
  }
  std::vector<VtkArray> all = contact_arrays();
  all.insert(all.begin(), {std::move(displacement), std::move(velocity)});
  all.push_back(von_mises_stress());
  return all;
}

/// Pressure, shear stress and slip of the contact on the rail's running surface; zero elsewhere.
std::vector<VtkArray> FrameFiles::contact_arrays() const {
  std::vector<VtkArray> arrays = {
      {"contact pressure [Pa]", "Pa", "on the rail's running surface, average at the node", 1, false, {}},
      {"contact shear stress [Pa]", "Pa", "on the rail, average at the node", 3, false, {}},
      {"slip velocity [m s-1]",
       "m/s",
       "of the wheel against the rail, mean of the touching points",
       3,
       false,
       {}}};
  for (VtkArray& array : arrays)
    array.values.assign(grid_.points.size() * static_cast<std::size_t>(array.components), 0.0F);
  if (!model_->contact) return arrays;
  const int rail = model_->contact->options().rail_block;
  const Section& section = model_->mesh.blocks[static_cast<std::size_t>(rail)].section;
  const std::vector<SurfaceRow> rows = rows_of_nodes(section, at_.patch.grid());
  const auto put = [](VtkArray& array, std::size_t point, const Vec3& value) {
    for (int i = 0; i < 3; ++i)
      array.values[3 * point + static_cast<std::size_t>(i)] = static_cast<float>(value[i]);
  };
  for (std::size_t i = 0; i < grid_.points.size(); ++i) {
    const auto [block, node, station] = grid_.points[i];
    if (block != rail || station < at_.patch.first() || station > at_.patch.last()) continue;
    const auto& [row, across] = rows[static_cast<std::size_t>(node)];
    if (row < 0) continue;
    const NodalContact& at = at_.patch.at(station, row);
    arrays[0].values[i] = static_cast<float>(at.pressure);
    put(arrays[1], i, at.shear.along * Vec3{1, 0, 0} + at.shear.across * across);
    put(arrays[2], i, at.slip_speed.along * Vec3{1, 0, 0} + at.slip_speed.across * across);
  }
  return arrays;
}

VtkArray FrameFiles::von_mises_stress() const {
  VtkArray array{"von Mises stress [Pa]", "Pa", "at the element's centre", 1, true, {}};
  array.values.reserve(grid_.cells.size());
  const ConstNodeField lag = at_.lag.data();
  const ConstLawState laws = at_.laws ? ConstLawState(*at_.laws) : nullptr;
  const ConstNodeField u = at_.displacement.data();
  for (const VtkGrid::Cell& cell : grid_.cells) {
    const BodyForce* body = model_->body_force_of(cell.block);
    const std::array<double, 6> stress =
        body != nullptr ? body->stress(static_cast<std::size_t>(cell.quad), u, lag)
                        : model_->internal->stress(cell.block, cell.quad, cell.station, u, lag, laws);
    array.values.push_back(static_cast<float>(von_mises(stress)));
  }
  return array;
}

void FrameFiles::take_over(const fs::path& from, const fs::path& to, std::int64_t steps) {
  const std::vector<std::int64_t> there = steps_in(from / kFolder, kSuffix);
  if (there.empty() || there.front() > steps) return;
  create_folder(to / kFolder);
  const auto copy = [&](const fs::path& file) {
    const fs::path target = to / kFolder / file.filename();
    replace_file(target, [&](const fs::path& part) {
      std::error_code error;
      fs::copy_file(file, part, fs::copy_options::overwrite_existing, error);
      if (error)
        throw ResourceError(fmt::format("cannot copy {} to {}: {}; --set output.frames=0 leaves frames out",
                                        file.string(), target.string(), error.message()));
    });
  };
  for (const VtkCells kind : {VtkCells::faces, VtkCells::elements})
    if (fs::exists(from / kFolder / mesh_name(kind))) copy(from / kFolder / mesh_name(kind));
  for (const std::int64_t step : there)
    if (step <= steps) copy(step_file(from / kFolder, step, kSuffix));
}

void FrameFiles::remove(const fs::path& directory) {
  std::error_code ignored;
  fs::remove(directory / kSeries, ignored);  // first: it lists the others
  const fs::path folder = directory / kFolder;
  for (const std::int64_t steps : steps_in(folder, kSuffix))
    fs::remove(step_file(folder, steps, kSuffix), ignored);
  for (const VtkCells kind : {VtkCells::faces, VtkCells::elements})
    fs::remove(folder / mesh_name(kind), ignored);
  remove_parts(folder);
  fs::remove(folder, ignored);
}

}  // namespace tread
