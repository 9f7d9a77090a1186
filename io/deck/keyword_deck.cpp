#include "io/deck/keyword_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20U;  // handed on at once [characters]

/// The number with as many digits as `width` characters take.
std::string digits(double number, int width) {
  std::string text = fmt::format("{}", number);
  for (int precision = width - 1; static_cast<int>(text.size()) > width && precision > 0; --precision)
    text = fmt::format("{:.{}g}", number, precision);
  return text;
}

/// Size of the whole UTF-8 characters at the start of a text that `most` bytes hold [B].
std::size_t whole_characters(std::string_view text, std::size_t most) {
  std::size_t size = std::min(text.size(), most);
  while (size > 0 && size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80) --size;
  return size;
}

}  // namespace

void DeckField::append(std::string& line, int width) const {
  std::string text;
  if (const auto* integer = std::get_if<std::int64_t>(&value_)) text = fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&value_)) text = digits(*number, width - 1);
  if (const auto* word = std::get_if<std::string_view>(&value_)) text = *word;
  if (static_cast<int>(text.size()) > width)
    throw InputError(
        fmt::format("the keyword deck has no room for {} in {} characters; make the elements larger or the "
                    "model shorter",
                    text, width));
  const bool word = std::holds_alternative<std::string_view>(value_);
  line += word ? fmt::format("{:<{}}", text, width) : fmt::format("{:>{}}", text, width);
}

void KeywordDeck::keyword(std::string_view name) {
  text_ += name;
  end_line();
}

void KeywordDeck::remark(std::string_view text) {
  constexpr std::size_t kRoom = kDeckLine - 2;
  do {
    std::size_t length = text.size();
    if (length > kRoom) {
      length = text.rfind(' ', kRoom);
      if (length == std::string_view::npos || length == 0) length = kRoom;
    }
    text_ += "$ ";
    text_ += text.substr(0, length);
    end_line();
    text.remove_prefix(std::min(text.size(), length));
    if (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  } while (!text.empty());
}

void KeywordDeck::names(std::span<const int> widths, std::initializer_list<std::string_view> names) {
  std::string line;
  auto width = widths.begin();
  for (const std::string_view name : names) line += fmt::format("{:>{}}", name, *width++);
  line.replace(0, 2, "$#");
  text_ += line;
  end_line();
}

void KeywordDeck::title(std::string_view text) {
  std::string line = one_line(std::string(text));
  if (line.starts_with('*') || line.starts_with('$'))
    line.insert(line.begin(), ' ');  // else a card or a remark
  line.resize(whole_characters(line, kDeckLine - 10));
  text_ += line;
  end_line();
}

void KeywordDeck::card(std::span<const int> widths, Fields fields) {
  TREAD_EXPECT(fields.size() <= widths.size());
  auto width = widths.begin();
  for (const DeckField& field : fields) field.append(text_, *width++);
  end_line();
}

void KeywordDeck::list(std::span<const std::int64_t> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    DeckField(numbers[i]).append(text_, kTens[0]);
    if (i % kTens.size() == kTens.size() - 1 || i + 1 == numbers.size()) end_line();
  }
}

void KeywordDeck::finish() {
  sink_(text_);
  text_.clear();
}

void KeywordDeck::end_line() {
  text_ += '\n';
  if (text_.size() >= kPiece) finish();
}

}  // namespace tread
