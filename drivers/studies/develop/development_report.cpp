#include "drivers/studies/develop/development_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "drivers/report/figure_parts.hpp"
#include "io/report/markup.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

constexpr double kMillion = 1e6;  ///< number of real passages for which growth is stated

/// Empty for a band with one line.
std::string coherence_text(const std::optional<double>& coherence, int digits) {
  return coherence ? fmt::format("{:.{}f}", *coherence, digits) : "";
}

std::vector<double> places(const WornProfile& profile) {
  std::vector<double> x;
  for (std::size_t i = 0; i < profile.depth.size(); ++i) x.push_back(profile.x(i));
  return x;
}

/// Profile after so many passages; the last one is the present profile.
const WornProfile& profile_after(const Development& d, std::size_t passages) {
  return passages < d.passages.size() ? d.passages[passages].profile : d.profile;
}

Figure along_the_rail(std::string name, std::string title, std::vector<Panel> panels) {
  Figure figure;
  figure.name = std::move(name);
  figure.title = std::move(title);
  figure.x_label = "Along the rail [m]";
  figure.panels = std::move(panels);
  return figure;
}

Series heights(const WornProfile& profile, std::string label, Stroke stroke) {
  return {std::move(label), places(profile), scaled(profile.depth, -1e6), stroke};
}

/// Growth rate by wavelength: by the work of the first and the last passage, and from the profiles.
Figure growth_figure(const Development& d) {
  Series first{"by the work of the first passage", {}, {}, Stroke::solid};
  Series last{"by that of the last", {}, {}, Stroke::dashed};
  Series measured{"from first and last profile", {}, {}, Stroke::dotted};
  const std::vector<BandOutcome> bands = outcome(d);
  for (std::size_t i = bands.size(); i-- > 0;) {
    const BandOutcome& b = bands[i];
    if (!b.telling) continue;
    for (auto [series, value] : {std::pair{&first, b.first_growth}, std::pair{&last, b.last_growth},
                                 std::pair{&measured, b.growth}}) {
      series->x.push_back(1e3 * b.wavelength);
      series->y.push_back(kMillion * value);
    }
  }
  Figure figure;
  figure.name = "growth";
  figure.title = "Logarithmic growth by wavelength";
  figure.x_label = "Wavelength [mm]";
  figure.panels.push_back({"Per million passages",
                           {std::move(first), std::move(last), std::move(measured)},
                           {{0, ""}},
                           260,
                           std::nullopt});
  figure.caption = "Above zero waves grow: the frictional work is larger in their troughs.";
  return figure;
}

Figure profile_figure(const Development& d) {
  return along_the_rail(
      "profile", "Running surface",
      {{"Height [µm]",
        {heights(d.plan.start, "at the start", Stroke::dashed),
         heights(d.profile, fmt::format("after {} passages", d.passages.size()), Stroke::solid)},
        {},
        220,
        std::nullopt}});
}

/// Work of a passage and its uneven part, over the profile.
Figure work_figure(const Development& d, std::size_t number) {
  const WornPassage& passage = d.passages[number];
  return along_the_rail(
      number == 0 ? "work-first" : "work-last",
      fmt::format("Passage {}: work beyond that of the smooth rail", number + 1),
      {{"Height [µm]", {heights(passage.profile, "rail", Stroke::solid)}, {}, 130, std::nullopt},
       {"Work [J/m²]",
        {{"at the nodes", passage.work.x, passage.work.work, Stroke::dotted},
         {"that wears unevenly", places(passage.profile), passage.uneven, Stroke::solid}},
        {},
        220,
        std::nullopt}});
}

