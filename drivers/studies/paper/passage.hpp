#pragma once
// The passages that the paper simulates, and those of them that have been run.

#include <string>
#include <vector>

#include "drivers/studies/study/finished_run.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

/// What the paper's figures vary; everything else is Table 1. Units as the paper states them.
struct Passage {
  double speed = 300;     ///< [km/h]
  double mu = 0.3;        ///< traction coefficient; negative brakes
  double wavelength = 0;  ///< L [mm]; 0: smooth rail
  double depth = 0;       ///< d_m [mm]
  double ramp = 5;        ///< T1 [ms]

  bool operator==(const Passage&) const = default;
};

Passage smooth_rail(double speed = 300, double mu = 0.3);
/// Corrugation D is the default.
Passage corrugated(double wavelength = 80, double depth = 0.14);

/// Of its folder: "80mm,0.14mm,300km_h,mu=0.3".
std::string name_of(const Passage& passage);

/// As a point of a study: far enough to pass the corrugation, or the solution zone.
StudyPoint study_point(const Passage& passage);

/// The scene that all passages begin with.
std::string paper_scene();

/// Runs by passage.
class PassageRuns {
 public:
  void add(const Passage& passage, FinishedRun run) { runs_.emplace_back(passage, std::move(run)); }
  /// nullptr: not run.
  const FinishedRun* find(const Passage& passage) const;
  bool empty() const { return runs_.empty(); }

 private:
  std::vector<std::pair<Passage, FinishedRun>> runs_;
};

}  // namespace tread
