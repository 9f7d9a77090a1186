#include "io/scene/key_builders.hpp"

#include <utility>

namespace tread::keys {

Key quantity(std::string path, Effects effects, std::function<Field(Scene&)> locate, const Quantity& of,
             std::string unit, Bounds range, std::string description) {
  return {.path = std::move(path),
          .effects = effects,
          .kind = Kind::quantity,
          .locate = std::move(locate),
          .description = std::move(description),
          .quantity = &of,
          .unit = std::move(unit),
          .range = range};
}

Key number(std::string path, Effects effects, std::function<Field(Scene&)> locate, Bounds range,
           std::string description, Kind kind) {
  return {.path = std::move(path),
          .effects = effects,
          .kind = kind,
          .locate = std::move(locate),
          .description = std::move(description),
          .range = range};
}

Key choice(std::string path, Effects effects, std::function<Field(Scene&)> locate,
           std::vector<std::string> allowed, std::string description) {
  return {.path = std::move(path),
          .effects = effects,
          .kind = Kind::text,
          .locate = std::move(locate),
          .description = std::move(description),
          .allowed = std::move(allowed)};
}

Key text(std::string path, Effects effects, std::function<Field(Scene&)> locate, std::string description) {
  return choice(std::move(path), effects, std::move(locate), {}, std::move(description));
}

Key file(std::string path, Effects effects, std::function<Field(Scene&)> locate, std::string description) {
  return or_file(text(std::move(path), effects, std::move(locate), std::move(description)));
}

Key material_name(std::string path, Effects effects, std::function<Field(Scene&)> locate,
                  std::string description) {
  return {.path = std::move(path),
          .effects = effects,
          .kind = Kind::text,
          .locate = std::move(locate),
          .description = std::move(description),
          .names_material = true};
}

Key flag(std::string path, Effects effects, std::function<Field(Scene&)> locate, std::string description) {
  return {.path = std::move(path),
          .effects = effects,
          .kind = Kind::boolean,
          .locate = std::move(locate),
          .description = std::move(description)};
}

Key required(Key key) {
  key.required = true;
  return key;
}

Key or_file(Key key) {
  key.takes_file = true;
  return key;
}

Key only_with(std::string condition, std::vector<std::string> values, Key key) {
  key.only_with = {std::move(condition), std::move(values)};
  return key;
}

Key with_table(std::string table, Key key) {
  return only_with(std::move(table), std::vector<std::string>{}, std::move(key));
}

Key with_file(std::string other, Key key) {
  key.only_with = {std::move(other), {}, true};
  return key;
}

Key not_with(std::string condition, std::string value, double idle_value, Key key) {
  key.only_with = {std::move(condition), {std::move(value)}, false, true};
  key.idle_value = idle_value;
  return key;
}

Key only_with(std::string condition, std::string value, Key key) {
  return only_with(std::move(condition), std::vector<std::string>{std::move(value)}, std::move(key));
}

Key instead_of(std::string other, Key key) {
  key.excludes = std::move(other);
  return key;
}

}  // namespace tread::keys
