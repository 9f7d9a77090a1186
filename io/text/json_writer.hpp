#pragma once
// JSON text, written from front to back.

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tread {

/// Builds one JSON value. Inside an object every value follows a key (`member` does both); numbers keep their
/// shortest form that reads back to the same bits, values that are not finite become null, and bytes that are
/// not UTF-8 become U+FFFD. Calls out of order throw std::logic_error.
class JsonWriter {
 public:
  enum class Layout { indented, line };
  explicit JsonWriter(Layout layout = Layout::indented) : layout_(layout) {}

  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);

  JsonWriter& value(double number);
  JsonWriter& value(bool truth);
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(std::integral auto number) { return raw(std::to_string(number)); }
  JsonWriter& null() { return raw("null"); }

  template <class T>
  JsonWriter& member(std::string_view name, const T& content) {
    return key(name).value(content);
  }

  /// The finished text, indented by two spaces or in one line, with a closing newline.
  std::string text() const;

 private:
  struct Scope {
    bool object;
    bool empty;
  };

  JsonWriter& raw(std::string_view token);
  JsonWriter& begin(char bracket, bool object);
  JsonWriter& end(char bracket, bool object);
  void place_value();
  void new_line();
  void quote(std::string_view text);

  Layout layout_;
  std::string text_;
  std::vector<Scope> scopes_;
  bool after_key_ = false;
};

}  // namespace tread
