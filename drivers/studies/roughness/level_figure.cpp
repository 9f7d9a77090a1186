#include "drivers/studies/roughness/level_figure.hpp"

#include <cmath>
#include <utility>

#include "io/report/markup.hpp"

namespace tread {

Figure level_figure(const std::vector<NamedLevels>& rails) {
  Figure figure;
  figure.title = "Roughness level in one-third octave bands";
  figure.x_label = "n of the band's middle 10^(n/10) mm";
  figure.panels = {{"dB re 1 µm", {}, {}, 300, std::nullopt}};
  std::vector<Series>& curves = figure.panels.front().series;
  for (const NamedLevels& rail : rails) curves.push_back({rail.label, {}, {}, Stroke::solid});
  Series limit{"limit of ISO 3095:2013", {}, {}, Stroke::dashed};
  const std::vector<RoughnessBand>& bands = roughness_bands();
  for (std::size_t i = bands.size(); i-- > 0;) {
    const double n = std::round(10 * std::log10(1e3 * bands[i].middle));
    limit.x.push_back(n);
    limit.y.push_back(bands[i].limit);
    if (i % 3 == 1) figure.positions.push_back({n, readable(1e3 * bands[i].nominal) + " mm"});
    for (std::size_t k = 0; k < rails.size(); ++k)
      if (const std::optional<double>& level = rails[k].levels.level[i]) {
        curves[k].x.push_back(n);
        curves[k].y.push_back(*level);
      }
  }
  curves.push_back(std::move(limit));
  return figure;
}

}  // namespace tread
