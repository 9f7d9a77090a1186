// Mass, inertia and natural modes of the free half wheelset under refinement.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/profiles.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/free_wheelset.hpp"
#include "drivers/verify/natural_modes.hpp"

namespace tread {

namespace {

/// Integrals of the body that a closed outline sweeps about r = 0, by Green's theorem on its lines.
struct SweptOutline {
  double volume = 0;  ///< [m3]
  double polar = 0;   ///< integral of r^2 [m5]

  /// A straight part; the body lies to its left.
  void add(Point2 a, Point2 b) {
    double fourth = 0;
    for (int k = 0; k <= 4; ++k) fourth += std::pow(a.y, k) * std::pow(b.y, 4 - k);
    volume -= std::numbers::pi * (b.x - a.x) * (a.y * a.y + a.y * b.y + b.y * b.y) / 3;
    polar -= std::numbers::pi / 2 * (b.x - a.x) * fourth / 5;
  }
};

/// Adds a section's border: edges of one quad.
void add_border(const Section& section, SweptOutline& outline) {
  std::map<std::pair<int, int>, int> uses;
  const auto key = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const auto& quad : section.quads)
    for (std::size_t e = 0; e < 4; ++e) ++uses[key(quad[e], quad[(e + 1) % 4])];
  const auto at = [&](int node) {
    return Point2{section.p[static_cast<std::size_t>(node)], section.q[static_cast<std::size_t>(node)]};
  };
  for (const auto& quad : section.quads)
    for (std::size_t e = 0; e < 4; ++e)
      if (uses[key(quad[e], quad[(e + 1) % 4])] == 1) outline.add(at(quad[e]), at(quad[(e + 1) % 4]));
}

/// Adds the LMA profile down to the tie under it.
void add_tread(const Section& tread, const WheelSpec& wheel, SweptOutline& outline) {
  const PlaneCurve profile = lma().surface;
  const double tie = tread.q[static_cast<std::size_t>(tread.paths.at("tie").front())];
  const auto point = [&](double s) {
    const Point2 p = profile.at(s).position;
    return Point2{p.x - wheel.lateral_offset, p.y + wheel.diameter / 2};
  };
  constexpr int kParts = 4000;
  const Point2 first = point(0);
  const Point2 last = point(profile.length());
  outline.add({first.x, tie}, {last.x, tie});
  outline.add({last.x, tie}, last);
  for (int i = kParts; i > 0; --i)
    outline.add(point(profile.length() * i / kParts), point(profile.length() * (i - 1) / kParts));
  outline.add(first, {first.x, tie});
}

/// Outline of the wheelset swept smoothly, with the tread's exact profile.
SweptOutline outline_of(const Model& model) {
  SweptOutline outline;
  const auto section = [&](int block) -> const Section& {
    return model.mesh.blocks[static_cast<std::size_t>(block)].section;
  };
  add_tread(section(model.index.tread), *model.scene.wheel, outline);
  add_border(section(model.index.disc), outline);
  add_border(section(model.index.axle), outline);
  return outline;
}

/// A shaft in slices of equal length.
struct Shaft {
  double first = 0, slice = 0;  ///< y of the shaft's end, length of a slice [m]
  std::vector<double> polar;    ///< second polar moment of the cross-section in the middle of each slice [m4]
};

Shaft shaft_of(const Section& axle) {
  constexpr int kSlices = 2000;
  Shaft shaft;
  shaft.first = *std::min_element(axle.p.begin(), axle.p.end());
  shaft.slice = (*std::max_element(axle.p.begin(), axle.p.end()) - shaft.first) / kSlices;
  for (int i = 0; i < kSlices; ++i) {
    const double p = shaft.first + (i + 0.5) * shaft.slice;
    double inner = 1e9, outer = 0;
    for (const auto& quad : axle.quads)
      for (std::size_t e = 0; e < 4; ++e) {
        const auto a = static_cast<std::size_t>(quad[e]);
        const auto b = static_cast<std::size_t>(quad[(e + 1) % 4]);
        if ((axle.p[a] - p) * (axle.p[b] - p) > 0 || axle.p[a] == axle.p[b]) continue;
        const double r = axle.q[a] + (axle.q[b] - axle.q[a]) * (p - axle.p[a]) / (axle.p[b] - axle.p[a]);
        inner = std::min(inner, r);
        outer = std::max(outer, r);
      }
    shaft.polar.push_back(std::numbers::pi / 2 * (std::pow(outer, 4) - std::pow(inner, 4)));
  }
  return shaft;
}

/// Lowest torsion [Hz] of the axle as a shaft that carries the disc as a rigid body in the hub's middle. It
/// is the lowest frequency at which a twist without torque at one end has no torque at the other end.
/// [Holzer's method]
double shaft_torsion(const Model& model) {
  const Section& axle = model.mesh.blocks[static_cast<std::size_t>(model.index.axle)].section;
  const Material& steel = model.scene.wheel_material();
  const Shaft shaft = shaft_of(axle);
  const auto& hub = axle.paths.at("tie");
  const double hub_middle =
      0.5 * (axle.p[static_cast<std::size_t>(hub.front())] + axle.p[static_cast<std::size_t>(hub.back())]);
  const auto disc_slice = static_cast<std::size_t>((hub_middle - shaft.first) / shaft.slice);
  SweptOutline alone;
  add_border(axle, alone);
  const double disc = steel.density * (outline_of(model).polar - alone.polar);
  const auto torque_left = [&](double frequency) {
    const double omega2 = std::pow(2 * std::numbers::pi * frequency, 2);
    double twist = 1, torque = 0;
    for (std::size_t i = 0; i < shaft.polar.size(); ++i) {
      const double half = 0.5 * shaft.slice / (steel.shear_modulus() * shaft.polar[i]);
      const double inertia = steel.density * shaft.polar[i] * shaft.slice + (i == disc_slice ? disc : 0.0);
      twist += half * torque;
      torque -= omega2 * inertia * twist;
      twist += half * torque;
    }
    return torque;
  };
  constexpr double kStep = 10, kHighest = 1e5;
  double low = kStep;
  const bool negative = torque_left(low) < 0;
  while (low < kHighest && (torque_left(low + kStep) < 0) == negative) low += kStep;
  if (low >= kHighest) throw NumericalError("verify: the axle's shaft has no torsion below 100 kHz");
  double high = low + kStep;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    ((torque_left(middle) < 0) == negative ? low : high) = middle;
  }
  return low;
}

