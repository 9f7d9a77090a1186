#pragma once
// Scenes that `based_on` can name.

#include <string>
#include <string_view>
#include <vector>

namespace tread {

struct LibraryValue {
  std::string_view path;    ///< of a key in the schema
  std::string_view value;   ///< as after --set
  std::string_view source;  ///< where the value comes from
};

struct LibraryEntry {
  std::string_view name;
  std::string_view base;  ///< entry whose values hold where this one states none; may be empty
  std::string_view description;
  std::vector<LibraryValue> values;
};

const std::vector<LibraryEntry>& scene_library();

/// Names of all entries, "highspeed-slab-2014, ...".
std::string library_names();

/// Entry of that name, or nullptr.
const LibraryEntry* find_library_entry(std::string_view name);

}  // namespace tread
