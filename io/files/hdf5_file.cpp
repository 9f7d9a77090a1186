#include "io/files/hdf5_file.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <array>
#include <fstream>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "io/files/hdf5_handles.hpp"

namespace tread {

using namespace hdf5;

std::string hdf5::reason() {
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

std::uint64_t hdf5::count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

hdf5::Shape hdf5::extent(hid_t space) {
  std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return {size.begin(), size.end()};
}

namespace {

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

}  // namespace

bool begins_as_hdf5(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  std::array<char, kSignature.size()> first{};
  std::ifstream file(path, std::ios::binary);
  return file.read(first.data(), first.size()) && std::string_view(first.data(), first.size()) == kSignature;
}

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
  // Links by H5Lvisit, not objects by H5Ovisit: its arguments differ between versions of the library.
  check.read(H5Lvisit(
      id_, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t root, const char* name, const H5L_info_t* link, void* out) -> herr_t {
        if (link->type != H5L_TYPE_HARD) return 0;
        const Id object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
        if (object < 0) return -1;
        if (H5Iget_type(object) == H5I_DATASET)
          static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
      },
      &names));
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
  template std::vector<T> Hdf5File::read<T>(const std::string&) const;                                  \
  template std::vector<T> Hdf5File::read_row<T>(const std::string&, std::uint64_t) const;
TREAD_FOR_HDF5_TYPES(TREAD_HDF5_TYPE)
#undef TREAD_HDF5_TYPE

}  // namespace tread
