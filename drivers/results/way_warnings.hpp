#pragma once
// Warnings of a way that does not pass what the scene evaluates, that leaves the fastenings or a friction
// table, or whose traction acts on a rail with free feet.

#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/model/station_plan.hpp"

namespace tread {

/// Sentence if a rolling wheel starts ahead of `aim`, or may not come to x = `enough` [m] of it; else "".
/// `what` names the aim, `lost` states the consequence.
std::string way_warning(const Model& model, const std::string& what, const Span& aim, double enough,
                        const char* lost);

/// Appends a sentence for the solution zone or the corrugation, each [zone.NAME], the fastenings, a table of
/// friction and free feet; "" where the wheel's way is sound. `model` has contact.
void add_way_warnings(const Model& model, std::vector<std::string>& warnings);

}  // namespace tread
