#pragma once
// Ends of the rail, as the contact search meets them.

#include <optional>
#include <string>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/model/station_plan.hpp"

namespace tread {

/// Half length of the surface that the run of a model with contact searches about the wheel's axis, over the
/// scene's corrugation too, whether the model has it or not yet [m].
double searched_reach(const Model& model);

/// Places of the axis of a model with contact that leave the searched surface on the rail [m].
Span searched_way(const Model& model);

/// Keys that let the wheel of a model with contact roll to x [m], ahead of its start, with rail for the
/// search: `rail.length = "22.9 m"`; "" where its rail does. nullopt beyond the longest rail.
std::optional<std::string> keys_for_way(const Model& model, double x);

/// InputError where the wheel's way, travel_of(), leads beyond searched_way(). Nothing without contact.
void require_way_on_rail(const Model& model);

}  // namespace tread
