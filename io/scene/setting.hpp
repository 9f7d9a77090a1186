#pragma once
// The value of a key as read, and its origin. Private to the reader of scenes.

#include <memory>
#include <string>

#include "io/scene/toml_value.hpp"

namespace tread {

/// Where values come from; a higher level overrides a lower one.
enum class Level { library, file, command_line };

struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

struct Origin {
  Level level = Level::library;
  Place place;
  std::string source;  ///< as Entry::source

  Notation notation() const { return level == Level::command_line ? Notation::plain : Notation::toml; }
};

struct Setting {
  std::unique_ptr<toml::node> node;
  Origin origin;
};

}  // namespace tread
