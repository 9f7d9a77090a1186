#include <algorithm>
#include <cstddef>
#include <set>

#include "io/scene/key_table.hpp"
#include "io/scene/schema.hpp"

namespace tread {

namespace {

std::string_view leaf_of(std::string_view path) {
  return path.substr(path.rfind('.') + 1);
}

/// Returns true if one name has all words of the other: "mass" and "sprung_mass".
bool shares_words(std::string_view one, std::string_view other) {
  const auto words = [](std::string_view name) {
    std::set<std::string_view> found;
    for (; found.insert(name.substr(0, name.find('_'))), name.find('_') != std::string_view::npos;)
      name.remove_prefix(name.find('_') + 1);
    return found;
  };
  const std::set<std::string_view> a = words(one), b = words(other);
  return std::includes(a.begin(), a.end(), b.begin(), b.end()) ||
         std::includes(b.begin(), b.end(), a.begin(), a.end());
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// Edits up to which a word still counts as a misspelling.
std::size_t tolerance(std::string_view word) {
  return std::clamp<std::size_t>(word.size() / 3, 1, 3);
}

/// A path of the same table that shares words with the unknown one, else one of the same last word in another
/// table; "" where several tables have that word and the unknown path lies in a known one.
std::string of_same_words(std::string_view unknown, const std::vector<std::string>& paths) {
  const std::string_view table = table_above(unknown);
  const bool in_known = !table.empty() && is_table(table);
  std::vector<std::string> elsewhere;
  for (const std::string& path : paths) {
    if (in_known && table_above(path) == table && shares_words(leaf_of(path), leaf_of(unknown))) return path;
    if (leaf_of(path) == leaf_of(unknown)) elsewhere.push_back(path);
  }
  const auto other_table = [&](const std::string& path) {
    return path.substr(0, path.find('.')) != elsewhere.front().substr(0, elsewhere.front().find('.'));
  };
  if (elsewhere.empty() || (in_known && std::any_of(elsewhere.begin(), elsewhere.end(), other_table)))
    return "";
  return elsewhere.front();
}

}  // namespace

std::string_view table_above(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? "" : path.substr(0, dot);
}

std::string similar_text(std::string_view text, const std::vector<std::string>& options) {
  constexpr std::size_t kLongestWord = 100;
  if (text.size() > kLongestWord) return "";
  std::string best;
  std::size_t least = tolerance(leaf_of(text)) + 1;
  for (const std::string& option : options) {
    const std::size_t distance = edit_distance(text, option);
    if (distance >= least) continue;
    least = distance;
    best = option;
  }
  return best;
}

std::string similar_path(std::string_view unknown) {
  std::vector<std::string> paths;
  for (const Key& key : scene_keys()) paths.push_back(key.path);
  for (const Key& key : scene_keys())  // tables within tables: "motion.traction"
    if (const auto dot = key.path.rfind('.'); key.path.find('.') < dot)
      paths.push_back(key.path.substr(0, dot));
  for (const SceneTable& table : scene_tables()) paths.push_back(table.name);
  for (const Key& key : keys::named_keys(keys::named_table_of(unknown))) paths.push_back(key.path);
  for (const std::string_view kind : kNamedTables) paths.emplace_back(kind.substr(0, kind.size() - 1));
  const std::string near = similar_text(unknown, paths);
  if (std::find(kNamedTables.begin(), kNamedTables.end(), near + ".") != kNamedTables.end())
    return near + ".NAME";
  if (!near.empty() || leaf_of(unknown) == "present") return near;  // most tables have that key
  return of_same_words(unknown, paths);
}

}  // namespace tread
