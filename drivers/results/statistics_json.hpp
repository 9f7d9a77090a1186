#pragma once
// Statistics as summaries state them.

#include "core/math/statistics.hpp"
#include "io/text/json.hpp"

namespace tread {

/// Object with "mean", "min" and "max", in the unit of the values.
Json statistics_json(const Statistics& statistics);

}  // namespace tread
