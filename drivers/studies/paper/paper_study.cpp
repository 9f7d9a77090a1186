#include "drivers/studies/paper/paper_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "drivers/studies/paper/drawn_figure.hpp"
#include "drivers/studies/paper/paper_figures.hpp"
#include "drivers/studies/paper/paper_numbers.hpp"
#include "drivers/studies/paper/paper_verdicts.hpp"
#include "drivers/studies/study/study_report.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

namespace {

/// Returns true if the user's name stands for the figure: "8" and "08" are Fig. 8, "17" is Figs. 17a and 17b.
bool answers(const PaperFigure& figure, const std::string& id, bool parts) {
  const std::string shown = shown_id(figure.id);
  return parts ? std::to_string(std::atoi(shown.c_str())) == shown_id(id) : shown == shown_id(id);
}

std::vector<PaperFigure> chosen_figures(const std::vector<std::string>& ids) {
  if (ids.empty()) return paper_figures();
  std::vector<PaperFigure> chosen;
  for (const std::string& id : ids) {
    const std::size_t before = chosen.size();
    for (const bool parts : {false, true}) {
      if (chosen.size() > before) break;
      std::copy_if(paper_figures().begin(), paper_figures().end(), std::back_inserter(chosen),
                   [&](const PaperFigure& figure) { return answers(figure, id, parts); });
    }
    if (chosen.size() > before) continue;
    std::vector<std::string> known;
    for (const PaperFigure& figure : paper_figures()) known.push_back(shown_id(figure.id));
    throw InputError(fmt::format("--fig {}: not among the figures {}", id, fmt::join(known, ", ")));
  }
  return chosen;
}

/// Every passage of the figures once.
std::map<std::string, Passage> passages_of(const std::vector<PaperFigure>& figures, Study& study) {
  std::map<std::string, Passage> passages;
  for (const PaperFigure& figure : figures)
    for (const Passage& passage : figure.passages)
      if (passages.try_emplace(name_of(passage), passage).second)
        study.points.push_back(study_point(passage));
  return passages;
}

void print_figures(const std::vector<PaperFigure>& figures) {
  Table table{"", {{"Figure"}, {"What"}, {"Passages", Align::right}}, {}};
  for (const PaperFigure& figure : figures)
    table.rows.push_back({shown_id(figure.id), figure.title, std::to_string(figure.passages.size())});
  fmt::print("{}\n", plain_text(table));
}

Text missing_passages(const PaperFigure& figure, const PassageRuns& runs) {
  std::string names;
  for (const Passage& passage : figure.passages)
    if (!runs.find(passage)) names += (names.empty() ? "" : "; ") + name_of(passage);
  return {names.empty() ? "All its passages have been run." : "Not run: " + names + "."};
}

Report paper_report(const std::vector<PaperFigure>& figures, const PassageRuns& runs, const StudyPlan& plan,
                    const std::vector<FinishedRun>& finished, const Provenance& provenance) {
  Report report;
  report.title = "The paper's figures";
  report.subtitle = fmt::format("{} of {} passages done", finished.size(), plan.points.size());
  report.chapters.push_back({"Conclusions", {verdict_table(runs)}});
  report.chapters.push_back({"Numbers", {number_table(runs)}});
  for (const PaperFigure& figure : figures) {
    Chapter chapter{fmt::format("Fig. {}", shown_id(figure.id)), {}};
    chapter.blocks.push_back(draw(figure, runs).block);
    if (!figure.passages.empty()) chapter.blocks.emplace_back(missing_passages(figure, runs));
    report.chapters.push_back(std::move(chapter));
  }
  report.chapters.push_back({"Passages", {result_table(finished)}});
  state_provenance(report, plan.study.scene.string(), provenance);
  return report;
}

}  // namespace

std::optional<Error> reproduce_paper(const PaperOptions& options) {
  const StudyOptions& common = options.common;
  const std::vector<PaperFigure> figures = chosen_figures(options.figures);
  Study study;
  study.name = "tread paper";
  study.title = "The paper's figures";
  study.scene = common.output / "scene.toml";
  study.scene_text = paper_scene();
  const std::map<std::string, Passage> passages = passages_of(figures, study);
  add_overrides(study, common);
  if (common.list && !common.json) print_figures(figures);
  return run_study(study, common, [&](const StudyPlan& plan) {
    const std::vector<FinishedRun> finished = finished_runs(plan);
    PassageRuns runs;
    for (const FinishedRun& run : finished) runs.add(passages.at(run.label), run);
    for (const PaperFigure& figure : figures) {
      const DrawnFigure drawn = draw(figure, runs);
      if (drawn.csv.empty()) continue;
      write_text_file(plan.folder / fmt::format("fig{}.csv", figure.id), drawn.csv);
      write_text_file(plan.folder / fmt::format("fig{}.svg", figure.id), drawn.svg);
    }
    write_text_file(plan.folder / "numbers.csv", number_csv(runs));
    write_text_file(plan.folder / "results.md",
                    markdown(number_table(runs)) + "\n" + markdown(verdict_table(runs)));
    write_text_file(plan.folder / "sweep.csv", sweep_csv(plan, finished));
    replace_report(plan.folder / "report.html", paper_report(figures, runs, plan, finished, common.origin));
    if (common.json)
      fmt::print("{}", sweep_json(plan, finished));
    else
      fmt::print("{}\n{}", plain_text(number_table(runs)), plain_text(short_verdict_table(runs)));
  });
}

}  // namespace tread
