#include "io/text/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

struct Symbol {
  std::string_view text;
  Unit unit;
  bool prefixed;
};

constexpr std::array<Symbol, 11> kSymbols{{
    {"m", {0, 1, 1, {1, 0, 0}}, true},
    {"g", {-3, 1, 1, {0, 1, 0}}, true},
    {"t", {3, 1, 1, {0, 1, 0}}, false},
    {"s", {0, 1, 1, {0, 0, 1}}, true},
    {"min", {0, 60, 1, {0, 0, 1}}, false},
    {"h", {0, 3600, 1, {0, 0, 1}}, false},
    {"N", {0, 1, 1, {1, 1, -2}}, true},
    {"J", {0, 1, 1, {2, 1, -2}}, true},
    {"Pa", {0, 1, 1, {-1, 1, -2}}, true},
    {"Hz", {0, 1, 1, {0, 0, -1}}, true},
    {"B", {0, 1, 1, {0, 0, 0, 1}}, true},
}};

constexpr std::array<std::pair<char, int>, 8> kPrefixes{
    {{'n', -9}, {'u', -6}, {'m', -3}, {'c', -2}, {'d', -1}, {'k', 3}, {'M', 6}, {'G', 9}}};

constexpr std::array<const Quantity*, 14> kQuantities{
    &kLength,    &kTime,           &kSpeed,  &kAcceleration, &kMass,      &kDensity, &kForce,
    &kStiffness, &kViscousDamping, &kTorque, &kStress,       &kFrequency, &kData,    &kWear};

/// Typographic signs of unit names in ASCII.
std::string in_ascii(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSigns{
      {{"µ", "u"}, {"μ", "u"}, {"·", "*"}, {"⋅", "*"}, {"²", "2"}, {"³", "3"}}};
  std::string ascii(text);
  for (const auto& [sign, plain] : kSigns) {
    for (auto at = ascii.find(sign); at != std::string::npos; at = ascii.find(sign, at)) {
      ascii.replace(at, sign.size(), plain);
    }
  }
  return ascii;
}

std::optional<Unit> find_symbol(std::string_view name) {
  for (const Symbol& symbol : kSymbols) {
    if (name == symbol.text) return symbol.unit;
  }
  for (const Symbol& symbol : kSymbols) {
    if (!symbol.prefixed || name.empty() || name.substr(1) != symbol.text) continue;
    for (const auto& [letter, exponent] : kPrefixes) {
      if (name.front() != letter) continue;
      Unit unit = symbol.unit;
      unit.exponent += exponent;
      return unit;
    }
  }
  return std::nullopt;
}

/// unit *= factor^power.
void multiply(Unit& unit, const Unit& factor, int power) {
  for (int i = 0; i < std::abs(power); ++i) {
    unit.numerator *= power > 0 ? factor.numerator : factor.denominator;
    unit.denominator *= power > 0 ? factor.denominator : factor.numerator;
  }
  unit.exponent += power * factor.exponent;
  unit.dimension.length += power * factor.dimension.length;
  unit.dimension.mass += power * factor.dimension.mass;
  unit.dimension.time += power * factor.dimension.time;
  unit.dimension.data += power * factor.dimension.data;
}

/// Takes the letters that the text starts with.
std::string_view take_name(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && std::isalpha(static_cast<unsigned char>(text[length]))) ++length;
  const std::string_view name = text.substr(0, length);
  text.remove_prefix(length);
  return name;
}

/// Takes "2", "^2", "-1" or "^-1"; 1 where the text starts with none of them.
int take_power(std::string_view& text) {
  const bool caret = !text.empty() && text.front() == '^';
  if (caret) text.remove_prefix(1);
  int power = 1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), power);
  const bool read = error == std::errc{};
  if ((caret && !read) || (read && (power == 0 || std::abs(power) > 9))) {
    throw InputError("the exponent must be an integer from 1 to 9 or from -9 to -1");
  }
  if (!read) return 1;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return power;
}

/// Takes the longest number that the text starts with.
std::string_view take_number(std::string_view& text) {
  double value = 0;
  const std::size_t sign = text.size() > 1 && text.front() == '+' && text[1] != '-' ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  if (error == std::errc::invalid_argument) throw InputError(fmt::format("\"{}\" is not a number", text));
  if (error != std::errc{}) throw InputError(fmt::format("\"{}\" is too large or too small", text));
  if (!std::isfinite(value)) throw InputError(fmt::format("\"{}\" is not finite", text));
  const std::string_view number = text.substr(sign, static_cast<std::size_t>(end - text.data()) - sign);
  text.remove_prefix(sign + number.size());
  return number;
}

/// The number, which take_number has checked, of this unit in SI.
double in_si(std::string_view number, const Unit& unit) {
  const auto e = number.find_first_of("eE");
  int exponent = 0;
  if (e != number.npos) {
    const std::size_t start = e + (number[e + 1] == '+' ? 2 : 1);
    std::from_chars(number.data() + start, number.data() + number.size(), exponent);
  }
  const std::string shifted = fmt::format("{}e{}", number.substr(0, e), exponent + unit.exponent);
  double value = 0;
  const auto result = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  value = value * unit.numerator / unit.denominator;
  if (result.ec != std::errc{} || !std::isfinite(value))
    throw InputError("the value is too large or too small");
  return value;
}

InputError unknown_unit(std::string_view name) {
  return InputError(fmt::format("unknown unit \"{}\"", name));
}

Unit take_product(std::string_view& text, std::string_view whole, bool in_brackets);

