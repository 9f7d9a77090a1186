#include "drivers/studies/develop/development_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/studies/develop/passage_room.hpp"
#include "drivers/studies/study/finished_run.hpp"
#include "drivers/studies/study/study_runner.hpp"
#include "io/files/absolute_path.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/history_reader.hpp"
#include "io/files/output_file.hpp"
#include "io/scene/schema.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSmoothScene = "smooth.toml";
constexpr const char* kPassageScene = "passage.toml";
constexpr const char* kStart = "from.txt";  ///< run with whose state all passages begin

/// Makes the directory and returns its absolute path. Passages are processes that receive paths of files in
/// it.
fs::path made(const fs::path& directory) {
  make_directory(directory);
  return absolute_path(directory);
}

/// The scene without what each passage states for itself.
std::string smooth_scene(const ResolvedScene& resolved) {
  ResolvedScene smooth = resolved;
  std::erase_if(smooth.entries, [](const Entry& entry) {
    return find_key(entry.path)->effects.any_of({Effect::surface, Effect::wear, Effect::forks, Effect::room});
  });
  return resolved_toml(smooth);
}

std::string fork_table(const Scene& scene) {
  const bool stated = scene.forks && scene.forks->at;
  return "\n[forks]\n" + (stated ? fmt::format("at = \"{} s\"\n", *scene.forks->at) : "");
}

void require_same(const fs::path& folder, const ResolvedScene& resolved) {
  if (!fs::exists(folder / kKeptScene)) return;
  const std::string other =
      difference(scene_content(resolved), kept_scene(folder, resolved.source.files).content);
  if (!other.empty())
    throw InputError(
        fmt::format("{} holds the development of another scene: {}; choose another folder with -o",
                    folder.string(), other));
}

/// Run with whose state all passages begin: as stated or, if the development has `begun`, as kept at its
/// beginning.
std::string start_of(const fs::path& folder, const std::string& stated, bool begun) {
  constexpr std::size_t kLongest = 1 << 16;  // [B]
  std::string wanted = stated.empty() ? "" : absolute_path(stated).string();
  if (!begun) return wanted;
  std::string kept = fs::exists(folder / kStart) ? read_text_file(folder / kStart, kLongest) : "";
  if (stated.empty() || wanted == kept) return kept;
  throw InputError(
      fmt::format("--from {}: the development in {} began with {}; leave --from out, or choose "
                  "another folder with -o",
                  stated, folder.string(), kept.empty() ? "a passage of its own" : kept));
}

std::string work_csv(const PassageWork& work) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "x [m],length [m],frictional_work [J/m2]\n");
  for (std::size_t i = 0; i < work.x.size(); ++i)
    fmt::format_to(out, "{},{},{}\n", work.x[i], work.length[i], work.work[i]);
  return {text.data(), text.size()};
}

std::string profile_table(const WornProfile& profile) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# x [m]  d [m]\n");
  for (std::size_t i = 0; i < profile.depth.size(); ++i)
    fmt::format_to(out, "{} {}\n", static_cast<double>(i) * profile.spacing, profile.depth[i]);
  return {text.data(), text.size()};
}

/// Depths of all rows, y from `centre` [m].
std::string map_table(const WornProfile& profile, const WornRows& rows, double centre) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# x [m]  y [m]  d [m]\n");
  for (std::size_t j = 0; j < rows.y.size(); ++j)
    for (std::size_t i = 0; i < profile.depth.size(); ++i)
      fmt::format_to(out, "{} {} {}\n", static_cast<double>(i) * profile.spacing, rows.y[j] - centre,
                     rows.depth[j][i]);
  return {text.data(), text.size()};
}

PassageWork read_work(const fs::path& csv) {
  auto columns = read_history(csv, {{"x", "m"}, {"length", "m"}, {"frictional_work", "J/m2"}});
  return {std::move(columns[0]), std::move(columns[1]), std::move(columns[2])};
}

void write_rows(const fs::path& path, const std::vector<WorkRow>& rows) {
  std::vector<double> y, width, work;
  for (const WorkRow& row : rows) {
    y.push_back(row.y);
    width.push_back(row.width);
    work.insert(work.end(), row.work.begin(), row.work.end());
  }
  replace_file(path, [&](const fs::path& part) {
    Hdf5File file = Hdf5File::create(part);
    const auto stations = static_cast<std::uint64_t>(rows.empty() ? 0 : rows.front().work.size());
    file.write<double>("y", y);
    file.write<double>("width", width);
    file.write<double>("frictional_work", work, {rows.size(), stations});
    for (const auto& [name, unit] : {std::pair{"y", "m"}, std::pair{"width", "m"}})
      file.write_attribute(name, "unit", std::string(unit));
    file.write_attribute("frictional_work", "unit", std::string("J/m2"));
    file.close();
  });
}

