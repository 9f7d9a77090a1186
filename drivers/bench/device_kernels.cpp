#include "drivers/bench/device_kernels.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>

#include "core/parallel/parallel.hpp"
#include "drivers/bench/made_up_blocks.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/device/block_march.hpp"

namespace tread {

namespace {

constexpr std::int64_t kTriadValues = std::int64_t{1} << 24;  ///< of an array, beyond the caches of cards too

/// A block on the device, with the fields before and after a step.
template <class Real, class U>
class MarchedBlock {
 public:
  MarchedBlock(Device& device, const ElementVariant& variant, std::int64_t elements)
      : device_(&device),
        mesh_(mesh_of(variant, elements)),
        internal_(mesh_),
        march_(device, internal_.elements(0), variant.damped ? kDampedBeta : 0, {}),
        u_(copy(made_up_field<U>(mesh_, 1e-5))),
        v_(copy(made_up_field<Real>(mesh_, 0.1))),
        moved_u_(device, u_.size()),
        moved_v_(device, v_.size()),
        inverse_mass_(copy(AlignedVector<Real>(static_cast<std::size_t>(mesh_.slots), Real(1e5)))),
        group_mark_(copy(AlignedVector<int>(static_cast<std::size_t>(mesh_.slots / kLanes), kMoves))) {
    fields_.u = u_.data();
    fields_.v = v_.data();
    if (variant.damped) fields_.added = v_.data();
    fields_.inverse_mass = inverse_mass_.data();
    fields_.moved_u = moved_u_.data();
    fields_.moved_v = moved_v_.data();
    fields_.group_mark = group_mark_.data();
    variant_ = {variant.sweep, variant.damped, variant.finite_rotation, variant.vertical_only, 0};
    loads_.dt = 1e-10;
    loads_.gravity = 9.81;
    loads_.frame.spin = 194;
  }

  const SweptBlock& block() const { return mesh_.blocks.front(); }
  void step() {
    device_->kernels<Real, U>().march(variant_, march_.at(loads_), fields_);
    device_->wait();
  }

 private:
  static Mesh mesh_of(const ElementVariant& variant, std::int64_t elements) {
    Mesh mesh = made_up_mesh(variant.sweep, variant.perturbed, elements);
    mesh.blocks.front().vertical_only = variant.vertical_only;
    return mesh;
  }
  template <class T>
  DeviceArray<T> copy(const AlignedVector<T>& values) {
    return DeviceArray<T>(*device_, std::span<const T>(values.data(), values.size()));
  }

  Device* device_;
  Mesh mesh_;
  BasicInternalForce<Real, U> internal_;
  BlockMarch<Real> march_;
  DeviceArray<U> u_;
  DeviceArray<Real> v_;
  DeviceArray<U> moved_u_;
  DeviceArray<Real> moved_v_, inverse_mass_;
  DeviceArray<int> group_mark_;
  MarchFields<Real, U> fields_;
  TileVariant variant_;
  StepLoads loads_;
};

Measurement device_triad(Device& device, const MeasurementPlan& plan) {
  DeviceArray<double> a(device, kTriadValues);
  DeviceArray<double> b(device, kTriadValues);
  DeviceArray<double> c(device, kTriadValues);
  return measure({[&] {
                   device.triad(kTriadValues, a.data(), b.data(), c.data());
                   device.wait();
                 }},
                 plan);
}

double byte_seconds_of(const Measurement& triad) {
  return triad.fastest / (kTriadBytes * static_cast<double>(kTriadValues));
}

class DeviceRows {
 public:
  DeviceRows(Device& device, const BenchKernelsOptions& options) : device_(&device), options_(&options) {}

  void add_limits() {
    const Measurement triad = device_triad(*device_, options_->plan);
    seconds_per_byte_ = byte_seconds_of(triad);
    add("triad", "memory", "double", "value", kTriadValues, triad, {2, kTriadBytes});
    DeviceArray<double> a(*device_, kTriadValues);
    AlignedVector<double> host(static_cast<std::size_t>(kTriadValues), 1.0);
    add("copy", "to the device", "double", "value", kTriadValues,
        measure({[&] { a.upload(host.data()); }}, options_->plan), {0, sizeof(double)});
    add("copy", "from the device", "double", "value", kTriadValues,
        measure({[&] { a.download(host.data()); }}, options_->plan), {0, sizeof(double)});
    add("launch", "of one value", "double", "launch", 1,
        measure({[&] {
                  device_->triad(1, a.data(), a.data(), a.data());
                  device_->wait();
                }},
                options_->plan),
        {});
  }

  template <class Real, class U>
  void add_marches(const char* precision) {
    const auto& wanted = options_->precisions;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), precision) == wanted.end()) return;
    struct Kind {
      const char* path;
      ElementVariant variant;
    };
    using enum Sweep;
    const Kind kinds[] = {{"extruded, linear", {extruded, false, false, false, true, false}},
                          {"extruded, linear, damped", {extruded, true, false, false, true, false}},
                          {"extruded, vertical only, damped", {extruded, true, false, false, true, true}},
                          {"extruded perturbed, linear, damped", {extruded, true, false, true, true, false}},
                          {"revolved, finite rotation, damped", {revolved, true, true, false, true, false}}};
    for (const Kind& kind : kinds)
      for (const std::int64_t elements : options_->elements) {
        MarchedBlock<Real, U> marched(*device_, kind.variant, elements);
        add("march", kind.path, precision, "element", marched.block().elements(),
            measure({[&] { marched.step(); }}, options_->plan),
            element_work(kind.variant, marched.block(), {sizeof(U), sizeof(Real)}));
      }
  }

  std::vector<BenchRow> take() { return std::move(rows_); }

 private:
  void add(const char* kernel, const char* path, const char* precision, const char* unit, std::int64_t units,
           const Measurement& measured, const Work& work) {
    BenchRow row{{kernel, path, precision, std::string(backend()), device_->name(), threads(), units},
                 unit,
                 measured,
                 work,
                 {}};
    row.limit = {work.bytes * static_cast<double>(units) * seconds_per_byte_, true};
    rows_.push_back(std::move(row));
  }

  Device* device_;
  const BenchKernelsOptions* options_;
  double seconds_per_byte_ = 0;
  std::vector<BenchRow> rows_;
};

}  // namespace

double byte_seconds(Device& device, const MeasurementPlan& plan) {
  return byte_seconds_of(device_triad(device, plan));
}

std::vector<BenchRow> measure_device(Device& device, const BenchKernelsOptions& options) {
  DeviceRows rows(device, options);
  rows.add_limits();
  rows.add_marches<double, double>("double");
  rows.add_marches<float, double>("mixed");
  rows.add_marches<float, float>("single");
  return rows.take();
}

}  // namespace tread
