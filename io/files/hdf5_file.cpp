#include "io/files/hdf5_file.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace tread {

static_assert(std::is_same_v<hid_t, std::int64_t>);

namespace {

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
std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
        if (depth == 0) *static_cast<std::string*>(out) = error->desc;
        return 0;
      },
      &text);
  const std::string mark = "error message = '";
  const std::size_t start = text.find(mark);
  if (start == std::string::npos) return text;
  const std::size_t first = start + mark.size();
  return text.substr(first, text.find('\'', first) - first);
}

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

std::uint64_t count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

std::vector<hsize_t> sizes(const Shape& shape) {
  return {shape.begin(), shape.end()};
}

/// Link creation that makes missing groups of the path.
Id make_groups() {
  Id list(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

/// File access without locks: a run's file can be read while it grows, and network file systems need no lock
/// service. Silences the library's own error printing. Disables its clean-up at exit, which crashes on a file
/// that could not be closed on a full disk.
Id access() {
  static const herr_t no_clean_up = H5dont_atexit();
  static_cast<void>(no_clean_up);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Id list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(list, 0, 1);
  return list;
}

Shape extent(hid_t space) {
  std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return {size.begin(), size.end()};
}

}  // namespace

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  const Id list = access();
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, list);
  if (id < 0) fail<ResourceError>("create", path, "");
  return {id, path};
}

Hdf5File Hdf5File::create_in_memory() {
  constexpr std::size_t kGrowth = 1 << 20;  // [B]
  const Id list = access();
  H5Pset_fapl_core(list, kGrowth, 0);
  const std::filesystem::path name = "memory";
  const hid_t id = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, list);
  if (id < 0) fail<ResourceError>("create", name, "");
  return {id, name};
}

Hdf5File Hdf5File::open_to_read(const std::filesystem::path& path) {
  const Id list = access();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, list);
  if (id < 0) fail<InputError>("read", path, "");
  return {id, path};
}

Hdf5File Hdf5File::open_to_extend(const std::filesystem::path& path) {
  const Id list = access();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDWR, list);
  if (id < 0) fail<ResourceError>("extend", path, "");
  return {id, path};
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : id_(std::exchange(other.id_, -1)), path_(std::move(other.path_)) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(path_, other.path_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (id_ >= 0) H5Fclose(id_);
}

