#include "drivers/results/statistics_json.hpp"

#include <nlohmann/json.hpp>

namespace tread {

Json statistics_json(const Statistics& statistics) {
  return {{"mean", statistics.mean}, {"min", statistics.min}, {"max", statistics.max}};
}

}  // namespace tread
