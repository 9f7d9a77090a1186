#pragma once
// The paper's figures as data: the passages and the curves of each.

#include <functional>
#include <string>
#include <vector>

#include "drivers/results/surface_map.hpp"
#include "drivers/studies/paper/passage.hpp"
#include "drivers/studies/study/study_figures.hpp"

namespace tread {

struct PaperFigure {
  std::string id;       ///< id, such as "26"; "24b" has no figure of its own in the paper
  std::string title;    ///< shown quantity and varied quantity
  std::string section;  ///< section of the paper
  std::vector<Passage> passages = {};
  std::function<std::string(const Passage&)> label = {};  ///< text that distinguishes the curves
  CurvesSpec curves = {};                                 ///< curves, for a figure of curves
  std::string x_label = {};                               ///< abscissa, for a figure of a trend
  std::function<double(const Passage&)> x = {};
  std::vector<TrendPanel> trends = {};
  bool multibody = false;                 ///< true for F_N by the multi-body approach beside the run's
  bool one_panel = false;                 ///< true for all curves in one panel
  bool instants = false;                  ///< true for the patch at t1 to t10 of the one passage
  std::vector<Passage> waves = {};        ///< waves whose roughness levels are shown; none of them is run
  std::vector<SurfaceView> surface = {};  ///< views of the surface between t1 and t10 of the one passage
};

/// All figures, in the paper's order.
const std::vector<PaperFigure>& paper_figures();

/// Id without leading zeros, such as "8".
std::string shown_id(const std::string& id);

}  // namespace tread