std::vector<WorkRow> read_rows(const fs::path& path) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  const auto y = file.read<double>("y");
  const auto width = file.read<double>("width");
  const auto work = file.read<double>("frictional_work");
  const std::size_t stations = y.empty() ? 0 : work.size() / y.size();
  std::vector<WorkRow> rows;
  for (std::size_t j = 0; j < y.size(); ++j) {
    const auto begin = work.begin() + static_cast<std::ptrdiff_t>(j * stations);
    rows.push_back({y[j], width[j], 0, {begin, begin + static_cast<std::ptrdiff_t>(stations)}});
  }
  return rows;
}

/// Throws InputError where the corrugation of the passage in `folder` is deeper than `room`, for which
/// passage 0 has searched the surface [m]. `resolved`: scene of the development.
void require_room(const fs::path& folder, const Scene& passage, double room, const ResolvedScene& resolved,
                  int passages) {
  const double deepest = corrugation_depth(passage);
  if (deepest <= room) return;
  const std::string still_short = short_room(resolved.scene, room_of_passage0(resolved, passages), passages);
  const std::string way_out = still_short.empty()
                                  ? fmt::format(", where passage 0 leaves room for all {} passages", passages)
                                  : " and another scene: " + still_short;
  throw InputError(
      fmt::format("the corrugation of {} is {:.4g} mm deep, but passage 0 has room for {:.4g} mm; begin in "
                  "another folder with -o{}",
                  folder.string(), 1e3 * deepest, 1e3 * room, way_out));
}

Error failure(const fs::path& folder, const PointStatus& status) {
  if (status.foreign)
    return InputError(
        fmt::format("{} holds another run than this passage (here: the passage, there: the "
                    "folder): {}; remove that folder, and this passage begins anew while the others stay; or "
                    "choose another folder with -o",
                    folder.string(), status.why));
  if (status.state == PointState::failed)
    return Error(status.code, fmt::format("the passage in {} failed: {}", folder.string(), status.why));
  return Interrupted(
      fmt::format("the passage in {} is not done ({}{}); nothing is lost: the same command goes on",
                  folder.string(), name_of(status.state), status.why.empty() ? "" : ", " + status.why));
}

}  // namespace

DevelopmentFolder::DevelopmentFolder(const fs::path& path, const ResolvedScene& resolved, Options options)
    : folder_(made(path)), resolved_(resolved), options_(std::move(options)) {
  require_same(folder_.path(), resolved);
  for (const char* name : {"work", "profiles"}) create_folder(folder_ / name);
  keep_scene(folder_.path(), resolved);
  const bool begun = fs::exists(work_path(0)) || fs::exists(run_path(0) / kCheckpointFolder);
  options_.from = start_of(folder_.path(), options_.from, begun);
  if (!options_.from.empty())
    write_text_file(folder_ / kStart, options_.from);
  else
    fs::remove(folder_ / kStart);  // of a call that began nothing
  const std::string smooth = smooth_scene(resolved);
  write_text_file(folder_ / kSmoothScene,
                  smooth + (options_.from.empty() ? fork_table(resolved_.scene) : ""));
  write_text_file(folder_ / kPassageScene, smooth);
}

fs::path DevelopmentFolder::profile_path(int number) const {
  return folder_.path() / "profiles" / fmt::format("{:04}.txt", number);
}

fs::path DevelopmentFolder::work_path(int number) const {
  return folder_.path() / "work" / fmt::format("{:04}.csv", number);
}

fs::path DevelopmentFolder::rows_path(int number) const {
  return folder_.path() / "work" / fmt::format("{:04}.h5", number);
}

fs::path DevelopmentFolder::run_path(int number) const {
  return folder_.path() / fmt::format("passage-{:04}", number);
}

std::vector<std::string> DevelopmentFolder::overrides(int number, const Development* before) const {
  std::vector<std::string> list = {"output.frames=0"};
  if (number == 0) {
    // Passage 0 leaves room for waves that grow. All other passages take over that room, or the room of the
    // run with whose state they begin.
    if (options_.from.empty()) {
      const double room = options_.room ? *options_.room : room_of_passage0(resolved_, options_.passages);
      list.push_back(fmt::format("contact.depth_room={} m", room));
    }
    return list;
  }
  const CorrugationSpec& spec = *resolved_.scene.corrugation;
  const Corrugation start = corrugation_of(spec, 0);
  list.insert(list.end(), {"corrugation.apply=gap", "corrugation.file=" + profile_path(number - 1).string(),
                           fmt::format("corrugation.start={} m", start.first())});
  if (before->rows) {
    list.insert(list.end(),
                {"corrugation.kind=map", fmt::format("corrugation.centre={} m", before->centre(spec))});
    return list;
  }
  list.insert(list.end(), {"corrugation.kind=table", fmt::format("corrugation.width={} m", spec.width)});
  if (spec.centre) list.push_back(fmt::format("corrugation.centre={} m", *spec.centre));
  return list;
}

