#pragma once
// Named arrays and texts in one file that shows any damage.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace tread {

using SealedValues =
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int64_t>, std::string>;

/// Entries by name, such as "state/displacement". A text may hold any bytes.
using SealedContent = std::map<std::string, SealedValues>;

/// Writes an HDF5 file with a dataset per entry, texts as bytes; names hold no blanks. The 512 bytes before
/// its HDF5 part are a text that states `kind`, `version`, the length of the file and a checksum of the rest.
/// A text behind the HDF5 part lists type, count, place and name of every entry. Forces the file to the disk.
/// Releases the content as it is written: memory holds one copy, and two of the current entry. Throws
/// ResourceError.
void write_sealed(const std::filesystem::path& path, const std::string& kind, int version,
                  SealedContent content);

/// Reads a file of write_sealed() back by its list, without HDF5. Throws InputError with the reason if the
/// file is absent, not a regular file (a symbolic link is none), truncated or damaged. Throws it also for
/// another kind or version, and if the file lacks a listed entry.
SealedContent read_sealed(const std::filesystem::path& path, const std::string& kind, int version);

/// Hash of each entry.
std::map<std::string, std::uint64_t> digests_of(const SealedContent& content);

/// Entry of this name and type. Throws InputError if there is none.
template <class T>
const T& sealed_entry(const SealedContent& content, const std::string& name);

/// The only value of the entry of this name. Throws InputError if there is none, or more than one.
template <class T>
T sealed_value(const SealedContent& content, const std::string& name);

}  // namespace tread
