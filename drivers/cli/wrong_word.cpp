#include "drivers/cli/wrong_word.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "io/scene/schema.hpp"
#include "io/scene/unknown_key.hpp"

namespace tread {

namespace {

/// Name of an option as a scene would spell it: "mass_scaling" of "--mass-scaling=2".
std::string as_key(const std::string& word) {
  std::string key = word.substr(std::min(word.find_first_not_of('-'), word.size()));
  key = key.substr(0, key.find('='));
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

}  // namespace

std::string wrong_word(const CommandEntry& command, const std::vector<std::string>& typed,
                       const std::vector<std::string>& unknown) {
  // The word typed first among those left over: a misspelt option leaves its value over, too.
  const auto found = std::find_first_of(typed.begin(), typed.end(), unknown.begin(), unknown.end());
  const std::string word = found == typed.end() ? unknown.front() : *found;
  const std::string name = command.name(" ");
  if (!word.starts_with('-'))
    return fmt::format("{}: '{}' was not expected here; `{} --help` shows how", name, word, name);
  if (const std::string instead(instead_of(as_key(word))); !instead.empty())
    return fmt::format("{}: there is no option {}: {}", name, word, instead);
  std::vector<std::string> names;
  for (const OptionEntry& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  const std::string near = similar_text(word.substr(0, word.find('=')), names);
  return fmt::format("{}: there is no option {}; {}`{} --help` lists all", name, word,
                     near.empty() ? "" : fmt::format("did you mean {}? ", near), name);
}

}  // namespace tread
