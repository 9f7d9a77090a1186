#include "io/profiles/profile_format.hpp"

#include "io/profiles/column_profile.hpp"
#include "io/profiles/miniprof_profile.hpp"
#include "io/profiles/simpack_profile.hpp"
#include "io/text/text.hpp"

namespace tread {

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
    if (!leading_numbers(line, 2).empty()) return first ? ProfileFormat::two_columns : ProfileFormat::columns;
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
