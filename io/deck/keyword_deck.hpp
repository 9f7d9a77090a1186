#pragma once
// Text of an LS-DYNA keyword deck: keywords, remarks and cards of fields with fixed widths.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace tread {

/// Longest line of a deck [characters].
inline constexpr std::size_t kDeckLine = 80;

/// A value of a card: an integer, a number, a word, or blank (the reader's default).
class DeckField {
 public:
  DeckField() = default;
  DeckField(std::string_view word) : value_(word) {}
  DeckField(const char* word) : value_(std::string_view(word)) {}
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  DeckField(Number number) {
    if constexpr (std::is_integral_v<Number>)
      value_ = static_cast<std::int64_t>(number);
    else
      value_ = static_cast<double>(number);
  }

  /// Appends the value in `width` characters: words flush left, numbers flush right with as many digits as
  /// leave a blank before them. InputError for an integer or a word that is too wide.
  void append(std::string& line, int width) const;

 private:
  std::variant<std::monostate, std::int64_t, double, std::string_view> value_;
};

class KeywordDeck {
 public:
  using Sink = std::function<void(std::string_view text)>;
  using Fields = std::initializer_list<DeckField>;

  /// Hands the text on to `sink` in pieces; the rest in finish().
  explicit KeywordDeck(Sink sink) : sink_(std::move(sink)) {}

  /// Begins a keyword, "*NODE".
  void keyword(std::string_view name);
  /// A comment; long ones are broken between words.
  void remark(std::string_view text);
  /// Names of a card's fields as a comment, each of one word.
  void names(std::initializer_list<std::string_view> names) { this->names(kTens, names); }
  void names(std::span<const int> widths, std::initializer_list<std::string_view> names);
  /// A line of free text, such as a part's title, cut to the line's length. Blanks stand in place of line
  /// breaks.
  void title(std::string_view text);
  /// A card of up to eight fields of ten characters.
  void card(Fields fields) { card(kTens, fields); }
  /// A card whose fields have these widths [characters].
  void card(std::span<const int> widths, Fields fields);
  /// Cards of eight integers of ten characters.
  void list(std::span<const std::int64_t> numbers);

  /// Ends the deck.
  void finish();

 private:
  static constexpr std::array<int, 8> kTens = {10, 10, 10, 10, 10, 10, 10, 10};

  void end_line();

  Sink sink_;
  std::string text_;
};

/// Widths of the cards that are not made of tens.
inline constexpr std::array<int, 4> kNodeCard = {8, 16, 16, 16};
inline constexpr std::array<int, 10> kEightsCard = {8, 8, 8, 8, 8, 8, 8, 8, 8, 8};
inline constexpr std::array<int, 3> kMassCard = {8, 8, 16};
inline constexpr std::array<int, 2> kCurveCard = {20, 20};

/// Largest number of a node or an element in eight characters.
inline constexpr std::int64_t kLargestDeckNumber = 99'999'999;

}  // namespace tread