void Hdf5File::make_group(const std::string& name) {
  const Check check{path_, name};
  check.written(H5Gcreate2(id_, name.c_str(), make_groups(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
}

template <class T>
void Hdf5File::write(const std::string& name, std::span<const T> values, Shape shape) {
  if (shape.empty()) shape = {values.size()};
  if (count(shape) != values.size())
    throw std::logic_error(
        fmt::format("{}: {} values do not fill the shape ({})", name, values.size(), fmt::join(shape, ", ")));
  const Check check{path_, name};
  const Id space(H5Screate_simple(static_cast<int>(shape.size()), sizes(shape).data(), nullptr), H5Sclose);
  Id data = check.written(
      H5Dcreate2(id_, name.c_str(), type_of<T>(), space, make_groups(), H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  check.written(H5Dwrite(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  check.written(data.close());
}

template <class T>
void Hdf5File::make_extendible(const std::string& name, std::uint64_t chunk, const Shape& row_shape,
                               Storage storage) {
  Shape start = row_shape;
  start.insert(start.begin(), 0);
  std::vector<hsize_t> limit = sizes(start);
  limit[0] = H5S_UNLIMITED;
  std::vector<hsize_t> chunks = sizes(start);
  chunks[0] = chunk;

  const Check check{path_, name};
  const int rank = static_cast<int>(start.size());
  const Id space(H5Screate_simple(rank, sizes(start).data(), limit.data()), H5Sclose);
  const Id layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(layout, rank, chunks.data());
  H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER);
  if (storage == Storage::compressed && H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    constexpr unsigned kLevel = 4;
    H5Pset_shuffle(layout);
    H5Pset_deflate(layout, kLevel);
  }
  check.written(H5Dcreate2(id_, name.c_str(), type_of<T>(), space, make_groups(), layout, H5P_DEFAULT),
                H5Dclose);
}

template <class T>
void Hdf5File::append(const std::string& name, std::span<const T> rows) {
  const Check check{path_, name};
  // Without a chunk cache the rows go to the file at once, and the system reports errors at once.
  const Id direct(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(direct, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, 0, H5D_CHUNK_CACHE_W0_DEFAULT);
  Id data = check.written(H5Dopen2(id_, name.c_str(), direct), H5Dclose);
  Shape size = extent(Id(H5Dget_space(data), H5Sclose));
  Shape added = size;
  added[0] = 1;
  const std::uint64_t row = count(added);
  if (rows.size() % row != 0)
    throw std::logic_error(fmt::format("{}: {} values are not whole rows of {}", name, rows.size(), row));
  added[0] = rows.size() / row;

  std::vector<hsize_t> first(size.size(), 0);
  first[0] = size[0];
  size[0] += added[0];
  check.written(H5Dset_extent(data, sizes(size).data()));
  const Id memory(H5Screate_simple(static_cast<int>(added.size()), sizes(added).data(), nullptr), H5Sclose);
  const Id place(H5Dget_space(data), H5Sclose);
  H5Sselect_hyperslab(place, H5S_SELECT_SET, first.data(), nullptr, sizes(added).data(), nullptr);
  check.written(H5Dwrite(data, type_of<T>(), memory, place, H5P_DEFAULT, rows.data()));
  check.written(data.close());
}

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

void Hdf5File::link_external(const std::string& name, const std::filesystem::path& file,
                             const std::string& object) {
  const Check check{path_, name};
  check.written(
      H5Lcreate_external(file.c_str(), object.c_str(), id_, name.c_str(), make_groups(), H5P_DEFAULT));
}

bool Hdf5File::contains(const std::string& name) const {
  // Every group of the path must be asked for: the library fails on a path through a missing group.
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
    if (H5Lexists(id_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(id_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::datasets() const {
  std::vector<std::string> names;
  const std::string all;
  const Check check{path_, all};
  check.read(H5Ovisit2(
      id_, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t /*root*/, const char* name, const H5O_info_t* info, void* out) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
      },
      &names, H5O_INFO_BASIC));
  return names;
}

std::uint64_t Hdf5File::place(const std::string& name) const {
  const Check check{path_, name};
  const Id data = check.read(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const haddr_t place = H5Dget_offset(data);
  check.read(place == HADDR_UNDEF ? -1 : 0);
  return place;
}

std::string_view Hdf5File::image() const {
  const std::string all;
  const Check check{path_, all};
  check.written(H5Fflush(id_, H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
  void* place = nullptr;  // address of the pointer to the bytes
  check.written(size < 0 ? -1 : H5Fget_vfd_handle(id_, H5P_DEFAULT, &place));
  return {*static_cast<const char* const*>(place), static_cast<std::size_t>(size)};
}

bool Hdf5File::thread_safe() {
  hbool_t safe = 0;
  return H5is_library_threadsafe(&safe) >= 0 && safe;
}

Shape Hdf5File::shape(const std::string& name) const {
  const Check check{path_, name};
  const Id data = check.read(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  return extent(Id(H5Dget_space(data), H5Sclose));
}

std::string Hdf5File::type(const std::string& name) const {
  const Check check{path_, name};
  const Id data = check.read(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Id type(H5Dget_type(data), H5Tclose);
  const auto is = [&](hid_t known) { return H5Tequal(type, known) > 0; };
  if (is(type_of<double>())) return "double";
  if (is(type_of<float>())) return "float";
  if (is(type_of<std::int64_t>())) return "int64";
  if (is(type_of<std::int32_t>())) return "int32";
  if (is(type_of<std::uint8_t>())) return "uint8";
  return "other";
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name) const {
  const Check check{path_, name};
  const Id data = check.read(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  std::vector<T> values(count(extent(Id(H5Dget_space(data), H5Sclose))));
  check.read(H5Dread(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

template <class T>
std::vector<T> Hdf5File::read_row(const std::string& name, std::uint64_t row) const {
  const Check check{path_, name};
  const Id data = check.read(H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Id place(H5Dget_space(data), H5Sclose);
  Shape size = extent(place);
  if (size.empty() || row >= size[0])
    throw InputError(fmt::format("cannot read '{}' from {}: there is no row {}", name, path_.string(), row));
  std::vector<hsize_t> first(size.size(), 0);
  first[0] = row;
  size[0] = 1;
  H5Sselect_hyperslab(place, H5S_SELECT_SET, first.data(), nullptr, sizes(size).data(), nullptr);
  const Id memory(H5Screate_simple(static_cast<int>(size.size()), sizes(size).data(), nullptr), H5Sclose);
  std::vector<T> values(count(size));
  check.read(H5Dread(data, type_of<T>(), memory, place, H5P_DEFAULT, values.data()));
  return values;
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
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw InputError(fmt::format("cannot read '{}' from {}: attribute '{}' is not a string of fixed length",
                                 object, path_.string(), name));
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
    if (H5Sget_simple_extent_npoints(space) != 1 || H5Tis_variable_str(type) > 0) continue;
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_STRING) found[name] = read_text_attribute(object, name);
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) continue;
    double value = 0;
    check.read(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value));
    found[name] = value;
  }
  return found;
}

void Hdf5File::flush() {
  if (H5Fflush(id_, H5F_SCOPE_LOCAL) < 0) fail<ResourceError>("write", path_, "");
}

void Hdf5File::close() {
  if (id_ >= 0 && H5Fclose(std::exchange(id_, -1)) < 0) fail<ResourceError>("write", path_, "");
}

#define TREAD_HDF5_TYPE(T)                                                                              \
  template void Hdf5File::write(const std::string&, std::span<const T>, Shape);                         \
  template void Hdf5File::make_extendible<T>(const std::string&, std::uint64_t, const Shape&, Storage); \
  template void Hdf5File::append(const std::string&, std::span<const T>);                               \
  template void Hdf5File::write_attribute(const std::string&, const std::string&, std::span<const T>);  \
  template std::vector<T> Hdf5File::read<T>(const std::string&) const;                                  \
  template std::vector<T> Hdf5File::read_row<T>(const std::string&, std::uint64_t) const;               \
  template std::vector<T> Hdf5File::read_attribute<T>(const std::string&, const std::string&) const;
TREAD_HDF5_TYPE(double)
TREAD_HDF5_TYPE(float)
TREAD_HDF5_TYPE(std::int64_t)
TREAD_HDF5_TYPE(std::int32_t)
TREAD_HDF5_TYPE(std::uint8_t)
#undef TREAD_HDF5_TYPE

}  // namespace tread
