#include "io/profiles/simpack_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/text/text.hpp"

namespace tread {

namespace {

/// The line without its comment, which begins with '!' or '%' outside of quotes.
std::string without_comment(const std::string& line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') quoted = !quoted;
    if (!quoted && (line[i] == '!' || line[i] == '%')) return line.substr(0, i);
  }
  return line;
}

class SimpackParser {
 public:
  explicit SimpackParser(std::vector<LineFault>& faults) : faults_(faults) {}

  FilePoints parse(const std::string& text) {
    const std::size_t known = faults_.size();
    for (const std::string& line : lines_of(text)) {
      ++number_;
      read(std::string(trimmed(without_comment(line))));
    }
    number_ = 0;
    if (!begun_)
      fault(
          "there is no line point.begin; a profile of SIMPACK has its points between point.begin and "
          "point.end");
    else if (!ended_)
      fault("there is no line point.end: is the file cut off?");
    if (faults_.size() == known) change();
    return std::move(points_);
  }

 private:
  void fault(const std::string& message) { faults_.push_back({number_, message}); }

  void read(const std::string& line) {
    if (line.empty() || ended_) return;
    const std::string word = lower_case(line);
    if (word == "header.begin" || word == "spline.begin") section_ = word.substr(0, 6);
    if (word == "point.begin") begun_ = true;
    if (word == "point.end") {
      ended_ = true;
      if (!begun_) fault("point.end stands before point.begin");
    }
    if (word.ends_with(".begin") || word.ends_with(".end")) return;
    if (begun_)
      read_point(line);
    else
      read_value(line);
  }

  void read_point(const std::string& line) {
    if (has_decimal_commas(line)) {
      fault(comma_fault(line));
      return;
    }
    const std::vector<double> numbers = leading_numbers(line, 4);
    const bool whole = !numbers.empty() && std::isfinite(numbers.back()) && counted(line) == numbers.size();
    if (!whole || numbers.size() < 2 || numbers.size() > 3) {
      fault(fmt::format("\"{}\": expected y and z and perhaps a weight", line.substr(0, 60)));
      return;
    }
    points_.y.push_back(numbers[0]);
    points_.z.push_back(numbers[1]);
  }

  static std::size_t counted(const std::string& line) {
    std::size_t words = 0;
    bool inside = false;
    for (const char c : line) {
      const bool blank = c == ' ' || c == '\t' || c == ',' || c == ';';
      if (!blank && !inside) ++words;
      inside = !blank;
    }
    return words;
  }

  void read_value(const std::string& line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      fault(
          fmt::format("\"{}\": expected key = value, or point.begin before the points", line.substr(0, 60)));
      return;
    }
    const std::string key = lower_case(trimmed(std::string_view(line).substr(0, equals)));
    const std::string value(trimmed(std::string_view(line).substr(equals + 1)));
    const bool numeric = std::find(kNumbers.begin(), kNumbers.end(), key) != kNumbers.end();
    if (!numeric && key != "type") return;
    if (!with_decimal_points(value).empty()) {
      fault(comma_fault(line));
      return;
    }
    const std::vector<double> numbers = leading_numbers(value, 1);
    if (numbers.empty()) {
      fault(fmt::format("{} = {}: expected a number", key, value.substr(0, 60)));
      return;
    }
    if (key == "type" && section_ != "header") return;
    if (key == "type") {
      if (numbers[0] != 0 && numbers[0] != 1)
        fault(fmt::format("type = {}: expected 0 for a rail or 1 for a wheel", value));
      points_.wheel = numbers[0] == 1;
    } else {
      values_[key] = numbers[0];
      if (key == "units.len.f" && !(numbers[0] > 0))
        fault(fmt::format("units.len.f = {}: expected the number of units in a metre, 1000 for mm", value));
    }
  }

  double value(const std::string& key, double absent) const {
    const auto found = values_.find(key);
    return found == values_.end() ? absent : found->second;
  }

  void change() {
    if (value("rotate", 0) != 0) {
      fault(
          fmt::format("rotate = {:g}: a rotation in the file is not read; set it to 0 and state "
                      "rail.inclination",
                      value("rotate", 0)));
      return;
    }
    std::vector<double>&y = points_.y, &z = points_.z;
    thin(value("point.dist.min", 0));
    for (double& at : y) at += value("shift.y", 0);
    for (double& at : z) at += value("shift.z", 0);
    bound(value("bound.y.min", 1), value("bound.y.max", 0));
    if (const double low = value("bound.z.min", 1), high = value("bound.z.max", 0); low < high)
      for (double& at : z) at = std::clamp(at, low, high);
    turn(y, "mirror.y");
    turn(z, "mirror.z");
    const double per_metre = value("units.len.f", 1000);
    points_.format = "SIMPACK";
    points_.units = per_metre == 1000 ? "mm" : per_metre == 1 ? "m" : fmt::format("m / {:g}", per_metre);
    if (!values_.contains("units.len.f")) points_.units += " (assumed)";
    for (double& at : y) at /= per_metre;
    for (double& at : z) at /= per_metre;
    for (const char* key : {"shift.y", "shift.z"})
      if (value(key, 0) != 0) points_.notes.push_back(fmt::format("{} = {:g} added", key, value(key, 0)));
    if (value("approx.smooth", 0) != 0)
      points_.notes.emplace_back("approx.smooth of the file is not used: state profile_smoothing");
  }

  void turn(std::vector<double>& values, const char* key) {
    if (value(key, 0) != 1) return;
    for (double& at : values) at = -at;
    points_.notes.push_back(fmt::format("{} = 1 applied", key));
  }

  void thin(double least) {
    std::vector<double> y, z;
    for (std::size_t i = 0; i < points_.y.size(); ++i)
      if (y.empty() || std::hypot(points_.y[i] - y.back(), points_.z[i] - z.back()) >= least) {
        y.push_back(points_.y[i]);
        z.push_back(points_.z[i]);
      }
    points_.y = std::move(y);
    points_.z = std::move(z);
  }

  void bound(double low, double high) {
    if (!(low < high)) return;
    std::vector<double> y, z;
    for (std::size_t i = 0; i < points_.y.size(); ++i)
      if (points_.y[i] >= low && points_.y[i] <= high) {
        y.push_back(points_.y[i]);
        z.push_back(points_.z[i]);
      }
    points_.y = std::move(y);
    points_.z = std::move(z);
  }

  static inline const std::vector<std::string> kNumbers = {
      "approx.smooth", "point.dist.min", "shift.y",     "shift.z",  "rotate",   "bound.y.min",
      "bound.y.max",   "bound.z.min",    "bound.z.max", "mirror.y", "mirror.z", "units.len.f"};

  std::vector<LineFault>& faults_;
  FilePoints points_;
  std::map<std::string, double> values_;
  std::string section_;
  int number_ = 0;
  bool begun_ = false, ended_ = false;
};

}  // namespace

FilePoints read_simpack_profile(const std::string& text, std::vector<LineFault>& faults) {
  return SimpackParser(faults).parse(text);
}

}  // namespace tread