/// Takes a symbol, or a product in brackets, which has none itself.
Unit take_factor(std::string_view& text, std::string_view whole, bool in_brackets) {
  if (!in_brackets && text.starts_with('(')) {
    text.remove_prefix(1);
    const Unit product = take_product(text, whole, true);
    if (text.empty()) throw unknown_unit(whole);
    text.remove_prefix(1);
    return product;
  }
  const std::string_view name = take_name(text);
  const std::optional<Unit> symbol = find_symbol(name);
  if (!symbol) throw unknown_unit(name.empty() ? whole : name);
  return *symbol;
}

/// Takes factors up to the end of the text, or to the bracket that closes. `whole`: for messages.
Unit take_product(std::string_view& text, std::string_view whole, bool in_brackets) {
  Unit unit;
  int sign = 1;
  while (true) {
    text = trimmed(text);
    const Unit factor = take_factor(text, whole, in_brackets);
    multiply(unit, factor, sign * take_power(text));
    const bool blank = text.starts_with(' ');
    text = trimmed(text);
    if (text.empty() || (in_brackets && text.front() == ')')) return unit;
    sign = text.front() == '/' ? -1 : 1;
    if (text.front() == '/' || text.front() == '*')
      text.remove_prefix(1);
    else if (!blank)
      throw unknown_unit(whole);
  }
}

/// "a mass" where the dimension has a name, else its exponents.
std::string dimension_name(const Dimension& dimension) {
  if (dimension == Dimension{}) return "a pure number";
  for (const Quantity* quantity : kQuantities) {
    if (quantity->dimension == dimension) {
      return fmt::format("{} {}", quantity->name.front() == 'a' ? "an" : "a", quantity->name);
    }
  }
  return fmt::format("m^{} kg^{} s^{}{}", dimension.length, dimension.mass, dimension.time,
                     dimension.data == 0 ? "" : fmt::format(" B^{}", dimension.data));
}

}  // namespace

Unit parse_unit(std::string_view text) {
  const std::string ascii = in_ascii(trimmed(text));
  std::string_view rest = ascii;
  return take_product(rest, ascii, false);
}

double parse_number(std::string_view text) {
  return parse_number(text, Unit{});
}

double parse_number(std::string_view text, const Unit& unit) {
  std::string_view rest = trimmed(text);
  const std::string_view number = take_number(rest);
  if (!rest.empty()) throw InputError(fmt::format("\"{}\" is not a number", text));
  return in_si(number, unit);
}

double parse_ratio(std::string_view text) {
  const auto colon = text.find(':');
  if (const auto slash = text.find('/'); slash != std::string_view::npos && colon == std::string_view::npos) {
    std::string ratio(text);
    ratio[slash] = ':';
    throw InputError(
        fmt::format("\"{}\" is not a number; write {} or {:.6g}", text, ratio, parse_ratio(ratio)));
  }
  if (colon == std::string_view::npos) return parse_number(text);
  const double denominator = parse_number(text.substr(colon + 1));
  if (denominator == 0) throw InputError(fmt::format("\"{}\" divides by zero", text));
  return parse_number(text.substr(0, colon)) / denominator;
}

namespace {

/// "; write "0.5 us"" for "0,5 us"; empty where that is no such quantity either.
std::string with_point(std::string_view text, const Quantity& expected) {
  std::string pointed(trimmed(text));
  const std::size_t comma = pointed.find(',');
  const std::size_t end = std::min(pointed.find_first_not_of("0123456789", comma + 1), pointed.size());
  if (end - comma - 1 == 3) return "";  // perhaps thousands
  pointed[comma] = '.';
  try {
    parse_quantity(pointed, expected);
  } catch (const InputError&) {
    return "";
  }
  return fmt::format("; write \"{}\"", pointed);
}

}  // namespace

double parse_quantity(std::string_view text, const Quantity& expected, std::string_view unit) {
  std::string_view rest = trimmed(text);
  std::string number = "1";
  std::string example = "1";  // empty: with a unit that is unknown, the number is of another size
  Unit stated;
  try {
    example = number = take_number(rest);
    rest = trimmed(rest);
    if (rest.empty()) throw InputError(fmt::format("\"{}\" has no unit", text));
    example.clear();
    if (rest.front() == ',')
      throw InputError(
          fmt::format("\"{}\" has a decimal comma, not a point{}", text, with_point(text, expected)));
    stated = parse_unit(rest);
    example = number;
    if (stated.dimension != expected.dimension) {
      throw InputError(fmt::format("\"{}\" is {}", text, dimension_name(stated.dimension)));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; {}", error.what(), expectation(expected, example, unit)));
  }
  return in_si(number, stated);
}

double parse_option(std::string_view option, std::string_view text, const Quantity& expected) {
  try {
    return parse_quantity(text, expected);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}: {}", option, text, error.what()));
  }
}

std::string expectation(const Quantity& expected, const std::string& number, std::string_view unit) {
  const std::string example =
      number.empty() ? "" : fmt::format(", such as \"{} {}\"", number, unit.empty() ? expected.si : unit);
  return fmt::format("expected {}{} (units: {})", dimension_name(expected.dimension), example,
                     expected.accepted);
}

std::string format_quantity(double si, const std::string& unit) {
  const Unit parsed = parse_unit(unit);
  return fmt::format("{:.6g} {}", si * parsed.denominator / parsed.numerator / std::pow(10, parsed.exponent),
                     unit);
}

}  // namespace tread
