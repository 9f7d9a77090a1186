#pragma once
// The points of a study and what they share.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/results/estimate.hpp"
#include "drivers/studies/study/point_folder.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

struct PlannedPoint {
  std::string name;
  std::vector<StudySetting> varied;
  std::vector<std::string> overrides;  ///< as after --set, later ones first in rank
  ResolvedScene resolved;
  SceneContent content;
  std::string from = {};  ///< state that the run begins with, as in fork_from(); empty: its start
  std::filesystem::path folder;
  PointStatus status;
  std::optional<Estimate> cost;       ///< of a point that is not done
  double saved_seconds = 0;           ///< that others compute for it; not in the cost
  std::optional<std::size_t> shared;  ///< its place in StudyPlan::shared
  bool keeps_state = false;           ///< the others of its StudyPlan::shared begin with its state

  bool to_run(bool retry) const {
    return status.state != PointState::done && (status.state != PointState::failed || retry);
  }
  /// Nothing in the folder is of use to go on from.
  bool begins_anew() const {
    return status.state == PointState::waiting || (status.state == PointState::failed && status.anew);
  }
};

/// Points that are the same run to the bit until the patch meets what tells their corrugations apart.
/// [reliability.md, Fork]
struct SharedRolling {
  std::vector<std::size_t> points;  ///< of StudyPlan::points, in their order
  double from_x = 0;                ///< corrugations differ from there on [m]
  double deepest = 0;               ///< corrugation [m]
  std::optional<double> room;       ///< contact.depth_room where the usual one is not enough [m]
  double until = 0;                 ///< a state is kept then; 0: not known [s]
};

struct StudyPlan {
  Study study;
  std::filesystem::path folder;
  std::vector<PlannedPoint> points;
  std::vector<SharedRolling> shared;
  int jobs = 1;     ///< runs at once
  int threads = 0;  ///< of one run; 0: its share of the cores that are idle when it begins

  /// What the first failed point's process exited with; resources where a signal ended it.
  ExitCode failure_code() const;
};

}  // namespace tread
