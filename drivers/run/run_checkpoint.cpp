#include "drivers/run/run_checkpoint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/process/version.hpp"
#include "drivers/run/program_hash.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

/// Where steps are taken, as far as it shows in their bits: ranks with devices solve the contact elsewhere
/// than one process with a device.
std::string stepping_device() {
  return device_name() + (chosen_ranks() && chosen_device() ? ", of several ranks" : "");
}

/// `--device` of such steps: cards have their own names.
std::string_view option_of(std::string_view device) {
  for (const std::string_view name : {"cpu", "emulated"})
    if (device.starts_with(name)) return name;
  return "gpu";
}

void pack_texts(const std::string& group, const std::vector<std::string>& texts, SealedContent& content) {
  content[group + "/count"] = std::vector<std::int64_t>{static_cast<std::int64_t>(texts.size())};
  for (std::size_t i = 0; i < texts.size(); ++i) content[fmt::format("{}/{}", group, i)] = texts[i];
}

std::vector<std::string> unpack_texts(const SealedContent& content, const std::string& group) {
  std::vector<std::string> texts;
  const std::int64_t count = sealed_value<std::int64_t>(content, group + "/count");
  for (std::int64_t i = 0; i < count; ++i)
    texts.push_back(sealed_entry<std::string>(content, fmt::format("{}/{}", group, i)));
  return texts;
}

/// Numbers in which two meshes agree if they agree in every node, but for the last digits of another machine.
std::vector<double> fingerprint(const Model& model) {
  double sum = 0;
  double moment = 0;
  for (std::size_t i = 0; i < model.mass.size(); ++i) {
    sum += model.mass[i];
    moment += model.mass[i] * static_cast<double>(i);
  }
  return {static_cast<double>(model.mesh.slots), static_cast<double>(model.restrained.size()), sum, moment};
}

void check_mesh(const SealedContent& content, const Model& model) {
  const auto& stored = sealed_entry<std::vector<double>>(content, "made/mesh");
  const std::vector<double> found = fingerprint(model);
  constexpr double kRounding = 1e-9;
  const bool same = std::equal(stored.begin(), stored.end(), found.begin(), found.end(),
                               [](double a, double b) { return std::abs(a - b) <= kRounding * std::abs(b); });
  if (!same)
    throw InputError(
        "it was made on another mesh than this program makes of the scene; go on with the program that wrote "
        "it");
}

const std::string kSamples = "samples";
const std::string kMeasured = "measured";
const std::string kFormat = "made/format";
const std::string kVersion = "made/version";
const std::string kMadeCommit = "made/commit";    ///< program_commit()
const std::string kMadeProgram = "made/program";  ///< program_hash()
constexpr const char* kSteps = "state/steps";

std::string commit_text(const std::string& commit) {
  return commit.empty() ? "unknown" : commit;
}

/// First line of a resolved scene that another lacks.
std::string line_missing_in(const std::string& other, const std::string& scene) {
  std::istringstream lines(scene);
  for (std::string line; std::getline(lines, line);)
    if (("\n" + other).find("\n" + line + "\n") == std::string::npos) return line;
  return "";
}

/// Contents of the files that a scene names, by entry.
SealedContent files_of_order(const SealedContent& content) {
  SealedContent files;
  for (const auto& entry : content)
    if (entry.first.starts_with("order/file_")) files.insert(entry);
  return files;
}

/// InputError where the content has another format than kCheckpointFormat, or states none.
void require_format(const SealedContent& content) {
  const bool stated = content.contains(kFormat);
  const std::int64_t format = stated ? sealed_value<std::int64_t>(content, kFormat) : 0;
  const bool named = content.contains(kVersion);
  if (stated && named && format == kCheckpointFormat) {
    sealed_entry<std::string>(content, kVersion);
    return;
  }
  const std::string writer = named ? sealed_entry<std::string>(content, kVersion) : "of an unknown version";
  throw InputError(fmt::format(
      "the checkpoint has {}, and tread {} wrote it; this is tread {}, which reads format {}; go on with the "
      "program that wrote it, or start the run anew with `tread run ... --overwrite`",
      stated ? fmt::format("format {}", format) : "no format number", writer, program_version(),
      kCheckpointFormat));
}

}  // namespace

