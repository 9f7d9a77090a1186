#include "drivers/report/run_report.hpp"

#include <fmt/core.h>

#include <memory>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/report/energy_tables.hpp"
#include "drivers/report/hammer_figures.hpp"
#include "drivers/report/measurement_figures.hpp"
#include "drivers/report/mesh_measures.hpp"
#include "drivers/report/report_figures.hpp"
#include "drivers/report/report_references.hpp"
#include "drivers/report/surface_figures.hpp"
#include "drivers/results/deflection.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/inventory.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/markup.hpp"
#include "io/report/plain_text.hpp"
#include "io/report/report.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

/// The run as every chapter sees it.
struct Run {
  const Model& model;
  const ResolvedScene& resolved;
  const RunResults& results;
  std::vector<References> references = {};
  std::string without_references = {};  ///< why there are none; empty: all files read

  const Scene& scene() const { return model.scene; }
  bool rolled() const { return model.contact && !results.samples.empty(); }
  bool corrugated() const { return model.contact && !model.contact->corrugation().smooth(); }
  /// Returns true if the wheel has come to the stretch that the scene is about, and not from behind it.
  bool in_sight() const {
    if (!rolled()) return false;
    const Corrugation& corrugation = model.contact->corrugation();
    const Span stretch = corrugated() ? Span{corrugation.first(), corrugation.last()}
                                      : Span{scene().zone_start, scene().zone_start + scene().zone_length};
    return results.reached > stretch.first && scene().start_x() < stretch.last;
  }
  /// Returns true if the wheel has come to the corrugation.
  bool on_corrugation() const { return corrugated() && in_sight(); }
};

/// Rows of quantity, value, unit and remark.
class Quantities {
 public:
  explicit Quantities(std::string title)
      : table_{std::move(title),
               {{"Quantity"}, {"Value", Align::right}, {"Unit"}, {.title = "Remark", .plain = true}},
               {}} {}
  void add(std::string name, double value, std::string unit, std::string remark = "") {
    add_text(std::move(name), readable(value), std::move(unit), std::move(remark));
  }
  void add_text(std::string name, std::string value, std::string unit = "", std::string remark = "") {
    table_.rows.push_back({std::move(name), std::move(value), std::move(unit), std::move(remark)});
  }
  Table take() { return std::move(table_); }

 private:
  Table table_;
};

std::string stretch(double first, double last) {
  return fmt::format("x = {:.3f} ... {:.3f} m", first, last);
}

KeyFigures rolling_figures(const Run& run) {
  const RunResults& r = run.results;
  const char* where = run.on_corrugation() && r.evaluated_first > run.scene().start_x()
                          ? "over the corrugation"
                          : "over the evaluated stretch";
  KeyFigures figures = {
      {fmt::format("Largest F_N {}", where), readable(1e-3 * r.vertical_force.max), "kN"},
      {fmt::format("Smallest F_N {}", where), readable(1e-3 * r.vertical_force.min), "kN"},
      {"Dynamic factor", readable(r.dynamic_factor(), 3), ""},
      {"Static wheel load", readable(-1e-3 * r.preload.contact.force_on_rail.z), "kN"},
      {"F_L / F_N, steady",
       readable(r.traction_coefficient, 3) +
           (r.traction_target ? fmt::format(" (target {})", readable(*r.traction_target, 3)) : ""),
       ""},
      {"Creepage, steady", stands(run.scene()) ? "–" : readable(100 * r.creepage, 3), "%"},
      {"Frictional work per way over F_L", r.creepage_of_work ? readable(100 * *r.creepage_of_work, 3) : "–",
       "%"},
      {"Energy error", readable(100 * r.energy_error, 2), "%"}};
  return figures;
}

KeyFigures static_figures(const Run& run) {
  const ContactTotals& contact = run.results.preload.contact;
  return {{"Contact force", readable(-1e-3 * contact.force_on_rail.z), "kN"},
          {"Largest pressure", readable(1e-6 * run.results.preload.max_pressure), "MPa"},
          {"Patch area", readable(1e6 * contact.area), "mm²"},
          {"Largest penetration", readable(1e6 * contact.max_penetration, 3), "µm"},
          {"Residual / load", readable(run.results.preload.residual, 2), ""}};
}

std::string slip_sentence(const Run& run) {
  return run.results.evaluated_last > run.results.evaluated_first
             ? fmt::format(" The whole patch slides during {:.1f} % of it.",
                           100 * run.results.full_slip_share)
             : "";
}