void DevelopmentFolder::roll(int number, const Development* before, Progress& progress) const {
  StudyPlan plan;
  plan.folder = folder_.path();
  plan.study.scene = folder_ / (number == 0 ? kSmoothScene : kPassageScene);
  plan.threads = options_.threads;
  plan.device = options_.device;
  plan.launcher = options_.launcher;
  PlannedPoint point;
  point.name = run_path(number).filename().string();
  point.overrides = overrides(number, before);
  point.resolved = resolve_scene(plan.study.scene, point.overrides);
  point.content = scene_content(point.resolved);
  point.folder = run_path(number);
  point.from = number > 0 && options_.from.empty() ? run_path(0).string() : options_.from;
  point.status = look_into(point.folder, point.content, point.resolved.source.files);
  if (point.status.foreign) throw failure(point.folder, point.status);
  if (number > 0 && options_.from.empty())
    require_room(point.folder, point.resolved.scene,
                 depth_room(kept_scene(run_path(0), resolved_.source.files).resolved.scene), resolved_,
                 options_.passages);
  plan.points.push_back(std::move(point));
  const StudyLabel label{"develop", options_.command, number, options_.passages - number};
  const std::string stopped_by = StudyRunner(plan, folder_, progress, label).run(true);
  if (!stopped_by.empty())
    throw Interrupted(fmt::format("stopped by {} in passage {}; nothing is lost: the same command goes on",
                                  stopped_by, number));
  const PlannedPoint& ended = plan.points.front();
  if (ended.status.state != PointState::done) throw failure(ended.folder, ended.status);
}

void DevelopmentFolder::say_warnings(int number, const Progress& progress) const {
  const auto warnings = [&](int passage) {
    const fs::path summary = run_path(passage) / "summary.json";
    if (!fs::exists(summary)) return std::vector<std::string>();
    return warnings_in(read_finished_run(run_path(passage), resolved_.scene, "").summary);
  };
  const std::vector<std::string> known = number > 0 ? warnings(number - 1) : std::vector<std::string>();
  for (const std::string& warning : warnings(number))
    if (std::find(known.begin(), known.end(), warning) == known.end())
      progress.say(fmt::format("[develop] passage {}: {}", number, warning));
}

void DevelopmentFolder::keep_profile(int number, const Development& development) const {
  const WornProfile& profile = development.profile;
  write_text_file(profile_path(number), development.rows
                                            ? map_table(profile, *development.rows,
                                                        development.centre(*resolved_.scene.corrugation))
                                            : profile_table(profile));
}

SurfaceWork DevelopmentFolder::pass(int number, const Development* before, Progress& progress) const {
  if (before) keep_profile(number - 1, *before);
  const bool by_row = resolved_.scene.wear->across;
  if (!fs::exists(work_path(number))) {
    roll(number, before, progress);
    say_warnings(number, progress);
    const Corrugation stretch = corrugation_of(*resolved_.scene.corrugation, 0);
    const SurfaceWork work = work_of_run(run_path(number) / "surface.h5", stretch.first(), stretch.last());
    if (by_row) write_rows(rows_path(number), work.rows);
    write_text_file(work_path(number), work_csv(work.mean));
  }
  std::error_code ignored;
  if (number > 1) fs::remove_all(run_path(number - 1), ignored);
  SurfaceWork work{read_work(work_path(number)), {}};
  if (by_row) {
    work.rows = read_rows(rows_path(number));
    work.average();
  }
  return work;
}

SurfaceWork work_of_run(const fs::path& surface, double first, double last) {
  const Hdf5File file = Hdf5File::open_to_read(surface);
  const auto x = file.read<double>("/x");
  const auto length = file.read<double>("/length");
  const auto y = file.read<double>("/y");
  const auto width = file.read<double>("/width");
  const auto work = file.read<double>("/frictional_work");
  if (x.empty() || x.front() > first || x.back() < last)
    throw InputError(
        fmt::format("{}: the wheel has not passed x = {:.4g} m to {:.4g} m; motion.duration must "
                    "be longer",
                    surface.string(), first, last));
  const std::size_t rows = width.size();
  SurfaceWork result;
  for (std::size_t row = 0; row < rows; ++row) result.rows.push_back({y[row], width[row], 0, {}});
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < first || x[i] > last) continue;
    result.mean.x.push_back(x[i]);
    result.mean.length.push_back(length[i]);
    for (std::size_t row = 0; row < rows; ++row) result.rows[row].work.push_back(work[i * rows + row]);
  }
  result.average();
  return result;
}

}  // namespace tread
