#pragma once
// Builders of the schema's keys: what a key measures, where it lives, what it affects, when it has an effect.
// Private to the schema.

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/key.hpp"

namespace tread::keys {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline Bounds above(double low, double high = kInfinity) {
  return {low, high, true, false};
}
inline Bounds from(double low, double high = kInfinity) {
  return {low, high, false, false};
}

/// A member of the scene itself.
template <class Member>
std::function<Field(Scene&)> at(Member Scene::*member) {
  return [member](Scene& scene) -> Field { return &(scene.*member); };
}

/// A member of a component.
template <class Spec, class Member>
std::function<Field(Scene&)> at(std::optional<Spec> Scene::*spec, Member Spec::*member) {
  return [spec, member](Scene& scene) -> Field {
    if (!(scene.*spec)) return std::monostate{};
    return &(*(scene.*spec).*member);
  };
}

/// A member of a part of a component.
template <class Spec, class Part, class Member>
std::function<Field(Scene&)> at(std::optional<Spec> Scene::*spec, Part Spec::*part, Member Part::*member) {
  return [spec, part, member](Scene& scene) -> Field {
    if (!(scene.*spec)) return std::monostate{};
    return &((*(scene.*spec)).*part.*member);
  };
}

/// A member of a part that is always there.
template <class Spec, class Member>
std::function<Field(Scene&)> at(Spec Scene::*spec, Member Spec::*member) {
  return [spec, member](Scene& scene) -> Field { return &(scene.*spec.*member); };
}

/// A member of the one of that name in a map of the scene.
template <class Spec, class Member>
std::function<Field(Scene&)> at(std::map<std::string, Spec, std::less<>> Scene::*all, const std::string& name,
                                Member Spec::*member) {
  return [all, name, member](Scene& scene) -> Field {
    const auto found = (scene.*all).find(name);
    if (found == (scene.*all).end()) return std::monostate{};
    return &(found->second.*member);
  };
}

Key quantity(std::string path, Effects effects, std::function<Field(Scene&)> locate, const Quantity& of,
             std::string unit, Bounds range, std::string description);
Key number(std::string path, Effects effects, std::function<Field(Scene&)> locate, Bounds range,
           std::string description, Kind kind = Kind::number);
Key choice(std::string path, Effects effects, std::function<Field(Scene&)> locate,
           std::vector<std::string> allowed, std::string description);
/// Any text.
Key text(std::string path, Effects effects, std::function<Field(Scene&)> locate, std::string description);
/// A text that names a file.
Key file(std::string path, Effects effects, std::function<Field(Scene&)> locate, std::string description);
/// A text that names the material of a part.
Key material_name(std::string path, Effects effects, std::function<Field(Scene&)> locate,
                  std::string description);
Key flag(std::string path, Effects effects, std::function<Field(Scene&)> locate, std::string description);

Key required(Key key);
Key or_file(Key key);
Key only_with(std::string condition, std::vector<std::string> values, Key key);
Key only_with(std::string condition, std::string value, Key key);
/// A key without effect where the text key `condition` has this value; `idle_value` may be stated there.
Key not_with(std::string condition, std::string value, double idle_value, Key key);
Key with_table(std::string table, Key key);
/// A key with an effect only where the text key `other` names a file.
Key with_file(std::string other, Key key);
Key instead_of(std::string other, Key key);

}  // namespace tread::keys