Chapter result_chapter(const Run& run) {
  const RunResults& r = run.results;
  Chapter chapter{"Result", {}};
  if (run.rolled()) {
    chapter.blocks.emplace_back(rolling_figures(run));
    std::string text;
    if (run.corrugated() && !run.on_corrugation())
      text = fmt::format("The wheel comes to x = {:.3f} m, before the corrugation. ", r.reached);
    text += fmt::format("Largest and smallest F_N: {}.{} Steady values: means over {}.",
                        stretch(r.evaluated_first, r.evaluated_last), slip_sentence(run),
                        stretch(r.steady_first, r.steady_last));
    if (r.driven && !traction_is_steady(run.scene(), r))
      text += " They are not steady: the chapter Warnings says why.";
    chapter.blocks.emplace_back(Text{text});
  } else if (run.model.contact) {
    chapter.blocks.emplace_back(static_figures(run));
  } else if (!r.samples.empty()) {
    const EnergyLedger& last = r.samples.back().energy;
    chapter.blocks.emplace_back(KeyFigures{{"Kinetic energy at the end", readable(last.kinetic), "J"},
                                           {"Strain energy at the end", readable(last.strain), "J"},
                                           {"Energy error", readable(100 * r.energy_error, 2), "%"},
                                           {"Time", readable(1e3 * r.samples.back().time), "ms"},
                                           {"Steps", grouped(r.steps), ""}});
  }
  std::vector<Comparison> theory = hertz_comparisons(run.model, r);
  const JsonRecord summary = parse_json(summary_json(run.model, run.resolved, r), "summary");
  for (const References& references : run.references) {
    const std::vector<Comparison> rows = comparisons(references, false, run.model, r, summary);
    if (!rows.empty())
      chapter.blocks.emplace_back(comparison_table(references.title, references.column, rows));
    for (const Comparison& row : comparisons(references, true, run.model, r, summary)) theory.push_back(row);
  }
  if (!theory.empty()) chapter.blocks.emplace_back(comparison_table("Beside theory", "Theory", theory));
  if (!run.without_references.empty()) chapter.blocks.emplace_back(Text{run.without_references});
  return chapter;
}

Chapter surface_chapter(const Run& run) {
  const SurfaceResults& s = run.results.surface;
  Chapter chapter{"Surface", {surface_figure(run.model, run.results)}};
  Quantities q("");
  if (s.last > s.first) {
    q.add("Largest pressure", 1e-6 * s.max_pressure, "MPa", stretch(s.first, s.last) + ", whole width");
    q.add("Largest surface shear stress", 1e-6 * s.max_shear, "MPa");
    q.add("Largest Von Mises stress", 1e-6 * s.max_von_mises, "MPa", "centres of the surface elements");
    q.add("Largest frictional work per area", 1e-3 * s.max_work, "kJ/m²");
    q.add("Frictional work of a 1.1 mm cell, mean", 1e3 * s.cell_work.mean, "mJ", "on the axis");
    q.add("Range of it", 1e3 * s.cell_work.range(), "mJ",
          fmt::format("{} mJ by samples", readable(1e3 * s.sampled_cell_work.range())));
  }
  q.add("Frictional work of the whole passage", s.total_work, "J",
        fmt::format("{} J by samples", readable(s.total_sampled_work)));
  chapter.blocks.emplace_back(q.take());
  if (run.results.rail_line)
    chapter.blocks.emplace_back(deflection_figure(deflection(*run.results.rail_line, run.scene().start_x())));
  return chapter;
}

Chapter patch_chapter(const Run& run) {
  const RunResults& r = run.results;
  Chapter chapter{"Patch", {}};
  if (!r.instants.empty()) {
    chapter.blocks.emplace_back(snapshots_figure(run.model, r));
    chapter.blocks.emplace_back(stick_slip_drawings(run.model, r));
    chapter.blocks.emplace_back(
        Text{fmt::format("Seen from above{}; a cell for each surface node that touches.",
                         stands(run.scene()) ? "" : ", rolling to the right")});
  }
  if (!r.movie.empty()) chapter.blocks.emplace_back(patch_movie(run.model, r));
  if (run.rolled()) chapter.blocks.emplace_back(patch_figure(run.model, r));
  return chapter;
}

