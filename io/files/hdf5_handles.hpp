#pragma once
// Identifiers and return values of the HDF5 library, for the sources of Hdf5File.

#include <fmt/core.h>
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace tread {

static_assert(std::is_same_v<hid_t, std::int64_t>);

namespace hdf5 {

using Shape = std::vector<std::uint64_t>;

/// An HDF5 identifier that closes itself.
class Id {
 public:
  Id(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id& operator=(Id&& other) = delete;
  operator hid_t() const { return id_; }

  /// Closes the object. The library holds small data back until then, so a full disk may show here.
  herr_t close() { return close_(std::exchange(id_, -1)); }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Innermost entry of the library's error stack, or the operating system's words if it holds any.
std::string reason();

template <class E>
[[noreturn]] void fail(const char* verb, const std::filesystem::path& file, const std::string& object) {
  const std::string place =
      object.empty() ? "" : fmt::format(" '{}' {}", object, verb[0] == 'r' ? "from" : "to");
  throw E(fmt::format("cannot {}{} {}: {}", verb, place, file.string(), reason()));
}

/// Checks the library's return values of writing and reading.
struct Check {
  const std::filesystem::path& file;
  const std::string& object;

  void written(herr_t status) const {
    if (status < 0) fail<ResourceError>("write", file, object);
  }
  void read(herr_t status) const {
    if (status < 0) fail<InputError>("read", file, object);
  }
  Id written(hid_t id, herr_t (*close)(hid_t)) const {
    if (id < 0) fail<ResourceError>("write", file, object);
    return {id, close};
  }
  Id read(hid_t id, herr_t (*close)(hid_t)) const {
    if (id < 0) fail<InputError>("read", file, object);
    return {id, close};
  }
};

template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// Calls a macro with each type that a file holds.
#define TREAD_FOR_HDF5_TYPES(use) use(double) use(float) use(std::int64_t) use(std::int32_t) use(std::uint8_t)

/// Number of values of a shape.
std::uint64_t count(const Shape& shape);

/// Shape of a dataspace.
Shape extent(hid_t space);

}  // namespace hdf5

}  // namespace tread