SealedContent pack_order(const RunOrder& order) {
  SealedContent content;
  content[kFormat] = std::vector<std::int64_t>{kCheckpointFormat};
  content[kVersion] = std::string(program_version());
  content["order/scene/name"] = order.scene.name;
  content["order/scene/text"] = order.scene.text;
  content["order/scene/folder"] = (std::filesystem::current_path() / order.scene.folder).string();
  std::vector<std::string> names, texts;
  for (const auto& [name, text] : order.scene.files) {
    names.push_back(name);
    texts.push_back(*text);
  }
  pack_texts("order/file_names", names, content);
  pack_texts("order/file_texts", texts, content);
  pack_texts("order/overrides", order.overrides, content);
  pack_texts("order/later", order.later, content);
  content["order/resolved"] = order.resolved;
  content["order/command"] = order.command;
  if (order.origin) {
    content["order/origin/folder"] = order.origin->folder;
    content["order/origin/time"] = std::vector<double>{order.origin->time};
    content["order/origin/steps"] = std::vector<std::int64_t>{order.origin->steps};
  }
  return content;
}

RunOrder unpack_order(const SealedContent& content) {
  require_format(content);
  const auto text = [&](const char* name) { return sealed_entry<std::string>(content, name); };
  RunOrder order;
  order.scene.name = text("order/scene/name");
  order.scene.text = text("order/scene/text");
  order.scene.folder = text("order/scene/folder");
  const std::vector<std::string> names = unpack_texts(content, "order/file_names");
  const std::vector<std::string> texts = unpack_texts(content, "order/file_texts");
  for (std::size_t i = 0; i < std::min(names.size(), texts.size()); ++i)
    order.scene.files[names[i]] = std::make_shared<const std::string>(texts[i]);
  order.overrides = unpack_texts(content, "order/overrides");
  order.later = unpack_texts(content, "order/later");
  order.resolved = text("order/resolved");
  order.command = text("order/command");
  if (content.contains("order/origin/folder"))
    order.origin = {text("order/origin/folder"), sealed_value<double>(content, "order/origin/time"),
                    sealed_value<std::int64_t>(content, "order/origin/steps")};
  return order;
}

ResolvedScene resolve_order(const RunOrder& order, const std::filesystem::path& folder) {
  ResolvedScene resolved = resolve_scene(order.scene, order.overrides);
  if (resolved_toml(resolved) != order.resolved)
    throw InputError(
        fmt::format("{}: this program reads other values from the scene than the one that began "
                    "the run; go on with that one",
                    folder.string()));
  return resolved;
}

void pack(const StateList& list, const std::string& group, SealedContent& content) {
  for (const StateList::Field& field : list.fields())
    std::visit(
        [&](auto values) { content[group + "/" + field.name] = std::vector(values.begin(), values.end()); },
        field.values);
}

void unpack(const SealedContent& content, const std::string& group, const StateList& list) {
  for (const StateList::Field& field : list.fields()) {
    const std::string name = group + "/" + field.name;
    std::visit(
        [&](auto values) {
          using Value = typename decltype(values)::value_type;
          const auto& stored = sealed_entry<std::vector<Value>>(content, name);
          if (stored.size() != values.size())
            throw InputError(
                fmt::format("'{}' has {} values, this scene needs {}", name, stored.size(), values.size()));
          for (std::size_t i = 0; i < values.size(); ++i)  // zeros that nobody writes take no memory
            if (std::memcmp(&values[i], &stored[i], sizeof(Value)) != 0) values[i] = stored[i];
        },
        field.values);
  }
  const auto known = static_cast<std::ptrdiff_t>(list.fields().size());
  const auto stored = std::count_if(content.begin(), content.end(),
                                    [&](const auto& entry) { return entry.first.starts_with(group + "/"); });
  if (stored != known)
    throw InputError(fmt::format("'{}' has {} fields, this program knows {}", group, stored, known));
}

SealedContent pack_run(const RunOrder& order, RunResults& results, Model& model, Simulation& simulation,
                       std::string patch) {
  SealedContent content = pack_order(order);
  content["made/instruction_set"] = std::string(model.internal->instruction_set());
  content[kMadeCommit] = program_commit();
  content[kMadeProgram] = std::vector{static_cast<std::int64_t>(program_hash())};
  content["made/device"] = stepping_device();
  content["made/lanes"] = std::vector<std::int64_t>{kLanes};
  content["made/mesh"] = fingerprint(model);
  content["made/state_hash"] = std::vector{static_cast<std::int64_t>(simulation.state_hash())};
  StateList list;
  results.list_state(list);
  pack(list, "results", content);
  content["step/reason"] = results.limit.reason;
  StateList samples;
  samples.add_records(kSamples, std::span(results.samples));
  pack(samples, "histories", content);
  pack_measured(results.measured.kept(), content);
  pack(simulation.state(), "state", content);
  if (!patch.empty()) content["patch.h5"] = std::move(patch);
  return content;
}