Chapter preload_chapter(const Run& run) {
  const Preload& p = run.results.preload;
  const Scene& scene = run.scene();
  Chapter chapter{"Preload", {}};
  Quantities q("");
  if (run.model.contact) {
    const ContactTotals& contact = p.contact;
    const double force = -contact.force_on_rail.z;
    q.add("Vertical contact force F_N", 1e-3 * force, "kN",
          fmt::format("weight and load: {:.3f} kN", 1e-3 * run.model.wheel_load()));
    q.add("Lateral contact force on the wheel", -1e-3 * contact.force_on_rail.y, "kN",
          "positive to the field side");
    q.add("Patch area", 1e6 * contact.area, "mm²");
    q.add("Largest pressure", 1e-6 * run.results.preload.max_pressure, "MPa",
          fmt::format("average at a rail node; {:.1f} MPa at an integration point",
                      1e-6 * contact.max_pressure));
    const double approach = run.model.hertz_patch.approach;
    q.add("Largest penetration", 1e6 * contact.max_penetration, "µm",
          run.model.line_width > 0 ? ""
                                   : fmt::format("{:.1f} % of the Hertz approach of {:.1f} µm",
                                                 100 * contact.max_penetration / approach, 1e6 * approach));
    q.add("Centre of pressure across the rail", 1e3 * contact.centre.y, "mm",
          "from the crown's centre line, field side positive");
    q.add("Centre of pressure across the wheel", 1e3 * (contact.centre.y + scene.wheel->lateral_offset), "mm",
          "from the nominal rolling circle");
    q.add("Tilt of the wheel about x", 1e3 * p.tilt, "mrad");
    q.add("Tilt of the rail's head about x", 1e3 * p.rail_tilt, "mrad");
  }
  if (scene.rail && scene.rail->support == "fastenings" && run.model.contact) {
    std::string remark;
    if (scene.fastenings && scene.alike_supports())
      remark = fmt::format("beam on the fastenings, foot {}: {} mm", scene.fastenings->along.kind,
                           readable(1e3 * loaded_deflection(scene, scene.start_x(), run.model.wheel_load())));
    q.add("Rail deflection under the wheel", 1e3 * p.rail_deflection, "mm", remark);
  }
  if (run.model.index.slab >= 0) q.add("Slab deflection under the wheel", 1e6 * p.slab_deflection, "µm");
  if (run.model.wheelset) {
    q.add("Reaction of the held longitudinal motion", p.held_force_x, "N",
          "of the wheel's mean, without traction; should be about zero");
    q.add("Reaction of the held rotation", p.held_moment, "N m",
          "about the axle, without traction; should be about zero");
  }
  q.add("Residual / load", p.residual, "-",
        fmt::format("{} iterations of Newton, {} of conjugate gradients", p.newton_iterations,
                    p.cg_iterations));
  chapter.blocks.emplace_back(q.take());
  return chapter;
}

Chapter energy_chapter(const Run& run) {
  Chapter chapter{"Energy", {}};
  const RunResults& r = run.results;
  if (!r.samples.empty()) {
    chapter.blocks.emplace_back(energy_figure(run.model, r));
    chapter.blocks.emplace_back(Text{energy_error_text(run.model, r)});
    if (run.model.contact) chapter.blocks.emplace_back(momentum_table(r.momentum, r.momentum_error));
  }
  chapter.blocks.emplace_back(body_energy_table(run.model, r));
  return chapter;
}

Chapter model_chapter(const Run& run) {
  Chapter chapter{"Mesh", {}};
  const std::vector<BlockMeasures> blocks = by_group(run.model, measure_blocks(run.model));
  chapter.blocks.emplace_back(section_drawings(run.model));
  chapter.blocks.emplace_back(side_drawings(run.model));
  Table counts = count_table(blocks);
  counts.title = "Elements";
  chapter.blocks.emplace_back(counts);
  Table quality = quality_table(blocks);
  quality.title = "Smallest and worst elements";
  chapter.blocks.emplace_back(quality);
  return chapter;
}

Chapter cost_chapter(const Run& run) {
  const RunResults& r = run.results;
  Chapter chapter{"Cost", {}};
  Quantities q("");
  const auto elements = static_cast<double>(run.model.elements());
  q.add_text("Elements", grouped(run.model.elements()));
  q.add_text("Nodes", grouped(run.model.nodes()));
  if (r.steps > 0) {
    q.add_text("Steps", grouped(r.steps), "",
               r.origin
                   ? fmt::format("the first {} are those of {}", grouped(r.origin->steps), r.origin->folder)
                   : "");
    q.add("Time step", r.dt, "s", r.limit.reason);
  }
  q.add("Mesh and coefficients", r.seconds_mesh, "s");
  q.add("Preload", r.seconds_preload, "s",
        r.origin                ? "of the other run"
        : r.preload_cached != 0 ? "time of the earlier run that solved it"
                                : "");
  if (r.steps > 0) {
    const double element_steps = elements * static_cast<double>(r.own_steps());
    q.add("Rolling", r.seconds_rolling, "s");
    q.add("Million element-steps per second", 1e-6 * element_steps / r.seconds_rolling, "");
    q.add("Time of an element-step", 1e9 * r.seconds_rolling / element_steps, "ns");
  }
  const std::shared_ptr<Ranks> ranks = chosen_ranks();
  q.add_text(
      "Threads", std::to_string(threads()), "",
      fmt::format("{}instruction set {}", ranks ? fmt::format("of each of {} ranks; ", ranks->count()) : "",
                  run.model.internal->instruction_set()));
  q.add_text("Device", device_name(), "", "takes the steps");
  const double seconds = run.results.seconds_preload + run.results.seconds_rolling;
  q.add_text("Peak memory", bytes_text(peak_memory()), "",
             fmt::format("{}: {}", ranks ? "of rank 0; estimate for one process" : "estimate",
                         bytes_text(peak_bytes(run.model, seconds, file_bytes(run.resolved.source)))));
  chapter.blocks.emplace_back(q.take());
  chapter.blocks.emplace_back(phase_table(run.model));
  chapter.blocks.emplace_back(field_table(run.model));
  return chapter;
}

