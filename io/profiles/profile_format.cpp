#include "io/profiles/profile_format.hpp"

#include <algorithm>
#include <vector>

#include "io/profiles/column_profile.hpp"
#include "io/profiles/miniprof_profile.hpp"
#include "io/profiles/simpack_profile.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// Returns true for a first line that is a title or a count although it begins with a number: "60E1 worn",
/// "45". A row that is cut off or holds something else, "12.5,abc", is none.
bool is_title(const std::string& line) {
  const std::vector<double> numbers = leading_numbers(line, 2);
  if (numbers.empty()) return true;
  const std::size_t word = std::min(line.find_first_of(" \t"), line.size());
  return numbers.size() == 1 && line.find_first_of(".,;+-") >= word;
}

}  // namespace

ProfileFormat profile_format(const std::string& text, const std::filesystem::path& path) {
  const std::string suffix = lower_case(path.extension().string());
  if (suffix == ".prr" || suffix == ".prw") return ProfileFormat::simpack;
  if (suffix == ".ban" || suffix == ".whl") return ProfileFormat::miniprof;
  bool first = true;
  for (const std::string& whole : lines_of(text)) {
    const std::string line = lower_case(trimmed(whole));
    if (line == "header.begin" || line == "spline.begin" || line == "point.begin")
      return ProfileFormat::simpack;
    if (line.starts_with("mptypeno=") || line.starts_with("xypoints=") || line.starts_with("columndef=") ||
        line.starts_with("miniprof") || line.starts_with("#miniwheelprof"))
      return ProfileFormat::miniprof;
    if (line.empty() || line.starts_with('#')) continue;
    if (first && !is_title(line)) return ProfileFormat::two_columns;
    if (!first && !leading_numbers(line, 2).empty()) return ProfileFormat::columns;
    first = false;
  }
  return ProfileFormat::two_columns;
}

FilePoints read_profile_points(ProfileFormat format, const std::string& text,
                               std::vector<LineFault>& faults) {
  if (format == ProfileFormat::simpack) return read_simpack_profile(text, faults);
  if (format == ProfileFormat::miniprof) return read_miniprof_profile(text, faults);
  return read_column_profile(text, faults);
}

}  // namespace tread
