// Attributes of Hdf5File.

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "core/error.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/hdf5_handles.hpp"

namespace tread {

using namespace hdf5;

template <class T>
void Hdf5File::write_attribute(const std::string& object, const std::string& name,
                               std::span<const T> values) {
  const Check check{path_, object};
  const hsize_t size = values.size();
  const Id owner = check.written(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
  const Id space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Id attribute =
      check.written(H5Acreate2(owner, name.c_str(), type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check.written(H5Awrite(attribute, type_of<T>(), values.data()));
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, const std::string& text) {
  const Check check{path_, object};
  const Id owner = check.written(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Id attribute =
      check.written(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check.written(H5Awrite(attribute, type, text.c_str()));
}

void Hdf5File::set_attributes(const std::string& object, const Hdf5Attributes& attributes) {
  const Check check{path_, object};
  const Id owner = check.written(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
  for (const auto& [name, value] : attributes) {
    if (H5Aexists(owner, name.c_str()) > 0) check.written(H5Adelete(owner, name.c_str()));
    if (const std::string* text = std::get_if<std::string>(&value)) {
      write_attribute(object, name, *text);
      continue;
    }
    const Id space(H5Screate(H5S_SCALAR), H5Sclose);
    const Id attribute = check.written(
        H5Acreate2(owner, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check.written(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &std::get<double>(value)));
  }
}

template <class T>
std::vector<T> Hdf5File::read_attribute(const std::string& object, const std::string& name) const {
  const Check check{path_, object};
  const Id attribute =
      check.read(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  std::vector<T> values(count(extent(Id(H5Aget_space(attribute), H5Sclose))));
  check.read(H5Aread(attribute, type_of<T>(), values.data()));
  return values;
}

std::string Hdf5File::read_text_attribute(const std::string& object, const std::string& name) const {
  const Check check{path_, object};
  const Id attribute =
      check.read(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Id type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING)
    throw InputError(fmt::format("cannot read '{}' from {}: attribute '{}' is not a string", object,
                                 path_.string(), name));
  if (H5Tis_variable_str(type) > 0) {
    char* stored = nullptr;
    check.read(H5Aread(attribute, type, static_cast<void*>(&stored)));
    const std::unique_ptr<char, herr_t (*)(void*)> owner(stored, H5free_memory);
    return stored != nullptr ? stored : "";
  }
  std::string text(H5Tget_size(type), '\0');
  check.read(H5Aread(attribute, type, text.data()));
  return text.substr(0, text.find('\0'));
}

Hdf5Attributes Hdf5File::attributes(const std::string& object) const {
  const Check check{path_, object};
  const Id owner = check.read(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
  std::vector<std::string> names;
  check.read(H5Aiterate2(
      owner, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t /*owner*/, const char* name, const H5A_info_t* /*info*/, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
      },
      &names));
  Hdf5Attributes found;
  for (const std::string& name : names) {
    const Id attribute = check.read(H5Aopen(owner, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Id type(H5Aget_type(attribute), H5Tclose);
    const Id space(H5Aget_space(attribute), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1) continue;
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_STRING) found[name] = read_text_attribute(object, name);
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) continue;
    double value = 0;
    check.read(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value));
    found[name] = value;
  }
  return found;
}

#define TREAD_HDF5_TYPE(T)                                                                             \
  template void Hdf5File::write_attribute(const std::string&, const std::string&, std::span<const T>); \
  template std::vector<T> Hdf5File::read_attribute<T>(const std::string&, const std::string&) const;
TREAD_FOR_HDF5_TYPES(TREAD_HDF5_TYPE)
#undef TREAD_HDF5_TYPE

}  // namespace tread