Chapter scene_chapter(const Run& run) {
  Table table{"",
              {{.title = "Key", .plain = true},
               {.title = "Value", .plain = true},
               {.title = "Source", .plain = true},
               {"Meaning"}},
              {}};
  for (const Entry& entry : run.resolved.entries) {
    std::string meaning = entry.description;
    std::erase(meaning, '`');
    table.rows.push_back({entry.path, entry.shown, entry.source, meaning});
  }
  return {"Scene", {table}};
}

/// A file of references that does not read must not cost a finished run its report.
void find_references(Run& run) {
  try {
    run.references = library_references(run.scene());
  } catch (const InputError& error) {
    run.without_references = fmt::format("Without values from the literature: {}", error.what());
  }
}

std::string friction_text(const ContactSpec& contact) {
  if (contact.friction_law == "table")
    return fmt::format("f of a table, up to {:g}", contact.largest_friction());
  if (contact.friction_law == "falling")
    return fmt::format("f {:g} falling to {:g}", contact.friction, contact.friction_fast);
  return fmt::format("f {:g}", contact.friction);
}

std::string subtitle(const Run& run) {
  const Scene& scene = run.scene();
  std::string text = run.resolved.name;
  if (scene.motion && scene.wheel) text += fmt::format(" · {:.4g} km/h", 3.6 * scene.motion->speed);
  if (scene.motion && scene.motion->traction_mu)
    text += fmt::format(" · mu {:g}", *scene.motion->traction_mu);
  if (scene.contact) text += fmt::format(" · {}", friction_text(*scene.contact));
  text += fmt::format(" · quality {}, contact elements {} mm", scene.quality,
                      readable(1e3 * run.model.sizes.contact, 3));
  if (const std::optional<ForkOrigin>& origin = run.results.origin)
    text += fmt::format(" · fork of {} at {} ms", origin->folder, readable(1e3 * origin->time, 6));
  return text;
}

}  // namespace

void write_run_report(const std::filesystem::path& path, const Model& model, const ResolvedScene& resolved,
                      const RunResults& results, const Provenance& provenance) {
  Run run{model, resolved, results};
  find_references(run);
  Report report{resolved.scene.title, subtitle(run), {}, {}};
  if (!results.warnings.empty()) {
    report.chapters.push_back({"Warnings", {}});
    for (const std::string& warning : results.warnings)
      report.chapters.back().blocks.emplace_back(Text{warning});
  }
  report.chapters.push_back(result_chapter(run));
  if (run.rolled()) {
    Chapter forces{"Forces", {}};
    if (run.in_sight() && !stands(model.scene)) forces.blocks.emplace_back(force_figure(model, results));
    forces.blocks.emplace_back(passage_figure(model, results));
    if (Figure spectrum = spectrum_figure(results); !spectrum.panels.empty())
      forces.blocks.emplace_back(std::move(spectrum));
    report.chapters.push_back(std::move(forces));
    report.chapters.push_back(
        {"Creepage", {creepage_figure(model, results, creepage_levels(run.references))}});
    if (!results.surface.axis.empty()) report.chapters.push_back(surface_chapter(run));
  }
  if (Chapter patch = patch_chapter(run); !patch.blocks.empty()) report.chapters.push_back(std::move(patch));
  if (Chapter measured = measurement_chapter(model, results); !measured.blocks.empty())
    report.chapters.push_back(std::move(measured));
  if (model.hammer && !results.samples.empty()) report.chapters.push_back(hammer_chapter(model, results));
  report.chapters.push_back(energy_chapter(run));
  if (model.contact || results.preload.newton_iterations > 0) report.chapters.push_back(preload_chapter(run));
  report.chapters.push_back(model_chapter(run));
  report.chapters.push_back(cost_chapter(run));
  report.chapters.push_back(scene_chapter(run));
  state_provenance(report, resolved.name, provenance);
  write_report(path, report);
}

}  // namespace tread
