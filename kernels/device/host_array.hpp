#pragma once
// Memory of the host that a device copies as fast as the bus.

#include <cstddef>
#include <memory>
#include <utility>

#include "core/page_vector.hpp"
#include "kernels/device/device.hpp"

namespace tread {

struct UnlockPages {
  Device* device;
  void operator()(void* memory) const { device->unlock(memory); }
};
/// Pages of an array, locked until this ends, which must be before the array does.
using LockedPages = std::unique_ptr<void, UnlockPages>;

template <class T>
LockedPages lock_pages(Device& device, PageVector<T>& values) {
  if (!values.empty()) device.lock(values.data(), values.size() * sizeof(T));
  return {values.empty() ? nullptr : values.data(), {&device}};
}

/// An array of the host in locked pages.
template <class T>
class HostArray {
 public:
  HostArray() = default;
  HostArray(Device& device, std::size_t size) : values_(size), locked_(lock_pages(device, values_)) {}
  HostArray(HostArray&& other) noexcept { swap(other); }
  HostArray& operator=(HostArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~HostArray() = default;

  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  std::size_t size() const { return values_.size(); }
  void swap(HostArray& other) {
    std::swap(values_, other.values_);
    std::swap(locked_, other.locked_);
  }

 private:
  PageVector<T> values_;
  LockedPages locked_{nullptr, {nullptr}};
};

}  // namespace tread
