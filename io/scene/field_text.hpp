#pragma once
// Values of a scene as text, for reports and for the resolved scene.

#include <optional>
#include <string>

#include "io/scene/schema.hpp"

namespace tread {

/// The value of a field.
struct FieldText {
  std::string value;  ///< in SI, "15.2"
  std::string unit;   ///< "m"; empty for texts and pure numbers
  std::string shown;  ///< in the unit of documentation: "15.2 m", "205.9 GPa"
};

/// The value of a key's field; nothing where the field is absent or not set.
std::optional<FieldText> field_text(const Key& key, const Field& field);

}  // namespace tread
