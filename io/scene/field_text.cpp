#include "io/scene/field_text.hpp"

#include <fmt/format.h>

#include "io/text/units.hpp"

namespace tread {

std::optional<FieldText> field_text(const Key& key, const Field& field) {
  FieldText text;
  if (key.quantity) text.unit = key.quantity->si;
  if (const auto* number = std::get_if<double*>(&field)) text.value = fmt::format("{}", **number);
  if (const auto* number = std::get_if<int*>(&field)) text.value = fmt::format("{}", **number);
  if (const auto* truth = std::get_if<bool*>(&field)) text.value = **truth ? "true" : "false";
  if (const auto* string = std::get_if<std::string*>(&field)) text.value = **string;
  if (const auto* damping = std::get_if<DampingField>(&field)) {
    text.value = fmt::format("{}", *number_at(field));
    if (*damping->rayleigh_beta != 0) text.unit = std::string("s");
  }
  if (const auto* number = std::get_if<std::optional<double>*>(&field)) {
    if (!**number) return std::nullopt;
    text.value = fmt::format("{}", ***number);
  }
  if (std::holds_alternative<std::monostate>(field)) return std::nullopt;
  if (key.names_material && text.value.empty()) return std::nullopt;
  const std::optional<double> number = number_at(field);
  text.shown = number && !key.unit.empty() ? format_quantity(*number, key.unit)
               : text.unit.empty()         ? text.value
                                           : text.value + " " + text.unit;
  return text;
}

}  // namespace tread
