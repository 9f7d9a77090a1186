#include "io/scene/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "io/files/absolute_path.hpp"
#include "io/scene/unknown_key.hpp"
#include "io/text/text.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// The value that a text means, as TOML writes it; empty where the text means none.
using Spelling = std::string (*)(const std::string& text);

/// "0.5" of ".5" and "0,5".
std::string number_in_toml(const std::string& text) {
  const std::string with_points = with_decimal_points(text);
  try {
    return fmt::format("{}", parse_number(with_points.empty() ? text : with_points));
  } catch (const InputError&) {
    return "";
  }
}

/// "24" of "024" and "+024"; empty for a number with a comma or a point.
std::string whole_number_in_toml(const std::string& text) {
  const std::string_view digits = std::string_view(text).substr(text.starts_with('+') ? 1 : 0);
  const char* last = digits.data() + digits.size();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  return error == std::errc() && end == last ? fmt::format("{}", value) : "";
}

/// "true" of "True".
std::string truth_in_toml(const std::string& text) {
  const std::string word = lower_case(text);
  return word == "true" || word == "false" ? word : "";
}

[[noreturn]] void wrong_type(const std::string& expected, const toml::node& node, Spelling spelling = nullptr,
                             Notation notation = Notation::toml) {
  const auto* text = spelling ? node.as_string() : nullptr;
  const std::string meant = text ? spelling(text->get()) : "";
  if (!meant.empty() && notation == Notation::plain && parse_plain_value(text->get(), false)->is_string())
    throw InputError(fmt::format("\"{}\" is not valid TOML; write {}", text->get(), meant));
  throw InputError(fmt::format("expected {}, got {}{}", expected, describe_node(node),
                               meant.empty() ? "" : "; write " + meant));
}

double to_number(const toml::node& node, bool ratio, Notation notation = Notation::toml) {
  const auto* text = node.as_string();
  if (ratio && text) return parse_ratio(text->get());
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value)
    wrong_type(ratio ? "a number or a ratio such as \"1:40\"" : "a number without quotes", node,
               number_in_toml, notation);
  if (!std::isfinite(*value)) throw InputError("the number must be finite");
  return *value;
}

double to_quantity(const Quantity& quantity, const toml::node& node, std::string_view unit = {}) {
  if (const auto* text = node.as_string()) return parse_quantity(text->get(), quantity, unit);
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) {
    throw InputError(fmt::format("got {}; {}", describe_node(node), expectation(quantity, "1", unit)));
  }
  const std::string number = fmt::format("{}", *value);
  throw InputError(fmt::format("{} has no unit; {}", number, expectation(quantity, number, unit)));
}

int to_integer(const toml::node& node, Notation notation) {
  const auto* integer = node.as_integer();
  if (!integer) wrong_type("a whole number without quotes", node, whole_number_in_toml, notation);
  if (integer->get() != static_cast<std::int64_t>(static_cast<int>(integer->get()))) {
    throw InputError(fmt::format("{} is too large", integer->get()));
  }
  return static_cast<int>(integer->get());
}

/// A name that the key allows stays; a file becomes an absolute path.
std::string to_text(const Key& key, const toml::node& node, const fs::path& folder) {
  const auto* text = node.as_string();
  if (!text) wrong_type("a string in quotes", node);
  const std::string& value = require_text(text->get(), key.takes_file);
  const bool allowed = std::find(key.allowed.begin(), key.allowed.end(), value) != key.allowed.end();
  if (allowed || (key.allowed.empty() && !key.takes_file)) return value;
  const bool looks_like_file = key.allowed.empty() || value.find_first_of("./") != std::string::npos;
  if (key.takes_file && looks_like_file && !value.empty()) return absolute_path(folder / value);
  if (key.allowed.empty()) throw InputError("the file name is empty");
  const std::string similar = similar_text(value, key.allowed);
  const std::string instead = instead_of(value);
  throw InputError(fmt::format("\"{}\" is unknown{}; {}choose from: {}{}", value,
                               instead.empty() ? "" : ": " + instead,
                               similar.empty() ? "" : fmt::format("did you mean \"{}\"? ", similar),
                               fmt::join(key.allowed, ", "), key.takes_file ? ", or a file" : ""));
}

