#pragma once
// Points of a study that roll as one until their corrugations differ. [studies.md, Shared rolling]

#include <optional>
#include <string>
#include <vector>

#include "drivers/run/fork.hpp"
#include "drivers/studies/study/planned_point.hpp"

namespace tread {

/// Fills plan.shared and the points' places there: scenes of equal content except for corrugations by gap.
/// Any other change that a fork allows would alter the bits of a run from the start: a shorter duration
/// divides another rail, another interval of the histories begins with the state.
void find_shared_rolling(StudyPlan& plan);

/// SharedRolling::room of the point.
std::optional<double> room_of(const StudyPlan& plan, const PlannedPoint& point);

/// The point's scene as that of a run that keeps a state, if it can.
Scene keeping_scene(const StudyPlan& plan, const PlannedPoint& point);

/// Fills SharedRolling::until if it is not known: the wheel is then still before the first difference of the
/// corrugations. Leaves every point alone if the wheel begins nearer.
void place_state(StudyPlan& plan, const PlannedPoint& point, const Approach& approach);

/// Chooses the keepers: in every group without one, the first of the points that begin anew keeps the state,
/// provided that a second one does.
void choose_keepers(StudyPlan& plan, bool retry);

/// Point whose folder has the state with which this one can begin; nullptr if there is none.
const PlannedPoint* keeper_of(const StudyPlan& plan, const PlannedPoint& point);

/// Returns true if the point is to begin with another one's state, which may not exist yet.
bool begins_with_state(const StudyPlan& plan, const PlannedPoint& point);

/// Text for readers: "keeps the state at 28.4 ms", "at 28.4 ms, from smooth"; empty if the point begins at
/// the start.
std::string beginning_text(const StudyPlan& plan, const PlannedPoint& point);

/// Returns true if the point has to wait for the state of another one.
bool waits_for_state(const StudyPlan& plan, const PlannedPoint& point);

/// Arguments of the command line that make the point keep the state or begin with it.
std::vector<std::string> sharing_arguments(const StudyPlan& plan, const PlannedPoint& point);

/// Replaces a keeper whose run has ended without keeping the state. If that run came to an end that the
/// others would come to as well, no other point takes its place and those points are returned.
std::vector<PlannedPoint*> replace_keeper(StudyPlan& plan, PlannedPoint& point);

}  // namespace tread