Figure spectrum_figure(const Development& d) {
  Figure figure;
  figure.name = "spectrum";
  figure.title = "Depth in one-third octave bands";
  figure.x_label = "Wavelength [mm]";
  Panel panel{"Root mean square [µm]", {}, {}, 220, std::nullopt};
  const auto add = [&](const std::vector<GrowthBand>& bands, std::string label, Stroke stroke) {
    Series series{std::move(label), {}, {}, stroke};
    for (std::size_t i = bands.size(); i-- > 0;) {
      series.x.push_back(1e3 * bands[i].wavelength);
      series.y.push_back(1e6 * bands[i].depth);
    }
    panel.series.push_back(std::move(series));
  };
  add(d.passages.front().bands, "at the start", Stroke::dashed);
  add(d.bands_now(), fmt::format("after {} passages", d.passages.size()), Stroke::solid);
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// Height of the rows that carry work, less their mean along the rail.
Heatmap rows_map(const Development& d) {
  constexpr double kLeastShare = 1e-3;
  Heatmap map;
  map.name = "rows";
  map.title = fmt::format("Running surface after {} passages", d.passages.size());
  map.x_label = "Along the rail [m]";
  map.y_label = "Across [mm]";
  map.value_label = "Height [µm]";
  map.x = places(d.profile);
  for (std::size_t j = 0; j < d.rows->y.size(); ++j) {
    if (d.rows->share[j] < kLeastShare) continue;
    map.y.push_back(1e3 * d.rows->y[j]);
    for (const double depth : d.rows->depth[j]) map.values.push_back(-1e6 * depth);
  }
  map.caption = "Rows of nodes that carry more than a thousandth of the work.";
  return map;
}

std::string left_out(const Development& d) {
  const std::string across = d.rows ? "" : "; changes across the rail, for the profile keeps its parabola";
  return "Left out: plastic flow and hardening; wear of the wheel; lateral motion and shifting contact, so "
         "that all vehicles run in one band; vehicles of other speeds, loads and tractions, and the second "
         "wheelset of a bogie, all of which smear phases that here are always the same; a wear coefficient "
         "that depends on the power" +
         across +
         ". What wears the whole rail evenly is left out, too. Work of a passage over the smooth rail (mesh, "
         "fastenings, the "
         "rest of the start) is subtracted.";
}

KeyFigures key_figures(const Development& d) {
  const std::optional<BandOutcome> band = deepest(outcome(d));
  const double wear = d.plan.per_work * d.mean_work();
  KeyFigures figures = {{"Passages simulated", std::to_string(d.passages.size()), ""},
                        {"Real passages", readable(d.real_passages(), 3), ""},
                        {"Even wear of a million passages", readable(1e3 * kMillion * wear, 3), "mm"}};
  if (band) {
    figures.push_back({"Deepest band", readable(1e3 * band->wavelength), "mm"});
    figures.push_back({"Its growth per mm of even wear", readable(1e-3 * band->per_wear, 3), "1/mm"});
  }
  return figures;
}

Table passage_table(const Development& d) {
  Table table{"Passages",
              {{"Passage", Align::right},
               {"Stands for", Align::right},
               {"Depth of the deepest band, rms [µm]", Align::right},
               {"Range of the work that wears [J/m²]", Align::right}},
              {}};
  for (std::size_t i = 0; i < d.passages.size(); ++i) {
    const WornPassage& passage = d.passages[i];
    const WornProfile uneven{0, 0, passage.uneven};
    const GrowthBand* band = deepest_band(passage.bands);
    table.rows.push_back({std::to_string(i + 1), readable(passage.passages, 3),
                          band ? readable(1e6 * band->depth) : "–", readable(uneven.range())});
  }
  return table;
}

}  // namespace

std::string profiles_csv(const Development& d) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "x [m]");
  for (std::size_t k = 0; k <= d.passages.size(); ++k) fmt::format_to(out, ",depth_after_{} [m]", k);
  for (std::size_t i = 0; i < d.profile.depth.size(); ++i) {
    fmt::format_to(out, "\n{:.6g}", d.profile.x(i));
    for (std::size_t k = 0; k <= d.passages.size(); ++k)
      fmt::format_to(out, ",{:.6g}", profile_after(d, k).depth[i]);
  }
  fmt::format_to(out, "\n");
  return {text.data(), text.size()};
}

std::string spectra_csv(const Development& d) {
  std::string text =
      "passage,real_passages_before,wavelength [m],depth_rms [m],response_real [J/m3],response_imaginary "
      "[J/m3],coherence [-],growth [1/passage]\n";
  double before = 0;
  for (std::size_t k = 0; k < d.passages.size(); ++k) {
    for (const GrowthBand& band : d.passages[k].bands)
      text += fmt::format("{},{:.6g},{:g},{:.6g},{:.6g},{:.6g},{},{:.6g}\n", k + 1, before, band.wavelength,
                          band.depth, band.response.real(), band.response.imag(),
                          coherence_text(band.coherence, 4), d.plan.per_work * band.response.real());
    before += d.passages[k].passages;
  }
  return text;
}

std::string growth_csv(const Development& d) {
  std::string text =
      "wavelength [m],depth_rms_before [m],depth_rms_after [m],growth_of_profile [1/passage],"
      "growth_by_first_work [1/passage],growth_by_last_work [1/passage],growth_per_even_wear [1/m],"
      "lag_of_work [waves],coherence [-],telling\n";
  for (const BandOutcome& b : outcome(d))
    text += fmt::format("{:g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4f},{},{}\n", b.wavelength,
                        b.before, b.after, b.growth, b.first_growth, b.last_growth, b.per_wear, b.lag,
                        coherence_text(b.coherence, 4), b.telling ? 1 : 0);
  return text;
}

