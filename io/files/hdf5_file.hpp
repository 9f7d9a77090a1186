#pragma once
// HDF5 files behind one class. Objects are named by path; missing groups of a path are made.

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tread {

/// Attributes of an object by name: numbers and texts.
using Hdf5Attributes = std::map<std::string, std::variant<double, std::string>>;

/// Returns true if the file begins as HDF5 files do.
bool begins_as_hdf5(const std::filesystem::path& path);

/// An open HDF5 file. The element type T of data is double, float, std::int64_t, std::int32_t or
/// std::uint8_t. Errors name the file, the object and the system's reason: InputError if a file or object to
/// read is missing or of another shape, ResourceError if something cannot be written. Move-only.
class Hdf5File {
 public:
  /// Storage of a dataset. Compressed data are exact; rows should be appended in whole chunks.
  enum class Storage { plain, compressed };

  /// Starts an empty file in place of any older one.
  static Hdf5File create(const std::filesystem::path& path);
  /// Starts an empty file that lives in memory only.
  static Hdf5File create_in_memory();
  static Hdf5File open_to_read(const std::filesystem::path& path);
  static Hdf5File open_to_extend(const std::filesystem::path& path);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;
  ~Hdf5File();

  void make_group(const std::string& name);

  /// Writes a dataset of the given shape (row-major; {values.size()} if empty).
  template <class T>
  void write(const std::string& name, std::span<const T> values, std::vector<std::uint64_t> shape = {});

  /// Makes an empty dataset of shape {0, ...row_shape} that `append` lengthens, stored in chunks of `chunk`
  /// rows.
  template <class T>
  void make_extendible(const std::string& name, std::uint64_t chunk,
                       const std::vector<std::uint64_t>& row_shape = {}, Storage storage = Storage::plain);

  /// Adds whole rows at the end of a dataset made by make_extendible. If it fails for want of room, the
  /// dataset may have grown by rows that hold zeros.
  template <class T>
  void append(const std::string& name, std::span<const T> rows);

  /// Sets an attribute of a group or dataset: an array, or a null-padded ASCII string of fixed length.
  template <class T>
  void write_attribute(const std::string& object, const std::string& name, std::span<const T> values);
  void write_attribute(const std::string& object, const std::string& name, const std::string& text);

  /// Sets attributes of a group or dataset, in place of those of the same names.
  void set_attributes(const std::string& object, const Hdf5Attributes& attributes);

  /// Makes `name` a link to an object of another file. A relative path is relative to this file's folder.
  void link_external(const std::string& name, const std::filesystem::path& file, const std::string& object);

  bool contains(const std::string& name) const;
  /// Names of all datasets, "group/name", in alphabetic order; links to other files are left out.
  std::vector<std::string> datasets() const;
  /// Offset in image() of the values of a dataset that write() made [B].
  std::uint64_t place(const std::string& name) const;
  std::vector<std::uint64_t> shape(const std::string& name) const;
  /// Element type of a dataset: "double", "float", "int64", "int32", "uint8" or "other".
  std::string type(const std::string& name) const;
  template <class T>
  std::vector<T> read(const std::string& name) const;
  /// Row at a place along the first dimension.
  template <class T>
  std::vector<T> read_row(const std::string& name, std::uint64_t row) const;
  template <class T>
  std::vector<T> read_attribute(const std::string& object, const std::string& name) const;
  /// Single numbers and texts among the attributes of an object.
  Hdf5Attributes attributes(const std::string& object) const;
  std::string read_text_attribute(const std::string& object, const std::string& name) const;

  /// Returns true if several threads may use files at the same time, each its own.
  static bool thread_safe();

  /// Bytes that a file of create_in_memory() would have on the disk. They are valid until the file is written
  /// to or closed.
  std::string_view image() const;

  /// Hands everything written so far to the operating system; other processes can then read the file.
  void flush();
  /// Closes the file and reports data that could not be written. The destructor closes without a report.
  void close();

 private:
  Hdf5File(std::int64_t id, std::filesystem::path path) : id_(id), path_(std::move(path)) {}

  std::int64_t id_ = -1;
  std::filesystem::path path_;
};

}  // namespace tread
