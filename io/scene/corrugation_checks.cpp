#include "io/scene/corrugation_checks.hpp"

#include <fmt/format.h>

#include "core/corrugation.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

/// Waves of a roughness in its length, at the most: the cost of its profile grows as their square.
constexpr double kMostRoughnessWaves = 5000;

void check_roughness(const CorrugationSpec& roughness, Require require) {
  const double shortest = roughness.shortest, longest = roughness.longest, length = roughness.length;
  constexpr double kRounding = 1e-5;  // of the wave that a message suggests
  const auto in_mm = [](double value) { return format_quantity(value, "mm"); };
  require(
      shortest < longest, {"corrugation.shortest", "corrugation.longest"},
      fmt::format("the roughness' shortest wave, {}, is not shorter than its longest, {}; state a smaller "
                  "corrugation.shortest or a larger corrugation.longest",
                  in_mm(shortest), in_mm(longest)));
  require(longest <= length + kLengthTolerance, {"corrugation.longest", "corrugation.length"},
          fmt::format("the roughness' longest wave, {}, does not fit into its length, {}; state a smaller "
                      "corrugation.longest or a larger corrugation.length",
                      in_mm(longest), in_mm(length)));
  require(
      length / shortest <= kMostRoughnessWaves * (1 + kRounding),
      {"corrugation.shortest", "corrugation.length"},
      fmt::format("the shortest wave, {}, fits {:.6g} times into the length, {:.6g} m; at most {:g} times "
                  "are possible: state a corrugation.shortest of at least {}, or a smaller "
                  "corrugation.length",
                  in_mm(shortest), length / shortest, length, kMostRoughnessWaves,
                  in_mm(length / kMostRoughnessWaves)));
  if (!(shortest < longest && longest <= length)) return;
  const WaveRange waves = waves_of(shortest, longest, length);
  require(
      waves.first <= waves.last, {"corrugation.longest", "corrugation.shortest", "corrugation.length"},
      fmt::format("no wave from {} to {} fits as a whole number into the length, {:.6g} m: the rail would "
                  "be smooth; state a corrugation.longest above {} or a corrugation.shortest below {}, or "
                  "another corrugation.length",
                  in_mm(shortest), in_mm(longest), length, in_mm(length / waves.last),
                  in_mm(length / waves.first)));
}

}  // namespace

void check_corrugation(const Scene& scene, Require require) {
  const RailSpec& rail = *scene.rail;
  const CorrugationSpec& corrugation = *scene.corrugation;
  const bool table = corrugation.in_file();
  if (corrugation.kind == "sine")
    require(corrugation.wavelength <= corrugation.length + kLengthTolerance,
            {"corrugation.wavelength", "corrugation.length"},
            fmt::format("not one wave of {} fits into the corrugation's length of {}; state a smaller "
                        "corrugation.wavelength or a larger corrugation.length",
                        format_quantity(corrugation.wavelength, "mm"),
                        format_quantity(corrugation.length, "mm")));
  if (corrugation.kind == "random") check_roughness(corrugation, require);
  if (table && corrugation.table_x.empty()) return;
  const double first = corrugation.start + (table ? corrugation.table_x.front() : 0);
  const double last = corrugation.start + (table ? corrugation.table_x.back() : corrugation.length);
  const auto inside = [&](double left, double right) {
    return first >= left - kLengthTolerance && last <= right + kLengthTolerance;
  };
  const std::string extent = fmt::format("the corrugation, x = {:.6g} m to {:.6g} m,", first, last);
  std::vector<std::string> keys{"corrugation.start", table ? "corrugation.file" : "corrugation.length"};
  const bool on_rail = inside(-rail.origin, rail.length - rail.origin);
  const ZoneSpec zone = scene.solution_zone();
  require(!on_rail || inside(zone.start, zone.end()),
          {keys[0], keys[1], "solution_zone.start", "solution_zone.length"},
          fmt::format("{} is not inside the solution zone, {:.6g} m to {:.6g} m; move one of them, or widen "
                      "the zone",
                      extent, zone.start, zone.end()));
  require(on_rail, {keys[0], keys[1], "rail.length", "rail.origin"},
          fmt::format("{} is not on the rail, {:.6g} m to {:.6g} m; move it, or lengthen the rail", extent,
                      -rail.origin, rail.length - rail.origin));
}

}  // namespace tread
