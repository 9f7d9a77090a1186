#pragma once
// Passages that wear the rail they roll over, and what became of its profile.

#include <optional>
#include <vector>

#include "core/scene.hpp"
#include "drivers/studies/develop/growth.hpp"
#include "drivers/studies/develop/wear.hpp"

namespace tread {

/// What wears, how much, and of which profile.
struct WearPlan {
  double per_work = 0;  ///< volume worn off per frictional work [m3/J]
  double change = 0;    ///< of the depth by one simulated passage, at the most [-]
  WearBand band;
  WornProfile start;  ///< of the scene's corrugation
};

/// InputError where the scene lacks what a development needs, with the way out.
WearPlan wear_plan(const Scene& scene);

/// A simulated passage.
struct WornPassage {
  WornProfile profile;         ///< that it rolled over
  PassageWork work;            ///< beyond that of the smooth rail [J/m2]
  std::vector<double> uneven;  ///< the part of it that wears the profile unevenly [J/m2]
  double passages = 0;         ///< real ones that it stands for
  std::vector<GrowthBand> bands;
};

/// All passages so far.
struct Development {
  WearPlan plan;
  PassageWork smooth;  ///< the passage over the smooth rail
  std::vector<WornPassage> passages;
  WornProfile profile;  ///< after them

  /// Adds the passage over the profile and lets it wear.
  void add(const PassageWork& work);

  double mean_work() const;      ///< over the smooth rail [J/m2]
  double real_passages() const;  ///< that all stand for
  /// Of the profile as it is now, without responses.
  std::vector<GrowthBand> bands_now() const;
};

/// What became of a band over all passages.
struct BandOutcome {
  double wavelength = 0;         ///< [m]
  double before = 0, after = 0;  ///< root mean square depth [m]
  double growth = 0;             ///< logarithmic, of a real passage, from the profiles
  double first_growth = 0;       ///< the same by the work of the first passage
  double last_growth = 0;        ///< by that of the last
  double per_wear = 0;           ///< first_growth over the depth that a passage wears off evenly [1/m]
  double lag = 0;                ///< of the first passage's work past the trough, in waves
  double coherence = 0;          ///< of the first passage
  bool telling = false;          ///< whether the profile has enough of it to tell a response
};

/// Longest waves first; empty before the first passage.
std::vector<BandOutcome> outcome(const Development& development);

/// Its place among the bands is that of the deepest at the end.
std::optional<BandOutcome> deepest(const std::vector<BandOutcome>& bands);

}  // namespace tread