void unpack_results(const SealedContent& content, RunResults& results) {
  StateList list;
  results.list_state(list);
  unpack(content, "results", list);
  results.limit.reason = sealed_entry<std::string>(content, "step/reason");
  constexpr std::size_t kValues = sizeof(Sample) / sizeof(double);
  results.samples.resize(sealed_entry<std::vector<double>>(content, "histories/" + kSamples).size() /
                         kValues);
  StateList samples;
  samples.add_records(kSamples, std::span(results.samples));
  unpack(content, "histories", samples);
}

void pack_measured(MeasuredRows::Kept measured, SealedContent& content) {
  pack_texts(kMeasured + "/names", measured.names, content);
  content[kMeasured + "/values"] = std::move(measured.values);
}

MeasuredRows::Kept unpack_measured(const SealedContent& content) {
  return {unpack_texts(content, kMeasured + "/names"),
          sealed_entry<std::vector<double>>(content, kMeasured + "/values")};
}

void require_same_mesh(const SealedContent& content, const Model& model) {
  const std::int64_t lanes = sealed_value<std::int64_t>(content, "made/lanes");
  if (lanes != kLanes)
    throw InputError(
        fmt::format("it was made with {} lanes, this program has {}; go on with the program that "
                    "wrote it",
                    lanes, kLanes));
  check_mesh(content, model);
}

void unpack_state(const SealedContent& content, const Model& model, Simulation& simulation) {
  require_same_mesh(content, model);
  unpack(content, "state", simulation.state());
  const auto hash = static_cast<std::uint64_t>(sealed_value<std::int64_t>(content, "made/state_hash"));
  if (hash != simulation.state_hash()) throw InputError("its state hash differs");
}

void leave_to_spread(Simulation& simulation, SealedContent& content) {
  const StateList unshared = simulation.unshared_state();
  for (const StateList::Field& field : unshared.fields()) content.erase("state/" + field.name);
}

void unpack_followed(const SealedContent& content, const Model& model, Simulation& simulation) {
  check_mesh(content, model);
  unpack(content, "state", simulation.state().without(simulation.unshared_state()));
}

void require_state(const CheckpointFolder::Found& found) {
  const SealedContent& content = found.content;
  if (!content.contains(kFormat) || sealed_value<std::int64_t>(content, kFormat) != kCheckpointFormat) return;
  for (const char* name : {"results/dt", "made/state_hash", kSteps})
    if (!content.contains(name))
      throw InputError(fmt::format("it holds no state of a run: '{}' is missing", name));
  const std::int64_t steps = sealed_value<std::int64_t>(content, kSteps);
  if (steps != found.steps)
    throw InputError(fmt::format("it holds the state of step {}, not that of its name", steps));
}

void require_same_order(const SealedContent& state, const SealedContent& order) {
  for (const SealedContent* content : {&state, &order})
    if (!content->contains(kFormat) || sealed_value<std::int64_t>(*content, kFormat) != kCheckpointFormat)
      return;
  const auto& stated = sealed_entry<std::string>(order, "order/resolved");
  const auto& found = sealed_entry<std::string>(state, "order/resolved");
  if (found != stated)
    throw InputError(
        fmt::format("it is the state of another run than order.h5 beside it: its scene has '{}', that of the "
                    "order '{}'; remove the file that is not of this run",
                    line_missing_in(stated, found), line_missing_in(found, stated)));
  if (files_of_order(state) != files_of_order(order))
    throw InputError(
        "it is the state of another run than order.h5 beside it: files that the scene names have another "
        "content; remove the file that is not of this run");
}

std::string other_origin(const SealedContent& content, const Model& model) {
  const std::string& version = sealed_entry<std::string>(content, kVersion);
  const std::string& set = sealed_entry<std::string>(content, "made/instruction_set");
  if (version != program_version())
    return fmt::format("version {} wrote it, this is {}", version, program_version());
  if (content.contains(kMadeProgram) &&
      sealed_value<std::int64_t>(content, kMadeProgram) != static_cast<std::int64_t>(program_hash()))
    return fmt::format("another build of the program wrote it, of commit {}, and this is one of {}",
                       commit_text(sealed_entry<std::string>(content, kMadeCommit)),
                       commit_text(program_commit()));
  if (set != model.internal->instruction_set())
    return fmt::format("it was written with {}, this machine computes with {}", set,
                       model.internal->instruction_set());
  const std::string device =
      content.contains("made/device") ? sealed_entry<std::string>(content, "made/device") : "cpu";
  if (device != stepping_device())
    return fmt::format(
        "it was written by steps on the device {} (--device {} goes on there), this run takes them on {}",
        device, option_of(device), stepping_device());
  return "";
}

}  // namespace tread
