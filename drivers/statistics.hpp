#pragma once

namespace tread {

struct Statistics {
  double mean = 0, min = 0, max = 0;

  double range() const { return max - min; }
};

}  // namespace tread
