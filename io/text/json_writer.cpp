#include "io/text/json_writer.hpp"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace tread {

namespace {

/// Length of the well-formed UTF-8 sequence at the start of `text`, 0 if there is none. [Unicode 15, table
/// 3-7]
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto within = [&](std::size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const auto tail = [&](std::size_t i) { return within(i, 0x80, 0xBF); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (within(0, 0xC2, 0xDF)) return tail(1) ? 2 : 0;
  if (within(0, 0xE0, 0xEF)) {
    const bool second = within(1, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF);
    return second && tail(2) ? 3 : 0;
  }
  if (within(0, 0xF0, 0xF4)) {
    const bool second = within(1, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF);
    return second && tail(2) && tail(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

JsonWriter& JsonWriter::begin_object() {
  return begin('{', true);
}
JsonWriter& JsonWriter::end_object() {
  return end('}', true);
}
JsonWriter& JsonWriter::begin_array() {
  return begin('[', false);
}
JsonWriter& JsonWriter::end_array() {
  return end(']', false);
}

JsonWriter& JsonWriter::key(std::string_view name) {
  if (scopes_.empty() || !scopes_.back().object || after_key_)
    throw std::logic_error("JsonWriter: key '" + std::string(name) + "' does not stand in an object");
  if (!scopes_.back().empty) text_ += ',';
  scopes_.back().empty = false;
  new_line();
  quote(name);
  text_ += ": ";
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(double number) {
  if (!std::isfinite(number)) return null();
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return raw({digits.data(), static_cast<std::size_t>(end - digits.data())});
}

JsonWriter& JsonWriter::value(bool truth) {
  return raw(truth ? "true" : "false");
}

JsonWriter& JsonWriter::value(std::string_view text) {
  place_value();
  quote(text);
  return *this;
}

std::string JsonWriter::text() const {
  if (!scopes_.empty() || text_.empty()) throw std::logic_error("JsonWriter: the text is not finished");
  return text_ + '\n';
}

JsonWriter& JsonWriter::raw(std::string_view token) {
  place_value();
  text_ += token;
  return *this;
}

JsonWriter& JsonWriter::begin(char bracket, bool object) {
  place_value();
  text_ += bracket;
  scopes_.push_back({object, true});
  return *this;
}

JsonWriter& JsonWriter::end(char bracket, bool object) {
  if (scopes_.empty() || scopes_.back().object != object || after_key_)
    throw std::logic_error(fmt::format("JsonWriter: '{}' closes nothing", bracket));
  const bool empty = scopes_.back().empty;
  scopes_.pop_back();
  if (!empty) new_line();
  text_ += bracket;
  return *this;
}

void JsonWriter::place_value() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (scopes_.empty()) {
    if (!text_.empty()) throw std::logic_error("JsonWriter: a second value at the top");
    return;
  }
  if (scopes_.back().object) throw std::logic_error("JsonWriter: a value in an object needs a key");
  if (!scopes_.back().empty) text_ += ',';
  scopes_.back().empty = false;
  new_line();
}

void JsonWriter::new_line() {
  if (layout_ == Layout::indented)
    text_ += '\n' + std::string(2 * scopes_.size(), ' ');
  else if (text_.back() == ',')
    text_ += ' ';
}

void JsonWriter::quote(std::string_view text) {
  text_ += '"';
  while (!text.empty()) {
    const char c = text.front();
    const std::size_t length = utf8_length(text);
    if (c == '"' || c == '\\')
      (text_ += '\\') += c;
    else if (c == '\n')
      text_ += "\\n";
    else if (c == '\t')
      text_ += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20)
      text_ += fmt::format("\\u{:04x}", static_cast<int>(c));
    else if (length == 0)
      text_ += "\\ufffd";
    else
      text_ += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  text_ += '"';
}

}  // namespace tread
