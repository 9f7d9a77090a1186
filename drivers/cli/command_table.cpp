#include "drivers/cli/command_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

namespace tread {

namespace {

/// Values that a type or an option's own text names: "TEXT:{show,clear}", "draft|standard|paper".
std::vector<std::string> choices_in(const std::string& type) {
  if (type.find('|') != std::string::npos) return CLI::detail::split(type, '|');
  const auto first = type.find('{');
  const auto last = type.rfind('}');
  if (first == std::string::npos || last == std::string::npos || last < first) return {};
  return CLI::detail::split(type.substr(first + 1, last - first - 1), ',');
}

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  if (option.get_positional()) {
    entry.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  }
  entry.text = option.get_description();
  const std::string& stated = option.get_option_text();
  const std::string type = stated.empty() ? option.get_type_name() : stated;
  if (option.get_items_expected_max() > 0) entry.value = type.substr(0, type.find(':'));
  entry.choices = choices_in(type);
  if (entry.value.find('|') != std::string::npos) entry.value = "TEXT";
  entry.required = option.get_required();
  entry.repeated = option.get_items_expected_max() > 1;
  return entry;
}

CommandEntry entry_of(const CLI::App& command, std::vector<std::string> words) {
  CommandEntry entry;
  entry.words = std::move(words);
  entry.text = command.get_description();
  for (const CLI::Option* option : command.get_options())
    (option->get_positional() ? entry.positionals : entry.options).push_back(entry_of(*option));
  for (const CLI::App* part : command.get_subcommands({})) {
    std::vector<std::string> longer = entry.words;
    longer.push_back(part->get_name());
    entry.commands.push_back(entry_of(*part, std::move(longer)));
  }
  return entry;
}

}  // namespace

std::string CommandEntry::name(const std::string& between) const {
  return fmt::format("{}", fmt::join(words, between));
}

CommandEntry command_table(const CLI::App& program) {
  return entry_of(program, {"tread"});
}

}  // namespace tread
