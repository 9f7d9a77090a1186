// docs/reference/scene.md, printed from the schema.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/scene/scene_library.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

namespace {

constexpr const char* kIntroduction = R"(# Scene reference

This page is printed from the table of keys with which the program reads scenes.

A scene is a [TOML](https://toml.io) file.
A table that is absent is not modelled and costs nothing.

* **Units.** A physical quantity is a string with its unit: `"300 km/h"`, `"0.14 mm"`, `"205.9 GPa"`, `"200 kN s/m"`.
  Units are products, quotients and powers of m, g, t, s, min, h, N, J, Pa, Hz, B with the prefixes n, u, m, c, d, k, M, G.
  A blank or `*` multiplies; `/` divides by the next factor alone, or by brackets: `kg/(N m)`.
  A bare number is an error.
* **Base.** `scene.based_on` names a library entry (below); its values hold where the file states none.
  `present = false` leaves out a table of the base, for example in `[slab]`.
  A table that the base lacks is added by naming it.
* **Materials.** A material is a table of any name, for example `[material.wheel_steel]`.
  Parts name their material: `wheel.material = "wheel_steel"`.
  A material that no part names is an error; one of the base is left out.
* **Order.** Later values replace earlier ones: defaults, library entry, file, `--set key=value` on the command line.
  Example: `--set "motion.speed=250 km/h"`.
* **Files.** A file that a scene names is relative to the scene's folder.
  A file holds two numbers a line, separated by blanks, commas or semicolons; `#` starts a comment.
  A line such as `# x [m]  d [mm]` before the numbers states the units.
  Depths and friction need this line; profiles without the line are in millimetres.
  The file of a `[body.NAME]` is a mesh.
* **Mistakes.** Unknown keys, wrong units, values out of range and keys without effect are errors.
  Parts that do not fit together are errors too.
  All errors are reported at once with file, line and column.

"required" means that the key must be given where its table is present.

"affects" names the first part of a run that another value changes; later parts follow.
A new *mesh* needs a new static state (*preload*), and a new static state gives another *motion*.
Runs with equal mesh and preload share the static state through the preload cache.
A fork (`tread run --from`) may differ in all keys that affect none of mesh, preload and motion.
)";

constexpr const char* kStudyFile = R"(
## Study file

[`tread sweep`](commands.md#tread-sweep) reads a TOML file that varies keys of a scene.
[Run a study](../how-to/run-a-study.md) shows one; [studies](../explanation/studies.md) lists the effects.

| table | key | default | meaning |
|---|---|---|---|
| `[study]` | `title` | path of the file | title of the report, at most {text} characters |
| `[study]` | `scene` | required | scene file, relative to the study's folder; where there is none, the shipped scene of that name |
| `[study]` | `jobs` | as many as cores, cards and memory allow; elsewhere all | runs at once, 1 to {jobs}; `-j` replaces it |
| `[study]` | `threads` | a run's share of the idle cores | threads of a run, 1 to {jobs}; `-t` replaces it |
| `[study]` | `share` | `true` | points that are one run up to the corrugation roll there once; `--no-share` replaces it |
| `[set]` | keys of a scene | none | one value for all points |
| `[grid]` | keys of a scene | none | an array of values; each combination is a point, the last key changes fastest; at most {points} points |
| `[[point]]` | keys of a scene | none | one value for this point; one key at least |
| `[[point]]` | `name` | the ends of its keys and its values, such as `speed=300km_h,mu=0.3` | name of the point's folder |

A study has `[grid]` or `[[point]]`; both together are an error.
A key of `[set]` may not vary.
Equal points, empty arrays, unknown keys and keys without effect are errors.
A name has letters, digits and `.` `_` `+` `-` `=` `,`, at most {name} characters, and begins with neither `.` nor `-`.
Names differ from one another and from the files of a study, such as `sweep.csv`.
)";

/// A cell of a Markdown table.
std::string cell(std::string text) {
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.replace(at, 1, "\\|");
  return text;
}

/// The default in the unit of documentation.
std::string default_of(const Key& key, Scene& scene) {
  if (key.required) return "required";
  const Field field = key.locate(scene);
  if (const auto* text = std::get_if<std::string*>(&field)) return fmt::format("`\"{}\"`", **text);
  if (const auto* truth = std::get_if<bool*>(&field)) return **truth ? "`true`" : "`false`";
  if (std::holds_alternative<DampingField>(field)) return "none";
  const auto* optional = std::get_if<std::optional<double>*>(&field);
  if (optional && !**optional) return "none";
  const double value = *number_at(field);
  return key.unit.empty() ? fmt::format("`{:.6g}`", value)
                          : fmt::format("`\"{}\"`", format_quantity(value, key.unit));
}

std::string allowed_of(const Key& key) {
  if (key.kind == Kind::boolean) return "`true`, `false`";
  if (key.kind != Kind::text) return describe_range(key);
  if (key.names_material) return "a material of the scene";
  std::string list;
  for (const std::string& value : key.allowed)
    list += fmt::format("{}`\"{}\"`", list.empty() ? "" : ", ", value);
  if (key.takes_file) list += list.empty() ? "a file" : ", or a file";
  return list.empty() ? fmt::format("at most {} characters", kLongestText) : list;
}

std::string meaning_of(const Key& key) {
  std::string text = key.description;
  if (key.only_with.key.empty()) return text;
  const Condition& condition = key.only_with;
  return text + (condition.needs_table()
                     ? fmt::format(" (only with `[{}]`)", condition.key)
                     : fmt::format(" ({} with `{} = {}`)", condition.negated ? "not" : "only", condition.key,
                                   condition.alternatives()));
}

std::string table_section(const SceneTable& table, const std::vector<Key>& keys, Scene& scene) {
  std::string text = fmt::format("\n### [{}]\n\n{}\n\n", table.name, table.description);
  text += "| key | default | allowed | affects | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : keys) {
    if (table_of(key.path)->name != table.name) continue;
    const std::string name = key.path.substr(table.name.size() + 1);
    const bool directive = key.kind == Kind::directive;
    if (directive && table.removable()) continue;
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", name, directive ? "none" : default_of(key, scene),
                        directive ? "a library entry" : cell(allowed_of(key)),
                        directive ? "all that it sets" : key.effects.names(), cell(meaning_of(key)));
  }
  return text;
}