struct MeshedWheelset {
  double mass = 0, inertia = 0;  ///< [kg], [kg m2]
  double outline_mass = 0, outline_inertia = 0;
  double shaft_torsion = 0;  ///< [Hz]
  std::vector<NaturalMode> rigid;
  std::map<std::string, NaturalMode> elastic;  ///< modes by name and ordinal
  std::vector<std::string> order;
};

MeshedWheelset wheelset_of(double element_size, int count, const ProgressText& progress) {
  constexpr double kRigid = 5;  // bound on frequencies of rigid modes; elastic modes are faster [Hz]
  const Model model(free_wheelset(element_size));
  const SweptOutline outline = outline_of(model);
  MeshedWheelset out;
  out.mass = model.wheelset->mass();
  out.inertia = model.wheelset->inertia();
  out.outline_mass = model.scene.wheel_material().density * outline.volume;
  out.outline_inertia = model.scene.wheel_material().density * outline.polar;
  out.shaft_torsion = shaft_torsion(model);
  std::map<std::string, int> ordinal;
  for (NaturalMode& mode : natural_modes(model, count, progress)) {
    if (mode.frequency < kRigid) {
      out.rigid.push_back(std::move(mode));
      continue;
    }
    const std::string name = fmt::format("{}, {}", mode.name(), ++ordinal[mode.name()]);
    out.order.push_back(name);
    out.elastic.emplace(name, std::move(mode));
  }
  return out;
}

/// Motion of one section node in a mode, and its place in the figure.
struct ShapePoint {
  double at = 0;         ///< [mm]
  std::size_t node = 0;  ///< index among all section nodes
};

/// Panel with a curve for each of the lowest modes.
Panel shape_panel(const MeshedWheelset& wheelset, const std::string& label,
                  const std::vector<ShapePoint>& points, std::vector<double> NaturalMode::*motion) {
  constexpr std::size_t kCurves = 6;
  Panel panel{label, {}, {}, 300, std::nullopt};
  for (const std::string& name : wheelset.order) {
    if (panel.series.size() == kCurves) break;
    const NaturalMode& mode = wheelset.elastic.at(name);
    Series curve{fmt::format("{}: {:.0f} Hz", name, mode.frequency), {}, {}, Stroke::solid};
    for (const ShapePoint& point : points) {
      curve.x.push_back(point.at);
      curve.y.push_back((mode.*motion)[point.node]);
    }
    panel.series.push_back(std::move(curve));
  }
  return panel;
}