std::string development_json(const Development& d) {
  Json json = {{"passages", d.passages.size()},
               {"real_passages", d.real_passages()},
               {"mean_work_J_per_m2", d.mean_work()},
               {"even_wear_m_per_passage", d.plan.per_work * d.mean_work()},
               {"verdict", verdict(d)}};
  json["bands"] = Json::array();
  for (const BandOutcome& b : outcome(d))
    json["bands"].push_back({{"wavelength_m", b.wavelength},
                             {"depth_rms_before_m", b.before},
                             {"depth_rms_after_m", b.after},
                             {"growth_of_profile_per_passage", b.growth},
                             {"growth_by_first_work_per_passage", b.first_growth},
                             {"growth_by_last_work_per_passage", b.last_growth},
                             {"growth_per_even_wear_per_m", b.per_wear},
                             {"lag_of_work_waves", b.lag},
                             {"coherence", number_or_null(b.coherence)},
                             {"telling", b.telling}});
  return json_text(json);
}

Table growth_table(const Development& d) {
  Table table{"",
              {{"Wave [mm]", Align::right},
               {"Depth before [µm]", Align::right},
               {"after", Align::right},
               {"Growth per 10⁶: profiles", Align::right},
               {"first work", Align::right},
               {"last work", Align::right},
               {"per mm worn", Align::right},
               {"Past trough [waves]", Align::right},
               {"Coherence", Align::right}},
              {}};
  for (const BandOutcome& b : outcome(d)) {
    const auto growth = [](double value) { return fmt::format("{:+.3g}", kMillion * value); };
    table.rows.push_back({readable(1e3 * b.wavelength) + (b.telling ? "" : " *"), readable(1e6 * b.before, 3),
                          readable(1e6 * b.after, 3), growth(b.growth), growth(b.first_growth),
                          growth(b.last_growth), fmt::format("{:+.3g}", 1e-3 * b.per_wear),
                          fmt::format("{:+.2f}", b.lag), b.coherence ? coherence_text(b.coherence, 2) : "–"});
  }
  return table;
}

std::string verdict(const Development& d) {
  const std::optional<BandOutcome> band = deepest(outcome(d));
  if (d.passages.empty()) return "No passage has worn the rail yet.";
  if (!band) return "No one-third octave band lies between wear.shortest and wear.longest.";
  const bool feeds = band->first_growth > 0;
  std::string text = fmt::format(
      "Over waves of {} mm the frictional work is largest {:.2f} waves {} the trough: it {} them, {:+.3g} in "
      "the logarithm of their depth per mm of even wear",
      readable(1e3 * band->wavelength), std::abs(band->lag), band->lag > 0 ? "past" : "before",
      feeds ? "feeds" : "alleviates", 1e-3 * band->per_wear);
  if (!band->telling)
    text += band->coherence.value_or(1) < kTellingCoherence
                ? fmt::format("; with a coherence of {:.2f} that tells little", *band->coherence)
                : "; profile or work had too little of these waves to tell";
  return text + ".";
}

Report development_report(const Development& d, const ResolvedScene& resolved, const Provenance& provenance) {
  const Scene& scene = resolved.scene;
  Report report;
  report.title = scene.title.empty() ? "Development of a corrugation" : scene.title;
  report.subtitle =
      fmt::format("{} simulated passages at {} km/h", d.passages.size(), readable(3.6 * scene.motion->speed));
  report.chapters.push_back(
      {"Growth",
       {key_figures(d), Text{verdict(d)}, growth_figure(d), growth_table(d),
        Text{"Depth: root mean square in one-third octave bands. Growth: of its logarithm, in a million real "
             "passages, "
             "by the profiles before and after and by the work of a passage; per millimetre of even wear. "
             "Past "
             "trough: where the work is largest as the wheel rolls. Profiles also fade at the ends of the "
             "stretch. "
             "* too little of these waves in profile or work, or of the work explained by them, to tell."}}});
  Chapter profile{"Profile", {profile_figure(d), spectrum_figure(d), passage_table(d)}};
  if (d.rows) profile.blocks.insert(profile.blocks.begin() + 1, rows_map(d));
  report.chapters.push_back(std::move(profile));
  Chapter work{"Frictional work", {work_figure(d, 0)}};
  if (d.passages.size() > 1) work.blocks.emplace_back(work_figure(d, d.passages.size() - 1));
  report.chapters.push_back(std::move(work));
  report.chapters.push_back({"What the model leaves out", {Text{left_out(d)}}});
  state_provenance(report, resolved.name, provenance);
  return report;
}

}  // namespace tread
