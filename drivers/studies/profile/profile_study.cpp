#include "drivers/studies/profile/profile_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/point_scatter.hpp"
#include "core/geometry/section_constants.hpp"
#include "core/millimetre.hpp"
#include "drivers/studies/profile/profile_figures.hpp"
#include "drivers/studies/profile/shown_profile.hpp"
#include "io/files/named_output.hpp"
#include "io/report/plain_text.hpp"
#include "io/report/report.hpp"
#include "io/text/json.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

/// A line of the listing.
struct Line {
  std::string name, value;
};

std::string length_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.2f} mm", value / mm) : std::string("–");
}

std::string radius_text(const ShownProfile& profile, double y) {
  const double curvature = curvature_at(profile, y);
  if (!std::isfinite(curvature)) return "–";
  if (std::abs(curvature) < 0.2) return "straight";
  return fmt::format("{:.1f} mm {}", 1 / std::abs(curvature) / mm, curvature > 0 ? "convex" : "concave");
}

std::vector<Line> listing(const ShownProfile& profile) {
  const ProfileMeasures m = measures_of(profile);
  std::vector<Line> lines = {
      {"Profile", fmt::format("{}, {}", profile.name, profile.wheel ? "wheel" : "rail")}};
  if (!profile.file) {
    lines.push_back({"Read as", "built in"});
  } else {
    const std::string reading = reading_of(*profile.file);
    const std::size_t end = reading.find("; ");
    lines.push_back({"Read as", reading.substr(0, end)});
    if (!profile.file->side.empty()) lines.push_back({"Side", profile.file->side + ", as the file states"});
    lines.push_back({"Changes", end == std::string::npos ? "none" : reading.substr(end + 2)});
    lines.push_back({"Kept", fmt::format("{} points", profile.file->y.size())});
    if (const double scatter = point_scatter(profile.file->y, profile.file->z).value_or(0);
        scatter >= kRoughProfile)
      lines.push_back(
          {"Scatter", fmt::format("{:.2g} um about a smooth line; --smoothing \"{:.2g} mm\" smooths it",
                                  1e6 * scatter, 1e3 * smoothing_of(scatter))});
  }
  lines.push_back({"y", fmt::format("{:.2f} ... {:.2f} mm", m.left / mm, m.right / mm)});
  lines.push_back({"z", fmt::format("{:.2f} ... {:.2f} mm", m.low / mm, m.high / mm)});
  lines.push_back({"Slope", fmt::format("{:.4f} at y = 0", m.slope)});
  for (const double y : {-20 * mm, 0.0, 20 * mm})
    lines.push_back({"Radius", fmt::format("{} at y = {:g} mm", radius_text(profile, y), y / mm)});
  if (profile.wheel) {
    lines.push_back(
        {"Flange", fmt::format("height Sh {}, thickness Sd {}, gradient qR {}", length_text(m.flange_height),
                               length_text(m.flange_thickness), length_text(m.flange_gradient))});
  } else {
    lines.push_back({"Head", fmt::format("{} wide 14 mm below the crown, middle at y = {}",
                                         length_text(m.head_width), length_text(m.head_middle))});
    if (profile.section) {
      if (const double lean = head_lean(profile.curve, 0); lean != 0)
        lines.push_back({"Lean", lean_hint(lean)});
      const SectionConstants c = section_constants(*profile.section);
      lines.push_back({"Section", fmt::format("area {:.2f} cm2, height {:g} mm, I_y {:.1f} cm4 (vertical), "
                                              "I_z {:.1f} cm4, {:.2f} kg/m of 7850 kg/m3",
                                              1e4 * c.area, profile.section->height / mm, 1e8 * c.vertical,
                                              1e8 * c.lateral, 7850 * c.area)});
    }
  }
  if (!profile.misfit.empty()) lines.push_back({"Refused", profile.misfit});
  return lines;
}

std::string text_of(const ShownProfile& profile) {
  std::string text;
  std::string last;
  for (const Line& line : listing(profile)) {
    text += fmt::format("{:<10}{}\n", line.name == last ? "" : line.name, line.value);
    last = line.name;
  }
  return text;
}

Json json_of(const ShownProfile& profile) {
  const ProfileMeasures m = measures_of(profile);
  Json json = {{"profile", profile.name},
               {"kind", profile.wheel ? "wheel" : "rail"},
               {"y_m", {m.left, m.right}},
               {"z_m", {m.low, m.high}},
               {"slope_at_0", m.slope}};
  const auto add = [&](const char* key, double value) {
    if (std::isfinite(value)) json[key] = value;
  };
  add("flange_height_m", m.flange_height);
  add("flange_thickness_m", m.flange_thickness);
  add("flange_gradient_m", m.flange_gradient);
  add("head_width_m", m.head_width);
  add("head_middle_m", m.head_middle);
  if (profile.section) {
    const SectionConstants c = section_constants(*profile.section);
    json["area_m2"] = c.area;
    json["height_m"] = profile.section->height;
    json["vertical_moment_of_inertia_m4"] = c.vertical;
    json["lateral_moment_of_inertia_m4"] = c.lateral;
  }
  if (!profile.misfit.empty()) json["refused"] = profile.misfit;
  if (!profile.file) return json;
  const UnderstoodProfile& f = *profile.file;
  json["format"] = f.format;
  json["units"] = f.units;
  if (!f.side.empty()) json["side"] = f.side;
  json["points"] = f.points;
  json["kept"] = f.y.size();
  json["reversed"] = f.reversed;
  json["mirrored"] = f.mirrored;
  json["z_turned"] = f.z_turned;
  json["subtracted_from_y_m"] = f.from_back;
  json["duplicates"] = f.duplicates;
  json["spikes"] = f.spikes;
  json["folded"] = f.folded;
  json["cut"] = f.cut;
  json["largest_deviation_m"] = f.largest_deviation();
  json["notes"] = f.notes;
  return json;
}