std::vector<Figure> shape_figures(const Model& model, const MeshedWheelset& wheelset) {
  std::vector<ShapePoint> bore, web;
  std::size_t node = 0;
  for (const int b : model.index.wheel()) {
    const Section& section = model.mesh.blocks[static_cast<std::size_t>(b)].section;
    const double inner = *std::min_element(section.q.begin(), section.q.end());
    const auto tie = section.paths.find("tie_inner");
    const double middle = tie == section.paths.end()
                              ? 0
                              : 0.5 * (section.p[static_cast<std::size_t>(tie->second.front())] +
                                       section.p[static_cast<std::size_t>(tie->second.back())]);
    for (std::size_t i = 0; i < section.p.size(); ++i, ++node) {
      if (b == model.index.axle && section.q[i] < inner + 1e-6) bore.push_back({1e3 * section.p[i], node});
      if (b == model.index.disc && std::abs(section.p[i] - middle) < 1e-4)
        web.push_back({1e3 * section.q[i], node});
    }
  }
  const auto by_place = [](const ShapePoint& a, const ShapePoint& b) { return a.at < b.at; };
  std::sort(bore.begin(), bore.end(), by_place);
  std::sort(web.begin(), web.end(), by_place);
  Figure disc, axle;
  disc.title = "Modes of the free half wheelset: middle plane of the disc";
  disc.x_label = "Distance from the axis [mm]";
  disc.panels = {shape_panel(wheelset, "Motion along the axis [-]", web, &NaturalMode::along_axis)};
  axle.title = "Modes of the free half wheelset: bore of the axle";
  axle.x_label = "y, 0 at the rail's centre line [mm]";
  axle.panels = {shape_panel(wheelset, "Radial motion, in torsion around [-]", bore, &NaturalMode::in_plane)};
  return {disc, axle};
}

CaseResult wheelset_modes(const VerifyInputs& inputs, const ProgressText& progress) {
  const double size = inputs["element_size"];
  const double coarse_size = inputs["coarse_element_size"];
  if (coarse_size < 1.2 * size)
    throw InputError(
        fmt::format("verify: coarse_element_size = {:.3g} mm is not 1.2 times element_size = {:.3g} "
                    "mm: refinement would show nothing",
                    1e3 * coarse_size, 1e3 * size));
  const int count = static_cast<int>(std::lround(inputs["modes"]));
  const MeshedWheelset coarse = wheelset_of(coarse_size, count, progress);
  const MeshedWheelset fine = wheelset_of(size, count, progress);
  CaseResult result;
  double rigid = 0;
  for (const NaturalMode& mode : fine.rigid) rigid = std::max(rigid, mode.frequency);
  result.findings = {
      {"mass, against the outline", "kg", fine.mass, fine.outline_mass, 0.01},
      {"inertia about the axle, against the outline", "kg m2", fine.inertia, fine.outline_inertia, 0.01},
      {"the same on the coarse mesh", "kg m2", coarse.inertia, coarse.outline_inertia, {}},
      {"inertia about the axle, against the coarse mesh", "kg m2", fine.inertia, coarse.inertia, 0.02},
      {"rigid modes", "-", static_cast<double>(fine.rigid.size()), 3, 0, true},
      {"the highest of them", "Hz", rigid, 0, 0.1, true}};
  for (const std::string& name : fine.order) {
    const auto found = coarse.elastic.find(name);
    if (found == coarse.elastic.end()) continue;
    result.findings.push_back({name + ", against the coarse mesh", "Hz", fine.elastic.at(name).frequency,
                               found->second.frequency, 0.02});
  }
  // The last modes of one mesh may lie beyond the last of the other.
  constexpr std::size_t kSpared = 2;
  double lacking = 0;
  for (std::size_t i = 0; i + kSpared < fine.order.size(); ++i)
    if (coarse.elastic.count(fine.order[i]) == 0) ++lacking;
  result.findings.push_back({"modes that the coarse mesh lacks", "-", lacking, 0, 0, true});
  const auto torsion = fine.elastic.find("torsion, 1");
  if (torsion != fine.elastic.end())
    result.findings.push_back({"torsion, 1, against a shaft with a rigid disc", "Hz",
                               torsion->second.frequency, fine.shaft_torsion, 0.05});
  result.figures = shape_figures(Model(free_wheelset(size)), fine);
  return result;
}

}  // namespace

VerifyCase wheelset_modes_case() {
  return {"wheelset_modes",
          "mass, inertia and natural modes of the free half wheelset under refinement",
          {{"element_size", &kLength, "mm", 5e-3, {1e-3, 0.02}, "the elements' size of the fine mesh"},
           {"coarse_element_size", &kLength, "mm", 8e-3, {1e-3, 0.02}, "that of the coarse mesh"},
           {"modes", nullptr, "", 16, {4, 100}, "how many modes are computed"}},
          wheelset_modes};
}

}  // namespace tread
