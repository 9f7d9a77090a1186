#include "drivers/studies/develop/development.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/corrugation.hpp"
#include "core/error.hpp"
#include "core/math/statistics.hpp"
#include "core/travel.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/model/station_plan.hpp"

namespace tread {

namespace {

constexpr double kSpacing = 1e-3;       ///< largest spacing of the profile's depths [m]
constexpr double kDepthsPerWave = 10;   ///< least number of depths in a wave of the profile
constexpr double kElementsPerWave = 4;  ///< least number of elements in a wave that wears
constexpr double kElementsAcross = 2;   ///< elements across within which the work counts as noise
constexpr double kWayBeyond = 0.02;     ///< least distance that the wheel rolls beyond the corrugation [m]
constexpr double kTellingDepth = 0.25;  ///< least depth of a telling band, over that of the deepest band

void require(bool holds, const std::string& message) {
  if (!holds) throw InputError("tread develop: " + message);
}

void require_parts(const Scene& scene) {
  require(scene.wear.has_value(), "the scene has no [wear]; add that table, an empty one for usual values");
  require(scene.wheel && scene.rail && scene.motion && scene.contact,
          "the scene needs [wheel], [rail], [contact] and [motion]");
  require(scene.corrugation.has_value(),
          "the scene has no [corrugation] to begin with; corrugation.kind = \"random\" is roughness");
  require(scene.corrugation->apply == "gap",
          "corrugation.apply = \"nodes\" would need another mesh for each passage; state \"gap\"");
  require(scene.corrugation->kind != "map" || scene.wear->across,
          "corrugation.kind = \"map\" differs across the rail, and one line along it wears; state "
          "wear.across = true");
}

void require_waves(const Scene& scene, const Corrugation& corrugation) {
  const WearSpec& wear = *scene.wear;
  const double least = kElementsPerWave * mesh_sizes(scene).contact;
  require(
      wear.shortest >= least * (1 - 1e-9),
      fmt::format("wear.shortest = {:.4g} mm is below {:g} elements, {:.4g} mm, and would wear the mesh's "
                  "noise into the rail; raise it or choose a finer mesh",
                  1e3 * wear.shortest, kElementsPerWave, 1e3 * least));
  const double length = corrugation.last() - corrugation.first();
  require(wear.longest <= length * (1 + 1e-9),
          fmt::format("wear.longest = {:.4g} mm is more than the corrugation's length, {:.4g} mm",
                      1e3 * wear.longest, 1e3 * length));
  const double way = travel_of(scene).sure;
  const double passed = corrugation.last() + kWayBeyond;
  const std::optional<double> enough = duration_to(scene, passed);
  require(
      way >= passed,
      fmt::format("the wheel surely rolls to x = {:.4g} m only and so may not pass the corrugation, which "
                  "ends at {:.4g} m; {}",
                  way, corrugation.last(),
                  enough ? fmt::format("motion.duration must be {:.4g} ms at least", 1e3 * *enough)
                         : "the brakes may stop it before"));
}

/// Spacing of a file's places, their mean, or of depths that show the shortest wave [m].
double own_spacing(const CorrugationSpec& corrugation) {
  return corrugation.in_file() ? mean_spacing(corrugation.table_x)
                               : corrugation.shortest_wave() / kDepthsPerWave;
}

/// Spacing that shows the waves that wear and those of the corrugation, down to one element [m].
double profile_spacing(const Scene& scene) {
  const double of_element = mesh_sizes(scene).contact / kDepthsPerWave;
  return std::min({kSpacing, scene.wear->shortest / kDepthsPerWave,
                   std::max(own_spacing(*scene.corrugation), of_element)});
}

WornProfile sampled(const Corrugation& corrugation, double spacing) {
  const double length = corrugation.last() - corrugation.first();
  const auto pieces = static_cast<std::size_t>(std::ceil(length / spacing - 1e-9));
  WornProfile profile{corrugation.first(), length / static_cast<double>(pieces), {}};
  for (std::size_t i = 0; i <= pieces; ++i)
    profile.depth.push_back(i < pieces ? corrugation.depth(profile.x(i), corrugation.centre()) : 0.0);
  return profile;
}

}  // namespace

WearPlan wear_plan(const Scene& scene) {
  require_parts(scene);
  const Corrugation corrugation = corrugation_of(*scene.corrugation, 0);
  require_waves(scene, corrugation);
  const WearSpec& wear = *scene.wear;
  return {wear.coefficient / scene.head_material().density,
          wear.change,
          {wear.shortest, wear.longest},
          sampled(corrugation, profile_spacing(scene)),
          wear.across ? std::optional(kElementsAcross * mesh_sizes(scene).contact) : std::nullopt};
}

double Development::centre(const CorrugationSpec& corrugation) const {
  double middle = 0;
  for (const WorkRow& row : smooth.rows) middle += row.share * row.y;
  return corrugation.centre.value_or(middle);
}

void Development::begin(SurfaceWork over_smooth, const CorrugationSpec& corrugation) {
  smooth = std::move(over_smooth);
  profile = plan.start;
  if (!plan.reach_across) return;
  smooth = smoothed_across(std::move(smooth), *plan.reach_across);
  const Corrugation shape = corrugation_of(corrugation, centre(corrugation));
  rows.emplace();
  for (const WorkRow& row : smooth.rows) {
    rows->y.push_back(row.y);
    rows->share.push_back(row.share);
    rows->depth.emplace_back();
    for (std::size_t i = 0; i < profile.depth.size(); ++i)
      rows->depth.back().push_back(shape.depth(profile.x(i), row.y));
  }
  profile = plan.start = rows->mean(profile);
}

void Development::add(const SurfaceWork& work) {
  WornPassage passage;
  passage.profile = profile;
  SurfaceWork wearing;  // by rows
  if (rows) wearing = work_beyond(smoothed_across(work, *plan.reach_across), smooth);
  passage.work = rows ? wearing.mean : without(work.mean, smooth.mean);
  passage.uneven = uneven_work(passage.work, profile, plan.band);
  passage.bands = growth_bands(profile, passage.work, plan.band);
  if (rows) {
    const auto uneven = uneven_rows(wearing, profile, plan.band);
    passage.passages =
        passages_for(plan.change, range_of_rows(rows->depth), plan.per_work, range_of_rows(uneven));
    rows->add(passage.passages * plan.per_work, uneven);
    profile = rows->mean(profile);
  } else {
    WearStep step = worn(profile, passage.uneven, plan.per_work, plan.change);
    passage.passages = step.passages;
    profile = std::move(step.profile);
  }
  passages.push_back(std::move(passage));
}

double Development::mean_work() const {
  return tread::mean_work(smooth.mean, plan.start, plan.band);
}

double Development::real_passages() const {
  double sum = 0;
  for (const WornPassage& passage : passages) sum += passage.passages;
  return sum;
}

std::vector<GrowthBand> Development::bands_now() const {
  PassageWork none = smooth.mean;
  std::fill(none.work.begin(), none.work.end(), 0.0);
  return growth_bands(profile, none, plan.band);
}

std::vector<BandOutcome> outcome(const Development& development) {
  if (development.passages.empty()) return {};
  const std::vector<GrowthBand>& first = development.passages.front().bands;
  const std::vector<GrowthBand>& last = development.passages.back().bands;
  const std::vector<GrowthBand> now = development.bands_now();
  const double rate = development.plan.per_work;
  const double wear = rate * development.mean_work();
  const GrowthBand* deepest_before = deepest_band(first);
  std::vector<BandOutcome> bands;
  for (std::size_t i = 0; i < first.size(); ++i) {
    BandOutcome band;
    band.wavelength = first[i].wavelength;
    band.before = first[i].depth;
    band.after = now[i].depth;
    band.growth = std::log(band.after / band.before) / development.real_passages();
    band.first_growth = rate * first[i].response.real();
    band.last_growth = rate * last[i].response.real();
    band.per_wear = band.first_growth / wear;
    band.lag = first[i].lag();
    band.coherence = first[i].coherence;
    band.telling = band.before >= kTellingDepth * deepest_before->depth && band.before > first[i].leakage &&
                   first[i].work > first[i].work_leakage && band.coherence.value_or(1) >= kTellingCoherence;
    bands.push_back(band);
  }
  return bands;
}

std::optional<BandOutcome> deepest(const std::vector<BandOutcome>& bands) {
  const auto found =
      std::max_element(bands.begin(), bands.end(),
                       [](const BandOutcome& a, const BandOutcome& b) { return a.after < b.after; });
  return found == bands.end() ? std::nullopt : std::optional(*found);
}

}  // namespace tread
