#include "drivers/run/result_listing.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "drivers/run/fork.hpp"
#include "drivers/run/run_folder.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/files/step_files.hpp"
#include "io/report/figure_files.hpp"
#include "io/text/json.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// Files by name or ending, with their content. [docs/reference/results.md]
constexpr std::array<std::pair<std::string_view, std::string_view>, 27> kContents = {{
    {"scene.resolved.toml", "every value of the scene with its source"},
    {"scene.files.json", "checksums of the files that the scene names"},
    {"status.json", "stage of the run"},
    {"histories.csv", "forces, creepage, energies by sample"},
    {"run.h5", "forces, creepage, energies by sample"},
    {"patch.h5", "contact patch by sample"},
    {"surface.h5", "effects of the passage on the rail"},
    {"surface_axis.csv", "effects of the passage on the patch's axis"},
    {"deflection.csv", "rail surface about the wheel"},
    {"frames.hdf.series", "frames for ParaView: open this file"},
    {"summary.json", "numbers of the run"},
    {"report.html", "report, complete in one file"},
    {"mesh.hdf", "mesh for ParaView"},
    {"sweep.csv", "a row a point"},
    {"dial.csv", "cost and error by point"},
    {"dial.jsonl", "cost and error by point, an object a line"},
    {"effects.csv", "cost and error by setting"},
    {"numbers.csv", "the paper's numbers and ours"},
    {"growth.csv", "growth by wavelength"},
    {"development.json", "growth and verdict"},
    {"compare.json", "differences between a run and a curve"},
    {"compare.html", "report of the comparison"},
    {"multibody.csv", "multi-body forces and deflections"},
    {"calibration.csv", "fit of the contact spring"},
    {"map.csv", "response over speed and wavelength"},
    {"log.txt", "progress of the run"},
    {"results.md", "tables of the study"},
}};

std::string content_of_name(const std::string& name) {
  for (const auto& [known, content] : kContents)
    if (name == known) return std::string(content);
  return "";
}

std::string text_of(const Hdf5Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  const std::string* text = found == attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text ? *text : "";
}

/// Own datasets of an HDF5 file; the attributes of its root go to `attributes` if that has none yet.
std::vector<ResultItem> datasets_of(const fs::path& path, Hdf5Attributes& attributes) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  std::vector<ResultItem> items;
  for (const std::string& name : file.datasets()) {
    const Hdf5Attributes of_set = file.attributes(name);
    items.push_back(
        {name, file.shape(name), file.type(name), text_of(of_set, "unit"), text_of(of_set, "description")});
  }
  if (attributes.empty()) attributes = file.attributes("/");
  return items;
}

/// Columns of a table whose header holds `name [unit]`.
std::vector<ResultItem> columns_of(const fs::path& path) {
  std::ifstream file(path);
  std::string header;
  if (!std::getline(file, header))
    throw InputError(fmt::format("cannot read {}: it is empty", path.string()));
  std::uint64_t rows = 0;
  for (std::string line; std::getline(file, line);) ++rows;
  std::vector<ResultItem> items;
  for (const std::string& head : csv_cells(header)) {
    const std::size_t bracket = head.find(" [");
    const bool stated = bracket != std::string::npos && head.ends_with(']');
    items.push_back({stated ? head.substr(0, bracket) : head,
                     {rows},
                     "text",
                     stated ? head.substr(bracket + 2, head.size() - bracket - 3) : "",
                     ""});
  }
  return items;
}

ResultFile look_at_file(const fs::path& path, Hdf5Attributes& attributes) {
  const std::string name = path.filename();
  std::error_code ignored;
  const auto bytes = static_cast<std::int64_t>(fs::file_size(path, ignored));
  ResultFile file{name, bytes, content_of_name(name), "", {}};
  const std::string ending = path.extension();
  try {
    if (ending == ".h5" || ending == ".hdf") file.items = datasets_of(path, attributes);
    if (ending == ".csv") file.items = columns_of(path);
  } catch (const Error& error) {
    file.problem = error.what();
  }
  return file;
}

/// Returns false for a file that is none of tread's.
bool is_result(const ResultFile& file) {
  return !file.content.empty() || !file.items.empty() || !file.problem.empty();
}

/// Frames of a run, with the datasets of the last one.
ResultFile look_at_frames(const fs::path& folder, Hdf5Attributes& attributes) {
  const std::vector<std::int64_t> steps = steps_in(folder, ".hdf");
  ResultFile file;
  if (!steps.empty()) file = look_at_file(step_file(folder, steps.back(), ".hdf"), attributes);
  file.name = folder.filename().string() + "/";
  file.bytes = folder_bytes(folder);
  file.content = fmt::format("{} frames, datasets of the last one", steps.size());
  return file;
}

