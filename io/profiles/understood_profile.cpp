#include "io/profiles/understood_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "core/geometry/smoothing_spline.hpp"
#include "core/millimetre.hpp"
#include "io/profiles/profile_cleaning.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// From the flange's back to the nominal rolling circle. [EN 13715]
constexpr double kBackToCircle = 70 * mm;

struct Range {
  double low, high;
};

Range range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

void turn(std::vector<double>& values) {
  for (double& value : values) value = -value;
}

void check_number(const UnderstoodProfile& p) {
  if (p.y.size() < kFewestProfilePoints)
    throw InputError(fmt::format("{} points: a profile needs at least {}", p.y.size(), kFewestProfilePoints));
}

void check_kept_points(const UnderstoodProfile& p, bool wheel) {
  check_number(p);
  require_width(p.y, wheel, fmt::format("after {} points beyond the surface are cut, the others", p.cut),
                wheel ? "is y zero at the nominal rolling circle or at the flange's back?"
                      : "is it a whole rail head?");
}

/// Returns true where a wheel's y begins at the flange's back.
bool is_from_back(double low) {
  constexpr double kBeside = 20 * mm;
  return low > -kBeside;
}

/// z of the point nearest to the middle of the width.
double middle_z(const UnderstoodProfile& p) {
  const auto [low, high] = range_of(p.y);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < p.y.size(); ++i)
    if (std::abs(p.y[i] - (low + high) / 2) < std::abs(p.y[nearest] - (low + high) / 2)) nearest = i;
  return p.z[nearest];
}

struct FlangeTip {
  double y = 0, height = 0;  ///< height 0: there is none
};

/// Farthest point on the side `sign` of the tread that is an end neither of the width nor of the rows: the
/// backs of flange and rim go deep too.
FlangeTip flange_tip(const UnderstoodProfile& p, double sign) {
  constexpr double kFromEnd = 4 * mm, kLeast = 15 * mm;
  const auto [low, high] = range_of(p.y);
  const double middle = middle_z(p);
  FlangeTip tip;
  std::size_t at = 0;
  for (std::size_t i = 0; i < p.y.size(); ++i)
    if (const double height = sign * (p.z[i] - middle); height > tip.height) {
      tip = {p.y[i], height};
      at = i;
    }
  const bool inside = at > 1 && at + 2 < p.y.size() && tip.y - low > kFromEnd && high - tip.y > kFromEnd;
  return tip.height >= kLeast && inside ? tip : FlangeTip{};
}

void orient_wheel(UnderstoodProfile& p) {
  const FlangeTip down = flange_tip(p, 1), up = flange_tip(p, -1);
  if (!(down.height > 0) && !(up.height > 0))
    throw InputError(
        "no flange of 15 mm or more is found: is it a whole wheel? a rail is read by rail.profile");
  p.z_turned = up.height > down.height;
  if (p.z_turned) turn(p.z);
  double tip = p.z_turned ? up.y : down.y;
  const auto [low, high] = range_of(p.y);
  p.mirrored = tip > (low + high) / 2;
  if (p.mirrored) turn(p.y);
  if (is_from_back(range_of(p.y).low)) {
    p.from_back = kBackToCircle;
    for (double& y : p.y) y -= kBackToCircle;
  }
}

void orient_rail(UnderstoodProfile& p, bool mirrored) {
  constexpr double kRise = 1 * mm;
  const double ends = (p.z.front() + p.z.back()) / 2, middle = middle_z(p);
  if (std::abs(middle - ends) < kRise)
    throw InputError(
        fmt::format("the middle lies {:.2g} mm from the line between the ends: is it a whole rail head? a "
                    "wheel is read by wheel.profile",
                    std::abs(middle - ends) / mm));
  p.z_turned = middle < ends;
  if (p.z_turned) turn(p.z);
  p.mirrored = mirrored;
  if (mirrored) turn(p.y);
}

}  // namespace

void require_width(const std::vector<double>& y, bool wheel, const std::string& points,
                   const std::string& doubt) {
  const auto [low, high] = range_of(y);
  const Range allowed = wheel ? Range{90 * mm, 200 * mm} : Range{40 * mm, 200 * mm};
  if (!(high - low >= allowed.low && high - low <= allowed.high))
    throw InputError(fmt::format("{} are {:.4g} mm wide; a {} profile has {:g} to {:g} mm: {}", points,
                                 (high - low) / mm, wheel ? "whole wheel" : "rail", allowed.low / mm,
                                 allowed.high / mm, doubt));
}

