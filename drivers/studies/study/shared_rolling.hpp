#pragma once
// Points of a study that roll as one until their corrugations differ. [sweep.md, Shared rolling]

#include <optional>
#include <string>
#include <vector>

#include "drivers/run/fork.hpp"
#include "drivers/studies/study/planned_point.hpp"

namespace tread {

/// Fills plan.shared and the points' places there: scenes with the same content but for corrugations by gap.
/// Nothing else that a fork allows leaves the bits of a run from the start: a shorter duration divides
/// another rail, another interval of the histories begins with the state.
void find_shared_rolling(StudyPlan& plan);

/// Whether runs of the scene can begin with the state of another one, or keep it, for another corrugation.
bool can_share(const Scene& scene);

/// SharedRolling::room of the point.
std::optional<double> room_of(const StudyPlan& plan, const PlannedPoint& point);

/// The point's scene as that of a run that keeps a state, where it can.
Scene keeping_scene(const StudyPlan& plan, const PlannedPoint& point);

/// Fills SharedRolling::until where it is not known: the wheel is then still before what tells the
/// corrugations apart. Leaves every point alone where the wheel begins nearer.
void place_state(StudyPlan& plan, const PlannedPoint& point, const Approach& approach);

/// For every group that lacks it, makes the first of the points that begin anew the one that keeps the state,
/// if another one does, too.
void choose_keepers(StudyPlan& plan, bool retry);

/// The point whose folder has the state that this one can begin with; nullptr: none has.
const PlannedPoint* keeper_of(const StudyPlan& plan, const PlannedPoint& point);

/// Whether the point is to begin with another one's state, which may not be there yet.
bool begins_with_state(const StudyPlan& plan, const PlannedPoint& point);

/// For readers: "keeps the state at 28.4 ms", "at 28.4 ms, from smooth"; empty where it begins at the start.
std::string beginning_text(const StudyPlan& plan, const PlannedPoint& point);

/// Whether the point has to wait for the state of another one.
bool waits_for_state(const StudyPlan& plan, const PlannedPoint& point);

/// What of the command line makes the point keep the state or begin with it.
std::vector<std::string> sharing_arguments(const StudyPlan& plan, const PlannedPoint& point);

/// After the run that was to keep the state has ended without: another one takes its place, but where it has
/// come to an end that the others would come to as well; those are returned.
std::vector<PlannedPoint*> replace_keeper(StudyPlan& plan, PlannedPoint& point);

}  // namespace tread
