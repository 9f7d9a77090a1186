#pragma once
// The paper's figures as data: what is run for each, and what is drawn.

#include <functional>
#include <string>
#include <vector>

#include "drivers/results/surface_map.hpp"
#include "drivers/studies/paper/passage.hpp"
#include "drivers/studies/study/study_figures.hpp"

namespace tread {

struct PaperFigure {
  std::string id;       ///< "26"; "24b" has no figure of its own in the paper
  std::string title;    ///< what it shows, and under what
  std::string section;  ///< of the paper
  std::vector<Passage> passages = {};
  std::function<std::string(const Passage&)> label = {};  ///< what tells the curves apart
  CurvesSpec curves = {};                                 ///< where it shows curves
  std::string x_label = {};                               ///< where it shows a trend
  std::function<double(const Passage&)> x = {};
  std::vector<TrendPanel> trends = {};
  bool multibody = false;                 ///< F_N by the multi-body approach beside the run's
  bool one_panel = false;                 ///< all curves in one panel
  bool instants = false;                  ///< the patch at t1 to t10 of the one passage
  std::vector<Passage> waves = {};        ///< whose roughness levels it shows; none of them is run
  std::vector<SurfaceView> surface = {};  ///< between t1 and t10 of the one passage
};

/// In the paper's order.
const std::vector<PaperFigure>& paper_figures();

/// The id without zeros before it: "8".
std::string shown_id(const std::string& id);

}  // namespace tread
