#include "drivers/studies/profile/shown_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "core/millimetre.hpp"
#include "io/profiles/profile_points.hpp"
#include "io/scene/problems.hpp"
#include "io/scene/profile_file.hpp"
#include "io/scene/table_reader.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class Names>
bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Kind of a file: by the options, its suffix, or the first word that `tread profile -o` writes.
bool is_wheel(const std::string& name, std::optional<bool> wanted) {
  if (wanted) return *wanted;
  const std::string suffix = lower_case(std::filesystem::path(name).extension().string());
  if (suffix == ".prw" || suffix == ".whl") return true;
  if (suffix == ".prr" || suffix == ".ban") return false;
  const std::string text = read_table_text(name);
  if (text.starts_with("# wheel:")) return true;
  if (text.starts_with("# rail:")) return false;
  throw InputError(fmt::format("{}: the suffix does not tell what it is; state --wheel or --rail", name));
}

ShownProfile built_in(const std::string& name) {
  ShownProfile shown;
  shown.name = name;
  shown.wheel = has(kBuiltInWheels, name);
  if (shown.wheel) {
    shown.curve = built_in_wheel(name).surface;
  } else {
    shown.section = built_in_rail(name);
    shown.curve = shown.section->running;
  }
  return shown;
}

}  // namespace

ShownProfile shown_profile(const std::string& name, std::optional<bool> wheel,
                           const ProfileOptions& options) {
  if (has(kBuiltInRails, name) || has(kBuiltInWheels, name)) {
    ShownProfile shown = built_in(name);
    if (wheel && *wheel != shown.wheel)
      throw InputError(fmt::format("{} is a {}, and a {} is wanted", name, shown.wheel ? "wheel" : "rail",
                                   *wheel ? "wheel" : "rail"));
    return shown;
  }
  if (!std::filesystem::exists(name))
    throw InputError(fmt::format("there is no file {}, and built in are {}, {}", name,
                                 fmt::join(kBuiltInRails, ", "), fmt::join(kBuiltInWheels, ", ")));
  ShownProfile shown;
  shown.name = name;
  shown.wheel = is_wheel(name, wheel);
  const ProfileWish wish{shown.wheel, options.mirrored && !shown.wheel,
                         parse_option("--shift", options.shift, kLength),
                         parse_option("--smoothing", options.smoothing, kLength)};
  std::vector<Problem> problems;
  shown.file = profile_of(read_table_text(name), name, wish, ColumnAxes::any, problems);
  if (!problems.empty()) throw ProblemsError(std::move(problems));
  try {
    if (shown.wheel) {
      shown.curve = wheel_from_table(shown.file->y, shown.file->z).surface;
    } else {
      if (!has(kBuiltInRails, options.section))
        throw InputError(
            fmt::format("--section {}: choose from {}", options.section, fmt::join(kBuiltInRails, ", ")));
      shown.curve = curve_through(shown.file->y, shown.file->z, "rail profile");
      shown.section =
          rail_with_head(shown.file->y, shown.file->z, built_in_rail(options.section), wish.shift);
      shown.curve = shown.section->running;
    }
  } catch (const InputError& error) {
    if (shown.curve.length() == 0) throw InputError(fmt::format("{}: {}", name, error.what()));
    shown.misfit = error.what();
  }
  return shown;
}

namespace {

/// y of the first point at height z on the way from y `from` to `to`; NaN where there is none.
double at_height(const PlaneCurve& curve, double from, double to, double z) {
  constexpr int kSamples = 2000;
  double before = curve.at(curve.at_x(from)).position.y - z;
  for (int i = 1; i <= kSamples; ++i) {
    const double y = from + (to - from) * i / kSamples;
    const double here = curve.at(curve.at_x(y)).position.y - z;
    if (before * here <= 0 && before != here) return y - (to - from) / kSamples * here / (here - before);
    before = here;
  }
  return kNone;
}

}  // namespace

ProfileMeasures measures_of(const ShownProfile& profile) {
  const PlaneCurve& curve = profile.curve;
  ProfileMeasures m;
  m.left = curve.start().x;
  m.right = curve.end().x;
  m.low = m.high = curve.start().y;
  double highest = m.left;
  for (int i = 0; i <= 4000; ++i) {
    const Point2 p = curve.at(curve.length() * i / 4000).position;
    m.low = std::min(m.low, p.y);
    if (p.y > m.high) highest = p.x;
    m.high = std::max(m.high, p.y);
  }
  const CurvePoint middle = curve.at(curve.at_x(0));
  m.slope = middle.tangent.y / middle.tangent.x;
  m.flange_height = m.flange_thickness = m.flange_gradient = m.head_width = m.head_middle = kNone;
  if (profile.wheel && highest < 0) {
    m.flange_height = m.high - middle.position.y;
    const double flank = at_height(curve, 0, highest, middle.position.y + 10 * mm);
    m.flange_thickness = flank + 70 * mm;
    m.flange_gradient = flank - at_height(curve, 0, highest, m.high - 2 * mm);
  } else if (!profile.wheel) {
    const double depth = m.high - 14 * mm;
    const double left = at_height(curve, highest, m.left, depth),
                 right = at_height(curve, highest, m.right, depth);
    m.head_width = right - left;
    m.head_middle = (left + right) / 2;
  }
  return m;
}

double curvature_at(const ShownProfile& profile, double y) {
  constexpr double kHalf = 0.5 * mm;
  const double s = profile.curve.at_x(y);
  if (s < kHalf || s > profile.curve.length() - kHalf) return kNone;
  const CurvePoint a = profile.curve.at(s - kHalf), b = profile.curve.at(s + kHalf);
  const double turn = std::atan2(cross(a.tangent, b.tangent), dot(a.tangent, b.tangent));
  return -turn / norm(b.position - a.position);  // the metal of both lies on the side of smaller z
}

}  // namespace tread
