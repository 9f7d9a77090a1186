#include "io/profiles/miniprof_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/millimetre.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

class MiniprofParser {
 public:
  explicit MiniprofParser(std::vector<LineFault>& faults) : faults_(faults) {}

  FilePoints parse(const std::string& text) {
    const std::size_t known = faults_.size();
    for (const std::string& line : lines_of(text)) {
      ++number_;
      read(std::string(trimmed(line)));
    }
    number_ = 0;
    if (announced_ > held_)
      fault(fmt::format("the header announces {} points (XYPoints), the file holds {}: is it cut off?",
                        announced_, held_));
    if (faults_.size() == known) change();
    return std::move(points_);
  }

 private:
  void fault(const std::string& message) { faults_.push_back({number_, message}); }

  void read(const std::string& line) {
    const bool comment = line.starts_with('"') || line.starts_with('!') || line.starts_with('%');
    if (in_data_ && comment && leading_numbers(line.substr(1), 2).size() == 2) ++held_;
    if (line.empty() || comment) {
      in_data_ = in_data_ || (line.empty() && seen_header_);
      return;
    }
    const std::size_t equals = line.find('=');
    if (!in_data_ && equals != std::string::npos) {
      seen_header_ = true;
      read_value(line.substr(0, equals), std::string(trimmed(std::string_view(line).substr(equals + 1))));
      return;
    }
    const std::string word = lower_case(line);
    const bool title = word.find("miniprof") != std::string::npos || word.starts_with('#');
    if (!in_data_ && (title || old_)) {
      old_ = seen_header_ = true;
      return;
    }
    in_data_ = true;
    read_point(line);
  }

  void read_value(const std::string& key, const std::string& value) {
    const std::string name = lower_case(trimmed(key));
    const std::vector<double> number = leading_numbers(value, 1);
    if (name == "columndef") read_columns(value);
    if (name == "side" || name == "rail") points_.side = value;
    // The makers' meaning of both is not public; CONTACT does not apply them either.
    if ((name == "tilt" || name == "basetilt") && !number.empty() && number[0] != 0)
      points_.notes.push_back(fmt::format("{} = {:g} of the header not applied", key, number[0]));
    const bool numeric = name == "xoffset" || name == "yoffset" || name == "xypoints" || name == "mptypeno";
    if (!numeric || value.empty()) return;
    if (!with_decimal_points(value).empty()) {
      fault(comma_fault(fmt::format("{}={}", key, value)));
      return;
    }
    if (number.empty()) {
      fault(fmt::format("{}={}: expected a number", key, value.substr(0, 60)));
      return;
    }
    if (name == "xoffset") x_offset_ = number[0];
    if (name == "yoffset") y_offset_ = number[0];
    if (name == "xypoints" && number[0] > 0 && number[0] < 1e7)
      announced_ = static_cast<std::size_t>(number[0]);
    if (name == "mptypeno" && number[0] >= 100 && number[0] < 300) points_.wheel = number[0] < 200;
  }

  void read_columns(const std::string& value) {
    std::string names = lower_case(value);
    names.erase(std::remove_if(names.begin(), names.end(), [](char c) { return c == ',' || c == ' '; }),
                names.end());
    const std::size_t x = names.find('x'), y = names.find('y');
    if (x == std::string::npos || y == std::string::npos || std::max(x, y) > 8) {
      fault(fmt::format("ColumnDef={}: expected the columns X and Y, such as X,Y,A", value.substr(0, 60)));
      return;
    }
    x_column_ = x;
    y_column_ = y;
  }

  void read_point(const std::string& line) {
    if (has_decimal_commas(line)) {
      ++held_;
      fault(comma_fault(line));
      return;
    }
    const std::size_t needed = std::max(x_column_, y_column_) + 1;
    const std::vector<double> numbers = leading_numbers(line, needed);
    if (numbers.size() < needed) {
      fault(fmt::format("\"{}\": expected a row of numbers, X in column {} and Y in column {}",
                        line.substr(0, 60), x_column_ + 1, y_column_ + 1));
      return;
    }
    ++held_;
    points_.y.push_back(numbers[x_column_]);
    points_.z.push_back(numbers[y_column_]);
  }

  void change() {
    points_.format = "MiniProf";
    for (double& at : points_.y) at = (at + x_offset_) * mm;
    for (double& at : points_.z) at = (at + y_offset_) * mm;
    if (x_offset_ != 0 || y_offset_ != 0)
      points_.notes.push_back(fmt::format("offsets {:g} and {:g} mm added", x_offset_, y_offset_));
    if (announced_ > 0 && held_ > announced_)
      points_.notes.push_back(fmt::format("the header announces {} points, {} are there", announced_, held_));
  }

  std::vector<LineFault>& faults_;
  FilePoints points_;
  double x_offset_ = 0, y_offset_ = 0;
  std::size_t x_column_ = 0, y_column_ = 1;
  std::size_t announced_ = 0, held_ = 0;  ///< commented points count too
  int number_ = 0;
  bool in_data_ = false, seen_header_ = false, old_ = false;
};

}  // namespace

FilePoints read_miniprof_profile(const std::string& text, std::vector<LineFault>& faults) {
  return MiniprofParser(faults).parse(text);
}

}  // namespace tread
