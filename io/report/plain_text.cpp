#include "io/report/plain_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace tread {

namespace {

/// Number of characters of a UTF-8 text.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t to, Align align) {
  const std::size_t missing = to - width(text);
  std::string out(align == Align::right ? missing : 0, ' ');
  out.append(text);
  if (align == Align::left) out.append(missing, ' ');
  return out;
}

}  // namespace

std::string plain_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::size_t widest = width(table.columns[i].title);
    for (const auto& row : table.rows) widest = std::max(widest, width(row[i]));
    widths.push_back(widest);
  }
  const auto line = [&](const auto& text_of) {
    std::string text;
    for (std::size_t i = 0; i < widths.size(); ++i)
      text.append(2, ' ').append(padded(text_of(i), widths[i], table.columns[i].align));
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
    return text;
  };
  std::string text = table.title;
  if (!text.empty()) text += '\n';
  text += line([&](std::size_t i) { return table.columns[i].title; });
  for (const auto& row : table.rows) text += line([&](std::size_t i) { return row[i]; });
  return text;
}

std::string markdown(const Table& table) {
  std::string head = "|", rule = "|", rows;
  for (const Column& column : table.columns) {
    head += fmt::format(" {} |", column.title);
    rule += column.align == Align::right ? "--:|" : "---|";
  }
  for (const auto& row : table.rows) {
    rows += "|";
    for (const std::string& cell : row) rows += fmt::format(" {} |", cell);
    rows += "\n";
  }
  return head + "\n" + rule + "\n" + rows;
}

std::string grouped(std::int64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const std::size_t left = digits.size() - i;
    if (left % 3 == 0 && i > 0 && digits[i - 1] != '-') text += ' ';
    text += digits[i];
  }
  return text;
}

std::string bytes_text(std::int64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value < 1e3) return fmt::format("{} B", bytes);
  if (value < 1e6) return fmt::format("{:.1f} kB", value / 1e3);
  if (value < 1e9) return fmt::format("{:.1f} MB", value / 1e6);
  return fmt::format("{:.2f} GB", value / 1e9);
}

}  // namespace tread
