#include "io/scene/profile_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "io/profiles/profile_format.hpp"
#include "io/profiles/profile_points.hpp"
#include "io/scene/profile_checks.hpp"
#include "io/scene/table_reader.hpp"

namespace tread {

namespace {

constexpr const char* kTwoColumns = "two columns";

/// Two columns whose axes are those of the documentation. Throws InputError for others.
UnderstoodProfile documented(TwoColumns columns, const ProfileWish& wish) {
  if (wish.mirrored) {
    std::reverse(columns.first.begin(), columns.first.end());
    std::reverse(columns.second.begin(), columns.second.end());
    for (double& y : columns.first) y = -y;
  }
  for (double& y : columns.first) y += wish.shift;
  require_width(columns.first, wish.wheel, "the points",
                "is the file whole? two columns are in mm, unless a line such as `# y [m]  z [m]` states "
                "other units");
  if (wish.wheel) require_circle(columns.first, wish.shift);
  const std::string fault = wish.wheel ? wheel_profile_fault(columns) : rail_profile_fault(columns);
  if (!fault.empty())
    throw InputError(fmt::format("{} (`tread profile FILE {} -o clean.txt` does it)", fault,
                                 wish.wheel ? "--wheel" : "--rail"));
  UnderstoodProfile profile;
  profile.format = kTwoColumns;
  profile.units = "stated or mm";
  profile.points = static_cast<int>(columns.first.size());
  profile.mirrored = wish.mirrored;
  if (columns.first.size() < kFewestProfilePoints)
    profile.notes.push_back(
        fmt::format("fewer than {} points give radii only roughly", kFewestProfilePoints));
  profile.y = std::move(columns.first);
  profile.z = std::move(columns.second);
  finish(profile, {.smoothing = wish.smoothing});
  return profile;
}

UnderstoodProfile read(const std::string& text, const std::filesystem::path& path, const ProfileWish& wish,
                       ColumnAxes axes, std::vector<Problem>& problems) {
  const std::size_t known = problems.size();
  const ProfileFormat format = profile_format(text, path);
  FilePoints points;
  if (format == ProfileFormat::two_columns) {
    const bool strict = axes == ColumnAxes::as_documented;
    TwoColumns columns =
        parse_two_columns(text, path, {.increasing = strict, .names = kProfileNames}, problems);
    if (problems.size() > known) return {};
    if (strict) return documented(std::move(columns), wish);
    points.format = kTwoColumns;
    points.units = "stated or mm";
    points.y = std::move(columns.first);
    points.z = std::move(columns.second);
  } else {
    std::vector<LineFault> faults;
    points = read_profile_points(format, text, faults);
    for (const LineFault& fault : faults)
      problems.push_back({path.string(), fault.line, 0, "", fault.message});
    if (!faults.empty()) return {};
  }
  return understand(std::move(points), wish);
}

}  // namespace

ProfileWish wish_of(const WheelSpec& wheel) {
  return {true, false, wheel.profile_shift, wheel.profile_smoothing};
}

ProfileWish wish_of(const RailSpec& rail) {
  return {false, rail.profile_mirrored, rail.profile_shift, rail.profile_smoothing};
}

UnderstoodProfile profile_of(const std::string& text, const std::filesystem::path& path,
                             const ProfileWish& wish, ColumnAxes axes, std::vector<Problem>& problems) {
  try {
    return read(text, path, wish, axes, problems);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace tread