std::string effects_table() {
  std::string text = "\n| affects | meaning |\n|---|---|\n";
  for (const EffectText& effect : effect_texts())
    text += fmt::format("| {} | {} |\n", effect.name, effect.meaning);
  return text;
}

std::string library_section(const LibraryEntry& entry) {
  std::string text = fmt::format("\n### {}\n\n{}\n", entry.name, entry.description);
  if (!entry.base.empty()) text += fmt::format("All other values are those of `{}`.\n", entry.base);
  text += "\n| key | value | source |\n|---|---|---|\n";
  for (const LibraryValue& value : entry.values) {
    text += fmt::format("| `{}` | `{}` | {} |\n", value.path, cell(std::string(value.value)), value.source);
  }
  return text;
}

}  // namespace

std::string scene_reference() {
  const TableNames any_name = {{"NAME"}, {"NAME"}, {"NAME"}, {"NAME"}, {"NAME"}, {"NAME"}};
  const std::vector<SceneTable> tables = scene_tables(any_name);
  const std::vector<Key> keys = scene_keys(any_name);
  Scene everything;
  for (const SceneTable& table : tables) {
    if (table.removable()) table.create(everything);
  }
  std::string text = kIntroduction + effects_table();
  text += "\n## Tables\n";
  for (const SceneTable& table : tables) text += table_section(table, keys, everything);
  text += fmt::format(kStudyFile, fmt::arg("jobs", kMostJobs), fmt::arg("points", kMostPoints),
                      fmt::arg("name", kLongestPointName), fmt::arg("text", kLongestText));
  text += "\n## Library\n";
  for (const LibraryEntry& entry : scene_library()) text += library_section(entry);
  return text;
}

}  // namespace tread