void require_circle(const std::vector<double>& y, double shift) {
  const auto [low, high] = range_of(y);
  if (!is_from_back(low)) return;
  throw InputError(fmt::format(
      "y = {:.1f} ... {:.1f} mm counts from the flange's back, not from the nominal rolling circle; "
      "wheel.profile_shift = \"{:g} mm\" corrects it",
      low / mm, high / mm, (shift - kBackToCircle) / mm));
}

double UnderstoodProfile::largest_deviation() const {
  return deviation.empty() ? 0 : *std::max_element(deviation.begin(), deviation.end());
}

void finish(UnderstoodProfile& p, const ProfileWish& wish) {
  for (double& y : p.y) y += wish.shift;
  if (wish.smoothing > 0) p.duplicates += remove_duplicates(p.y, p.z);
  p.raw_y = p.y;
  p.raw_z = p.z;
  if (!(wish.smoothing > 0) || p.y.size() < 4) return;
  p.deviation = smooth(p.y, p.z, wish.smoothing);
  for (std::size_t i = 1; i < p.y.size(); ++i)
    if (!(p.y[i] > p.y[i - 1]))
      throw InputError(fmt::format(
          "smoothing by {:g} mm folds the profile at y = {:.2f} mm; state a smaller profile_smoothing",
          wish.smoothing / mm, p.y[i] / mm));
}

UnderstoodProfile understand(FilePoints points, const ProfileWish& wish) {
  if (points.wheel && *points.wheel != wish.wheel)
    throw InputError(fmt::format("the file says that it holds a {}, and a {} is wanted",
                                 *points.wheel ? "wheel" : "rail", wish.wheel ? "wheel" : "rail"));
  UnderstoodProfile p;
  p.format = std::move(points.format);
  p.units = std::move(points.units);
  p.side = std::move(points.side);
  p.notes = std::move(points.notes);
  p.points = static_cast<int>(points.y.size());
  p.y = std::move(points.y);
  p.z = std::move(points.z);
  p.duplicates = remove_duplicates(p.y, p.z);
  check_number(p);
  require_width(p.y, wish.wheel, "the points", fmt::format("are the units {} right?", p.units));
  if (wish.wheel)
    orient_wheel(p);
  else
    orient_rail(p, wish.mirrored);
  const bool falls = p.y.front() > p.y.back();
  p.reversed = falls != p.mirrored;
  if (falls) {
    std::reverse(p.y.begin(), p.y.end());
    std::reverse(p.z.begin(), p.z.end());
  }
  p.spikes = remove_spikes(p.y, p.z);
  const Kept kept = wish.wheel ? keep_tread_and_flange(p.y, p.z) : keep_head(p.y, p.z);
  p.folded = kept.folded;
  p.cut = kept.cut;
  check_kept_points(p, wish.wheel);
  if (!wish.wheel && !wish.mirrored && lower_case(p.side).starts_with('r'))
    p.notes.emplace_back("a right rail may need rail.profile_mirrored = true");
  finish(p, wish);
  return p;
}

std::string reading_of(const UnderstoodProfile& p) {
  std::string text = fmt::format("{}, {}, {} points", p.format, p.units, p.points);
  std::vector<std::string> changes, removed;
  const auto count = [&](int number, const char* what) {
    if (number > 0) removed.push_back(fmt::format("{} {}{}", number, what, number > 1 ? "s" : ""));
  };
  if (p.reversed) changes.emplace_back("order reversed");
  if (p.mirrored) changes.emplace_back("y mirrored");
  if (p.z_turned) changes.emplace_back("z turned");
  if (p.from_back > 0) changes.push_back(fmt::format("{:g} mm subtracted from y", p.from_back / mm));
  count(p.duplicates, "duplicate");
  count(p.spikes, "spike");
  count(p.folded, "folded point");
  count(p.cut, "point");
  if (p.cut > 0) removed.back() += " beyond the surface";
  if (!removed.empty()) changes.push_back(fmt::format("removed: {}", fmt::join(removed, ", ")));
  if (!p.deviation.empty())
    changes.push_back(fmt::format("smoothed by {:.3g} mm at the most", p.largest_deviation() / mm));
  changes.insert(changes.end(), p.notes.begin(), p.notes.end());
  return changes.empty() ? text : fmt::format("{}; {}", text, fmt::join(changes, ", "));
}

}  // namespace tread