void read_damping(const DampingField& field, const toml::node& node) {
  constexpr const char* kForm =
      "{ kind = \"high_frequency_fraction\", value = 1e-4 } or { kind = \"rayleigh_beta\", value = \"1e-8 "
      "s\" }";
  const toml::table* table = node.as_table();
  if (!table) wrong_type(kForm, node);
  const toml::node* value = table->get("value");
  const std::optional<std::string> kind = (*table)["kind"].value<std::string>();
  if (!kind || !value || table->size() != 2) throw InputError(fmt::format("expected {}", kForm));
  *field.rayleigh_beta = 0;
  *field.high_frequency_fraction = 0;
  if (*kind == "rayleigh_beta") {
    *field.rayleigh_beta = to_quantity(kTime, *value);
  } else if (*kind == "high_frequency_fraction") {
    *field.high_frequency_fraction = to_number(*value, false);
  } else {
    throw InputError(fmt::format("kind \"{}\" is unknown; expected {}", *kind, kForm));
  }
}

/// With a point or an exponent, which TOML asks of a number that is not whole: "24.0".
std::string as_stated(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

}  // namespace

const std::string& require_text(const std::string& text, bool names_file) {
  std::size_t characters = 0;
  for (std::size_t at = 0; at < text.size(); at += std::max<std::size_t>(utf8_bytes(text, at), 1)) {
    const auto c = static_cast<unsigned char>(text[at]);
    const bool shown = (c >= 0x20 && c != 0x7f) || c == '\n' || c == '\t';
    if (c == 0 || (!names_file && !shown))
      throw InputError(
          fmt::format("character {} is the control character U+{:04X}; state printable characters alone",
                      characters + 1, c));
    ++characters;
  }
  if (characters > kLongestText && !names_file)
    throw InputError(fmt::format("the text has {} characters, more than the limit of {}; shorten it",
                                 characters, kLongestText));
  return text;
}

std::string describe_node(const toml::node& node) {
  if (const auto* text = node.as_string()) return fmt::format("the string \"{}\"", text->get());
  if (const auto* integer = node.as_integer()) return fmt::format("the number {}", integer->get());
  if (const auto* real = node.as_floating_point()) return "the number " + as_stated(real->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  return "a date or time";
}

bool to_boolean(const toml::node& node, Notation notation) {
  const auto* truth = node.as_boolean();
  if (!truth) wrong_type("true or false without quotes", node, truth_in_toml, notation);
  return truth->get();
}

void read_value(const Key& key, const toml::node& node, const fs::path& folder, const Field& field,
                Notation notation) {
  const auto real = [&] {
    return key.kind == Kind::quantity ? to_quantity(*key.quantity, node, key.unit)
                                      : to_number(node, key.kind == Kind::ratio, notation);
  };
  if (const auto* number = std::get_if<double*>(&field)) **number = real();
  if (const auto* number = std::get_if<std::optional<double>*>(&field)) **number = real();
  if (const auto* number = std::get_if<int*>(&field)) **number = to_integer(node, notation);
  if (const auto* truth = std::get_if<bool*>(&field)) **truth = to_boolean(node, notation);
  if (const auto* text = std::get_if<std::string*>(&field)) **text = to_text(key, node, folder);
  if (const auto* damping = std::get_if<DampingField>(&field)) read_damping(*damping, node);
}

bool is_idle_value(const Key& key, const toml::node& node, Scene scene) {
  if (!key.idle_value) return false;
  const Field field = key.locate(scene);
  const std::optional<double> before = number_at(field);
  try {
    read_value(key, node, {}, field);
  } catch (const InputError&) {
    return false;
  }
  const std::optional<double> stated = number_at(field);
  return stated == key.idle_value || stated == before;
}

}  // namespace tread
