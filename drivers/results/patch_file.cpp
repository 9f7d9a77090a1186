#include "drivers/results/patch_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/math/interpolation.hpp"

namespace tread {

namespace {

std::string dataset(const PatchField& field) {
  return std::string("/") + field.name;
}

void describe(Hdf5File& file, const std::string& name, const std::string& unit,
              const std::string& description) {
  file.write_attribute(name, "unit", unit);
  file.write_attribute(name, "description", description);
}

}  // namespace

const std::vector<PatchField>& patch_fields() {
  static const std::vector<PatchField> fields = {
      {"pressure", "Pa", "contact pressure", [](const NodalContact& n) { return n.pressure; }},
      {"shear_along", "Pa", "surface shear stress on the rail, forwards",
       [](const NodalContact& n) { return n.shear.along; }},
      {"shear_across", "Pa", "surface shear stress on the rail, to the field side",
       [](const NodalContact& n) { return n.shear.across; }},
      {"slip_along", "m/s", "micro-slip of the wheel against the rail, forwards",
       [](const NodalContact& n) { return n.slip_speed.along; }},
      {"slip_across", "m/s", "micro-slip of the wheel against the rail, to the field side",
       [](const NodalContact& n) { return n.slip_speed.across; }},
  };
  return fields;
}

PatchFile::PatchFile(const std::filesystem::path& path, const PatchNodes& nodes,
                     const Hdf5Attributes& attributes)
    : file_(Hdf5File::create(path)), fields_(patch_fields().size()) {
  file_.set_attributes("/", attributes);
  const SurfaceGrid& grid = nodes.grid();
  file_.write<double>("/x", grid.x);
  describe(file_, "/x", "m", "stations of the rail's surface, along the rail");
  file_.write<double>("/y", grid.y);
  describe(file_, "/y", "m", "rows of the rail's surface, across the rail, field side positive");
  file_.make_extendible<double>("/time", kBlock);
  describe(file_, "/time", "s", "since the start of rolling");
  file_.make_extendible<double>("/wheel_x", kBlock);
  describe(file_, "/wheel_x", "m", "position of the wheel's axis along the rail");
  file_.make_extendible<std::int32_t>("/first_station", kBlock);
  describe(file_, "/first_station", "-", "place in /x of the window's first station");
  const std::vector<std::uint64_t> window = {static_cast<std::uint64_t>(nodes.capacity()), grid.y.size()};
  for (const PatchField& field : patch_fields()) {
    file_.make_extendible<float>(dataset(field), kBlock, window, Hdf5File::Storage::compressed);
    describe(file_, dataset(field), field.unit, std::string(field.description) + ", average at the node");
  }
  file_.make_extendible<std::uint8_t>("/state", kBlock, window, Hdf5File::Storage::compressed);
  describe(file_, "/state", "-", "0 out of contact, 1 sticks, 2 slips");
  file_.flush();
}

PatchFile::PatchFile(const std::filesystem::path& path, const PatchNodes& nodes,
                     const Hdf5Attributes& attributes, std::size_t samples)
    : file_(Hdf5File::open_to_extend(path)), fields_(patch_fields().size()) {
  const std::vector<std::uint64_t> expected = {samples, static_cast<std::uint64_t>(nodes.capacity()),
                                               nodes.grid().y.size()};
  if (file_.shape("/state") != expected || file_.shape("/time") != std::vector<std::uint64_t>{samples})
    throw InputError(fmt::format("{} does not hold {} samples of this scene", path.string(), samples));
  file_.set_attributes("/", attributes);
  file_.flush();
}

PatchFile::~PatchFile() {
  try {
    close();
  } catch (...) {  // a destructor cannot report errors
  }
}

void PatchFile::append(double time, double wheel_x, const PatchNodes& nodes) {
  time_.push_back(time);
  wheel_x_.push_back(wheel_x);
  first_.push_back(nodes.first());
  for (int i = 0; i < nodes.capacity(); ++i)
    for (int row = 0; row < nodes.grid().rows(); ++row) {
      const int station = nodes.first() + i;
      const NodalContact node = station <= nodes.last() ? nodes.at(station, row) : NodalContact{};
      for (std::size_t f = 0; f < fields_.size(); ++f)
        fields_[f].push_back(static_cast<float>(patch_fields()[f].value(node)));
      state_.push_back(static_cast<std::uint8_t>(state_of(node)));
    }
  if (time_.size() >= kBlock) flush();
}

void PatchFile::flush() {
  if (time_.empty()) return;
  const bool open = std::exchange(open_, false);  // nothing more is written after an error
  file_.append<double>("/time", std::exchange(time_, {}));
  file_.append<double>("/wheel_x", std::exchange(wheel_x_, {}));
  file_.append<std::int32_t>("/first_station", std::exchange(first_, {}));
  for (std::size_t f = 0; f < fields_.size(); ++f)
    file_.append<float>(dataset(patch_fields()[f]), std::exchange(fields_[f], {}));
  file_.append<std::uint8_t>("/state", std::exchange(state_, {}));
  file_.flush();
  open_ = open;
}

void PatchFile::close() {
  if (!open_) return;
  flush();
  open_ = false;
  file_.close();
}

std::int64_t PatchFile::sample_bytes(const PatchNodes& nodes) {
  const auto window = static_cast<std::int64_t>(nodes.capacity()) * nodes.grid().rows();
  return window * static_cast<std::int64_t>(patch_fields().size() * sizeof(float) + 1);
}

double PatchWindow::x(int i) const {
  return axes_.x[std::min(static_cast<std::size_t>(sample_.first + i), axes_.x.size() - 1)];
}

double PatchWindow::shear(int i, int row) const {
  return std::hypot(value(1, i, row), value(2, i, row));
}

double PatchWindow::slip_speed(int i, int row) const {
  return std::hypot(value(3, i, row), value(4, i, row));
}

PatchAxes read_patch_axes(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  PatchAxes axes{file.read<double>("/x"), file.read<double>("/y")};
  if (axes.x.empty() || axes.y.empty())
    throw InputError(fmt::format("{} holds no surface: run the scene again", path.string()));
  return axes;
}

std::vector<PatchSample> read_patch(const std::filesystem::path& path, const std::vector<double>& places) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  const std::vector<double> time = file.read<double>("/time");
  const std::vector<double> wheel_x = file.read<double>("/wheel_x");
  const std::vector<std::int32_t> station = file.read<std::int32_t>("/first_station");
  const auto foreign = [&] {
    return InputError(fmt::format("{}: its fields have not the same samples and nodes; run the scene again",
                                  path.string()));
  };
  if (time.size() != wheel_x.size() || station.size() != wheel_x.size()) throw foreign();
  std::vector<PatchSample> samples;
  std::size_t before = wheel_x.size();
  for (const double place : places) {
    const std::size_t at = nearest(wheel_x, place);
    if (std::exchange(before, at) == at) continue;  // also if there are no samples
    PatchSample sample{time[at], wheel_x[at], station[at], {}, {}};
    for (const PatchField& field : patch_fields()) {
      const std::vector<float> values = file.read_row<float>(dataset(field), at);
      sample.fields.insert(sample.fields.end(), values.begin(), values.end());
    }
    sample.state = file.read_row<std::uint8_t>("/state", at);
    if (sample.fields.size() != patch_fields().size() * sample.state.size()) throw foreign();
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace tread
