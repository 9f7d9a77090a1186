#include "drivers/report/hammer_figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/receptance.hpp"
#include "drivers/report/figure_parts.hpp"

namespace tread {

namespace {

/// Force and displacement of the struck point against time.
Figure blow_figure(const RunResults& r) {
  Series force{"force of the hammer", {}, {}, Stroke::solid};
  Series displacement{"struck point, downwards since the start", {}, {}, Stroke::solid};
  for (const Sample& s : r.samples) {
    force.x.push_back(1e3 * s.time);
    force.y.push_back(1e-3 * s.hammer_force);
    displacement.x.push_back(1e3 * s.time);
    displacement.y.push_back(1e6 * s.hammer_displacement);
  }
  Figure figure;
  figure.name = "blow";
  figure.title = "Blow on the rail head";
  figure.x_label = "Time [ms]";
  figure.panels = {panel("Force [kN]", {std::move(force)}, {}, 110),
                   panel("Displacement [µm]", {std::move(displacement)}, {}, 200)};
  return figure;
}

/// Amplitude of the struck point's receptance.
Figure receptance_figure(const Scene& scene, const RunResults& r) {
  constexpr int kPoints = 400;
  // A half sine of duration T has lost nine tenths of its spectrum at 1.2 / T; a record of length D resolves
  // 1 / D; samples dt apart show no more than 1 / (4 dt) well.
  const double length = r.samples.back().time;
  double interval = r.samples.front().time;  // the longest
  BlowRecord record;
  for (const Sample& s : r.samples) {
    if (!record.time.empty()) interval = std::max(interval, s.time - record.time.back());
    record.time.push_back(s.time);
    record.force.push_back(s.hammer_force);
    record.response.push_back(s.hammer_displacement);
  }
  const double first = 2 / length;
  const double last = std::min(1.2 / scene.hammer->duration, 0.25 / interval);
  Series amplitude{"struck point", {}, {}, Stroke::solid};
  for (int i = 0; i <= kPoints && last > first; ++i) {
    const double f = first * std::pow(last / first, static_cast<double>(i) / kPoints);
    amplitude.x.push_back(f);
    amplitude.y.push_back(std::log10(std::abs(record.receptance(f))));
  }
  Figure figure;
  figure.name = "receptance";
  figure.title = "Receptance of the struck point";
  figure.x_label = "Frequency [Hz]";
  figure.panels = {panel("log10 of [m/N]", {std::move(amplitude)}, {}, 260)};
  figure.caption =
      "Fourier integral of the displacement over that of the force. It holds where the motion is over at the "
      "end of the run. The struck point's indentation under the point load, which depends on the mesh, is "
      "part "
      "of it.";
  return figure;
}

}  // namespace

Chapter hammer_chapter(const Model& model, const RunResults& r) {
  Chapter chapter{"Hammer", {blow_figure(r)}};
  if (over_time(model)) chapter.blocks.emplace_back(receptance_figure(model.scene, r));
  return chapter;
}

}  // namespace tread