std::string columns_of(const ShownProfile& profile) {
  std::string text =
      fmt::format("# {}: y [mm] to the field side, z [mm] {}\n", profile.wheel ? "wheel" : "rail",
                  profile.wheel ? "towards the flange tip" : "upwards");
  const auto row = [&](double y, double z) { text += fmt::format("{:.6f} {:.6f}\n", y / mm, z / mm); };
  if (profile.file) {
    for (std::size_t i = 0; i < profile.file->y.size(); ++i) row(profile.file->y[i], profile.file->z[i]);
    return text;
  }
  const int count = static_cast<int>(std::ceil(profile.curve.length() / (0.25 * mm)));
  double last = -1;
  for (int i = 0; i <= count; ++i) {
    const Point2 p = profile.curve.at(profile.curve.length() * i / count).position;
    if (p.x <= last + 1e-6) continue;  // an end may stand upright
    row(p.x, p.y);
    last = p.x;
  }
  return text;
}

Table touching_table(const std::vector<TouchingAt>& places) {
  Table table{"",
              {{"wheel.lateral_offset [mm]", Align::right},
               {"y on the rail [mm]", Align::right},
               {"y on the wheel [mm]", Align::right},
               {"slope of the rail", Align::right}},
              {}};
  for (const TouchingAt& at : places)
    table.rows.push_back({fmt::format("{:g}", at.lateral_offset / mm), fmt::format("{:.2f}", at.place.y / mm),
                          fmt::format("{:.2f}", at.place.wheel_y / mm),
                          fmt::format("{:.3f}", at.place.slope)});
  return table;
}

double inclination_of(const ProfileOptions& options) {
  try {
    return parse_ratio(options.inclination);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--inclination {}: {}", options.inclination, error.what()));
  }
}

/// InputError for an option of files, or of a rail's file, where none is shown.
void require_what_options_change(const ProfileOptions& options, const std::vector<ShownProfile>& shown) {
  const ProfileOptions usual;
  const auto require = [&](bool stated, const char* option, const char* what, bool of_rail) {
    const auto changed = [&](const ShownProfile& one) { return one.file && !(of_rail && one.wheel); };
    if (stated && std::ranges::none_of(shown, changed))
      throw InputError(
          fmt::format("{} changes the points of a {}, and none is given; leave it out", option, what));
  };
  require(options.shift != usual.shift, "--shift", "file", false);
  require(options.smoothing != usual.smoothing, "--smoothing", "file", false);
  require(options.mirrored, "--mirrored", "rail's file", true);
  require(options.section != usual.section, "--section", "rail's file", true);
}

/// InputError for an inclination where nothing touches the rail.
void require_contact_of(const ProfileOptions& options) {
  if (options.against.empty() && options.inclination != ProfileOptions().inclination)
    throw InputError(
        fmt::format("--inclination {}: it turns the rail under a wheel, and --against names no other body; "
                    "state that, or leave the inclination out",
                    options.inclination));
}

}  // namespace

void profile(const ProfileOptions& options) {
  if (options.wheel && options.rail) throw InputError("--wheel and --rail: a file holds one of them");
  require_contact_of(options);
  for (const auto& output : {options.output, options.svg})
    for (const auto& input : {options.file, options.against}) require_other_file(output, input);
  const std::optional<bool> stated =
      options.wheel || options.rail ? std::optional(options.wheel) : std::nullopt;
  const ShownProfile shown = shown_profile(options.file, stated, options);
  std::optional<ShownProfile> other;
  std::vector<TouchingAt> coarse, fine;
  if (!options.against.empty()) {
    other = shown_profile(options.against, !shown.wheel, options);
    const ShownProfile &rail = shown.wheel ? *other : shown, &wheel = shown.wheel ? shown : *other;
    coarse = touching_over_offset(rail, inclination_of(options), wheel, 1 * mm);
    if (!options.svg.empty()) fine = touching_over_offset(rail, inclination_of(options), wheel, 0.1 * mm);
  }
  std::vector<ShownProfile> all = {shown};
  if (other) all.push_back(*other);
  require_what_options_change(options, all);
  if (!options.output.empty()) write_named_text(options.output, columns_of(shown));
  if (!options.svg.empty()) {
    write_named_text(options.svg, figure_svg(profile_figure(shown)));
    if (other && has_neighbours(options.svg)) {
      std::filesystem::path beside = options.svg;
      beside.replace_filename(options.svg.stem().string() + "-touching.svg");
      const ShownProfile &rail = shown.wheel ? *other : shown, &wheel = shown.wheel ? shown : *other;
      write_named_text(beside, figure_svg(touching_figure(fine, rail, wheel)));
    }
  }
  if (options.json) {
    Json json = json_of(shown);
    if (other) {
      json["against"] = json_of(*other);
      for (const TouchingAt& at : coarse)
        json["touching"].push_back({{"lateral_offset_m", at.lateral_offset},
                                    {"y_rail_m", at.place.y},
                                    {"y_wheel_m", at.place.wheel_y},
                                    {"slope", at.place.slope}});
    }
    fmt::print("{}", json_text(json));
    return;
  }
  fmt::print("{}", text_of(shown));
  if (other) fmt::print("\n{}\n{}", text_of(*other), plain_text(touching_table(coarse)));
}

}  // namespace tread
