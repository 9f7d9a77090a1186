#include "drivers/run/preload_cache.hpp"

#include <fmt/core.h>
#include <gnu/libc-version.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/run/program_hash.hpp"
#include "drivers/run/run_checkpoint.hpp"
#include "drivers/run/scene_content.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOff = "off";
constexpr const char* kGroup = "preload";
constexpr const char* kSeconds = "solved/seconds";

using PreloadClock = std::chrono::steady_clock;

double time_since(PreloadClock::time_point start) {
  return std::chrono::duration<double>(PreloadClock::now() - start).count();
}

FoundPreload solved(const std::function<Preload()>& solve) {
  const PreloadClock::time_point start = PreloadClock::now();
  Preload preload = solve();
  return {std::move(preload), false, time_since(start)};
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

fs::path usual_folder() {
  const std::string xdg = environment("XDG_CACHE_HOME");
  if (fs::path(xdg).is_absolute()) return fs::path(xdg) / "tread";
  const std::string home = environment("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".cache/tread";
}

std::int64_t limit() {
  constexpr double kUsual = 4e9;  // [B]
  const std::string stated = environment("TREAD_CACHE_LIMIT");
  if (stated.empty()) return static_cast<std::int64_t>(kUsual);
  try {
    const double bytes = parse_quantity(stated, kData);
    if (bytes < 1)
      throw InputError(fmt::format(
          "\"{}\" is no size above 0; state one such as \"4 GB\"; TREAD_CACHE=off keeps nothing", stated));
    return static_cast<std::int64_t>(std::min(bytes, 1e18));
  } catch (const InputError& error) {
    throw InputError(fmt::format("TREAD_CACHE_LIMIT: {}", error.what()));
  }
}

StateList fields_of(Preload& preload) {
  StateList list;
  preload.list_state(list);
  list.add("displacement", std::span<double>(preload.displacement));
  list.add("rail_rise", std::span<double>(preload.rail_rise));
  if (preload.run_in) list.add_part("run_in", *preload.run_in);
  return list;
}

Preload unpack_preload(const SealedContent& content, const Model& model) {
  Preload preload;
  preload.displacement.resize(static_cast<std::size_t>(3 * model.mesh.slots));
  preload.rail_rise.resize(
      sealed_entry<std::vector<double>>(content, fmt::format("{}/rail_rise", kGroup)).size());
  const auto make_room = [&]<class Record>(const char* name, std::vector<Record>& records) {
    const auto& values =
        sealed_entry<std::vector<double>>(content, fmt::format("{}/run_in/{}", kGroup, name));
    records.resize(values.size() / (sizeof(Record) / sizeof(double)));
  };
  if (content.contains(fmt::format("{}/run_in/sections", kGroup))) {
    preload.run_in.emplace();
    make_room("sections", preload.run_in->sections);
    make_room("sleepers", preload.run_in->sleepers);
  }
  unpack(content, kGroup, fields_of(preload));
  return preload;
}

/// Everything that the preload's bits depend on: the program, the instruction set, and preload_content().
std::string preload_key(const ResolvedScene& resolved, const Model& model) {
  std::string key = fmt::format("program {:016x}\nlibrary {}\ninstruction set {}\n", program_hash(),
                                gnu_get_libc_version(), model.internal->instruction_set());
  for (const auto& [name, value] : preload_content(resolved)) key += fmt::format("{} = {}\n", name, value);
  return key;
}

/// The preload that the cache has under the key; nothing where it has none. Why an entry is of no use goes to
/// `say`.
std::optional<FoundPreload> recall_preload(const ContentCache& cache, const std::string& key, Model& model,
                                           const ProgressText& say) {
  std::string refused;
  const std::optional<SealedContent> content = cache.find(key, refused);
  try {
    if (!content && refused.empty()) return std::nullopt;
    if (!content) throw InputError(refused);
    FoundPreload found{unpack_preload(*content, model), true, sealed_value<double>(*content, kSeconds)};
    const Preload& preload = found.preload;
    if (model.contact) model.contact->find_static({preload.displacement.data(), nullptr, &preload.wheel});
    return found;
  } catch (const InputError& error) {
    say(fmt::format("{}; solved again", error.what()));
    return std::nullopt;
  }
}

/// Waits while another process solves the preload of that key, at most half an hour. After that the cache may
/// have it; what is returned keeps other processes waiting. Nothing where there are no locks.
std::optional<FileLock> claim_preload(const ContentCache& cache, const std::string& key,
                                      const ProgressText& say, const std::function<void()>& wait) {
  constexpr auto kLongest = std::chrono::minutes(30);
  constexpr auto kLook = std::chrono::milliseconds(100);
  const PreloadClock::time_point started = PreloadClock::now();
  bool told = false;
  try {
    while (PreloadClock::now() - started < kLongest) {
      if (std::optional<FileLock> claim = cache.claim(key)) return claim;
      if (!std::exchange(told, true)) say("another process solves it; waiting for that");
      wait();
      std::this_thread::sleep_for(kLook);
    }
    say("the other process has not solved it in half an hour; solved here");
  } catch (const ResourceError&) {
    // keep_preload() tells of a folder that cannot be written.
  }
  return std::nullopt;
}

/// Keeps the preload; why it cannot goes to `say`.
void keep_preload(const ContentCache& cache, const std::string& key, FoundPreload& found,
                  const ProgressText& say) {
  try {
    SealedContent content;
    pack(fields_of(found.preload), kGroup, content);
    content[kSeconds] = std::vector<double>{found.seconds};
    cache.store(key, std::move(content));
  } catch (const ResourceError& error) {
    say(fmt::format("not kept for later runs: {}; TREAD_CACHE or --cache names another folder, or off",
                    error.what()));
  }
}

}  // namespace

std::optional<ContentCache> preload_cache(const std::string& place) {
  const std::string stated = place.empty() ? environment("TREAD_CACHE") : place;
  if (stated == kOff) return std::nullopt;
  const fs::path folder = stated.empty() ? usual_folder() : fs::path(stated);
  if (folder.empty()) return std::nullopt;
  return ContentCache(folder, limit());
}

FoundPreload find_preload(const std::optional<ContentCache>& cache, const ResolvedScene& resolved,
                          Model& model, const std::function<Preload()>& solve, const ProgressText& say,
                          const std::function<void()>& wait) {
  if (!cache) return solved(solve);
  const PreloadClock::time_point started = PreloadClock::now();
  const std::string key = preload_key(resolved, model);
  const auto quietly = [](const std::string&) {};
  std::optional<FoundPreload> known = recall_preload(*cache, key, model, quietly);
  const std::optional<FileLock> claim = known ? std::nullopt : claim_preload(*cache, key, say, wait);
  if (!known) known = recall_preload(*cache, key, model, say);
  if (known) {
    say(fmt::format("found by an earlier run, kept in {}; that took {}", cache->folder().string(),
                    duration_text(time_since(started))));
    return std::move(*known);
  }
  FoundPreload found = solved(solve);
  keep_preload(*cache, key, found, say);
  return found;
}

Preload preload_and_corrugate(const ResolvedScene& resolved, Model& model, const ProgressText& say) {
  FoundPreload found = find_preload(
      preload_cache(""), resolved, model, [&] { return solve_preload(model, steady_motion(model), say); },
      say, [] {});
  if (model.scene.corrugation) model.apply_corrugation(deepest_line(model.scene, found.preload));
  return std::move(found.preload);
}

}  // namespace tread
