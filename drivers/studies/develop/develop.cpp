#include "drivers/studies/develop/develop.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "drivers/process/interruption.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/develop/development_folder.hpp"
#include "drivers/studies/develop/development_report.hpp"
#include "drivers/studies/develop/passage_room.hpp"
#include "drivers/studies/study/run_study.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/plain_text.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

void leave(const DevelopmentFolder& folder, const Development& development, const ResolvedScene& resolved,
           const Provenance& origin) {
  const RunFolder& place = folder.folder();
  write_text_file(place / "profiles.csv", profiles_csv(development));
  write_text_file(place / "spectra.csv", spectra_csv(development));
  write_text_file(place / "growth.csv", growth_csv(development));
  write_text_file(place / "development.json", development_json(development));
  replace_report(place / "report.html", development_report(development, resolved, origin));
}

std::string passage_text(const Development& development) {
  std::string text = fmt::format("[develop] passage {} stands for {:.4g}", development.passages.size(),
                                 development.passages.back().passages);
  if (const std::optional<BandOutcome> band = deepest(outcome(development)))
    text += fmt::format("; waves of {:g} mm: {:.4g} um at the start, {:.4g} um now", 1e3 * band->wavelength,
                        1e6 * band->before, 1e6 * band->after);
  return text;
}

}  // namespace

void develop(const ResolvedScene& resolved, const DevelopOptions& options) {
  Development development;
  development.plan = wear_plan(resolved.scene);
  require_folder_of(options.output, "develop");
  const std::vector<std::string> launcher = launcher_words(options.launcher);
  if (const std::string missing = missing_launcher(launcher); !missing.empty()) throw InputError(missing);
  const std::string card = missing_device(options.device);
  if (launcher.empty() && !card.empty()) throw ResourceError(card);
  Progress progress(options.quiet);
  std::optional<double> room;
  if (!std::filesystem::exists(options.output / kKeptScene)) {
    if (options.from.empty()) room = room_of_passage0(resolved, options.passages);
    const std::string outgrown = room ? short_room(resolved.scene, *room, options.passages)
                                      : outgrown_room(resolved.scene, options.from, options.passages);
    if (!outgrown.empty()) progress.say("[develop] warning: " + outgrown);
  }
  Interruption interruption("tread: stopped before the first passage",
                            "tread: stopped at once; the same command goes on from the last checkpoint");
  const DevelopmentFolder folder(options.output, resolved,
                                 {options.from, options.threads, options.device, launcher, options.passages,
                                  room, options.origin.command});
  interruption.defer();
  development.begin(folder.pass(0, nullptr, progress), *resolved.scene.corrugation);
  for (int number = 1; number <= options.passages; ++number) {
    development.add(folder.pass(number, &development, progress));
    progress.say(passage_text(development));
    leave(folder, development, resolved, options.origin);
  }
  folder.keep_profile(options.passages, development);
  if (options.json)
    fmt::print("{}", development_json(development));
  else
    fmt::print("{}{}\n", plain_text(growth_table(development)), verdict(development));
}

}  // namespace tread
