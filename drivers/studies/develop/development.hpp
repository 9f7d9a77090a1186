#pragma once
// Passages that wear the rail under them, and the development of the rail's profile.

#include <optional>
#include <vector>

#include "core/scene.hpp"
#include "drivers/studies/develop/growth.hpp"
#include "drivers/studies/develop/wear.hpp"
#include "drivers/studies/develop/worn_rows.hpp"

namespace tread {

/// Least coherence of a telling band of several lines. [theory.md, eq. W5]
inline constexpr double kTellingCoherence = 0.5;

/// Wear coefficient, wavelengths that wear, and profile of a development.
struct WearPlan {
  double per_work = 0;  ///< volume worn off per frictional work [m3/J]
  double change = 0;    ///< largest change of the depth by one simulated passage [-]
  WearBand band;
  WornProfile start;  ///< profile of the scene's corrugation
  /// Distance across the rail within which differences of the work are noise of the mesh [m]; absent: the
  /// depth keeps its shape across.
  std::optional<double> reach_across = {};
};

/// Wear plan of a scene. Throws InputError, with the way out, if the scene lacks data that a development
/// needs.
WearPlan wear_plan(const Scene& scene);

/// A simulated passage.
struct WornPassage {
  WornProfile profile;  ///< profile under the passage
  /// Work beyond that of the smooth rail, averaged across; by rows: of the smoothed work that wears them
  /// [J/m2].
  PassageWork work;
  std::vector<double> uneven;  ///< part of the work that wears the profile unevenly [J/m2]
  double passages = 0;         ///< number of real passages that it stands for
  std::vector<GrowthBand> bands;
};

/// All passages so far.
struct Development {
  WearPlan plan;
  SurfaceWork smooth;  ///< the passage over the smooth rail; by rows: smoothed across
  std::vector<WornPassage> passages;
  WornProfile profile;           ///< profile after the passages; by rows: their mean
  std::optional<WornRows> rows;  ///< depths by row after the passages, with WearPlan::reach_across

  /// Begins with the passage over the smooth rail and the scene's corrugation.
  void begin(SurfaceWork over_smooth, const CorrugationSpec& corrugation);
  /// y of the corrugation's middle: as stated, else the middle of the smooth rail's work [m].
  double centre(const CorrugationSpec& corrugation) const;
  /// Adds the work of a passage over `profile` and lets the profile wear.
  void add(const SurfaceWork& work);

  double mean_work() const;      ///< mean work over the smooth rail [J/m2]
  double real_passages() const;  ///< number of real passages that all simulated ones stand for
  /// Bands of the present profile, without responses.
  std::vector<GrowthBand> bands_now() const;
};

/// Outcome of a band over all passages.
struct BandOutcome {
  double wavelength = 0;            ///< [m]
  double before = 0, after = 0;     ///< root mean square depth [m]
  double growth = 0;                ///< logarithmic growth by a real passage, from the profiles
  double first_growth = 0;          ///< logarithmic growth by the work of the first passage
  double last_growth = 0;           ///< logarithmic growth by the work of the last passage
  double per_wear = 0;              ///< first_growth over the depth that a passage wears off evenly [1/m]
  double lag = 0;                   ///< lag of the first passage's work past the trough, in waves
  std::optional<double> coherence;  ///< coherence of the first passage; absent for a single line
  bool telling = false;             ///< true if profile and work have enough of the band to tell a response
};

/// Outcomes of all bands, longest waves first; empty before the first passage.
std::vector<BandOutcome> outcome(const Development& development);

/// Outcome of the band that is deepest at the end; nullopt without bands.
std::optional<BandOutcome> deepest(const std::vector<BandOutcome>& bands);

}  // namespace tread