ResultFile look_at_figures(const fs::path& folder) {
  return {folder.filename().string() + "/",
          folder_bytes(folder),
          fmt::format("figures of the report, .svg and .csv: {}", fmt::join(figures_in(folder), ", ")),
          "",
          {}};
}

ResultFile look_at_states(const fs::path& folder) {
  const std::size_t states = steps_in(folder, ".h5").size();
  return {folder.filename().string() + "/",
          folder_bytes(folder),
          fmt::format("{} states for `tread {}`", states,
                      folder.filename() == kForkFolder ? "run --from" : "resume"),
          "",
          {}};
}

/// Returns true if a process works on the folder. A file system without locks has no answer: false.
bool is_worked_on(const fs::path& folder) {
  try {
    return is_taken(folder);
  } catch (const ResourceError&) {
    return false;
  }
}

/// State of a folder in words.
struct FolderState {
  std::string text;
  bool complete = false;
};

/// Number of a study's points by state, "3 done, 1 failed"; `complete` becomes true if all are done.
std::string points_text(const JsonRecord& status, bool& complete) {
  std::string text;
  complete = true;
  for (const char* state : {"done", "failed", "interrupted", "running", "waiting"}) {
    const double count = number_in(status, state).value_or(0);
    if (count <= 0) continue;
    text += fmt::format("{}{:.0f} {}", text.empty() ? "" : ", ", count, state);
    complete = complete && std::string_view(state) == "done";
  }
  return text;
}

/// State that the last process on the folder left in status.json. `ended`: a run has left all its results
/// there, and was killed at the last if it has not said so.
FolderState stated_in(const JsonRecord& status, bool ended) {
  FolderState state{text_in(status, "stage")};
  const auto time = number_in(status, "time_s");
  const auto duration = number_in(status, "duration_s");
  if (time && duration && *duration > 0)
    state.text +=
        fmt::format(", {:.4g} of {:.4g} ms, {:.0f} %", 1e3 * *time, 1e3 * *duration, 100 * *time / *duration);
  if (state.text == "failed") state.text += ": " + text_in(status, "text");
  if (number_in(status, "done"))
    state.text += ": " + points_text(status, state.complete);
  else if (ended)
    state = {"done", true};
  return state;
}

/// Files of commands that leave no status: their results are there at once.
constexpr std::array<const char*, 3> kWithoutStatus = {"summary.json", "compare.json", "levels.csv"};

FolderState state_of(const fs::path& folder) {
  const bool ended =
      std::ranges::any_of(kWithoutStatus, [&](const char* name) { return fs::exists(folder / name); });
  const bool has_summary = fs::exists(folder / "summary.json");
  const bool resumable = CheckpointFolder(folder / kCheckpointFolder).holds_run();
  const bool worked_on = is_worked_on(folder);
  FolderState state{ended ? "done" : "no status.json", ended};
  if (fs::exists(folder / "status.json")) {
    try {
      state = stated_in(read_json(folder / "status.json"), has_summary && !resumable && !worked_on);
    } catch (const InputError& error) {
      state.text = error.what();
    }
  }
  if (worked_on) return {state.text + "; a process works on it"};
  if (resumable)
    return {fmt::format("not finished ({}); no process works on it, {} goes on", state.text,
                        resume_text(folder))};
  return state;
}

void add_folder(const fs::path& path, ResultListing& listing) {
  const std::string name = path.filename();
  if (name == "frames")
    listing.files.push_back(look_at_frames(path, listing.attributes));
  else if (name == kFigureFolder)
    listing.files.push_back(look_at_figures(path));
  else if (name == kCheckpointFolder || name == kForkFolder)
    listing.files.push_back(look_at_states(path));
  else if (fs::exists(path / "status.json") || fs::exists(path / "summary.json"))
    listing.runs.push_back({name, state_of(path).text});
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) entries.push_back(entry);
  if (error) throw InputError(fmt::format("cannot read {}: {}", folder.string(), error.message()));
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace

ResultListing look_at_results(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(
        fmt::format("there is no folder {}: give the one that `-o` of `tread run` or of a study "
                    "was given",
                    folder.string()));
  ResultListing listing;
  for (const fs::path& path : entries_of(folder)) {
    if (fs::is_directory(path))
      add_folder(path, listing);
    else if (ResultFile file = look_at_file(path, listing.attributes); is_result(file))
      listing.files.push_back(std::move(file));
  }
  if (listing.files.empty() && listing.runs.empty())
    throw InputError(
        fmt::format("{} holds no results: give the folder that `-o` of `tread run` or of a study "
                    "was given",
                    folder.string()));
  FolderState state = state_of(folder);
  listing.state = std::move(state.text);
  listing.complete = state.complete;
  return listing;
}

}  // namespace tread
