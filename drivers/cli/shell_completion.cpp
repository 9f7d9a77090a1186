#include "drivers/cli/shell_completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <map>

namespace tread {

namespace {

/// Calls `act` for the program and every command, parents first.
void for_each(const CommandEntry& command, const std::function<void(const CommandEntry&)>& act) {
  act(command);
  for (const CommandEntry& part : command.commands) for_each(part, act);
}

/// Words after "tread": "bench kernels".
std::string path_of(const CommandEntry& command) {
  const std::string name = command.name(" ");
  const auto blank = name.find(' ');
  return blank == std::string::npos ? "" : name.substr(blank + 1);
}

/// Words that may follow besides options: commands, or values of positionals.
std::vector<std::string> words_of(const CommandEntry& command) {
  std::vector<std::string> words;
  for (const CommandEntry& part : command.commands) words.push_back(part.words.back());
  for (const OptionEntry& positional : command.positionals)
    words.insert(words.end(), positional.choices.begin(), positional.choices.end());
  return words;
}

std::vector<std::string> names_of(const std::vector<OptionEntry>& options) {
  std::vector<std::string> names;
  for (const OptionEntry& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// Text within single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

/// A word with its meaning, as zsh's _describe takes it.
std::string described(const std::string& word, const std::string& meaning) {
  return quoted(word + ":" + meaning);
}

/// Cases of `case "$command $previous"` for options with a value: one case a command for free values, one an
/// option with choices.
std::string bash_values(const CommandEntry& program) {
  std::string text;
  for_each(program, [&](const CommandEntry& command) {
    std::map<std::string, std::vector<std::string>> patterns;  // by choices
    for (const OptionEntry& option : command.options)
      for (const std::string& name : option.names)
        if (!option.value.empty())
          patterns[fmt::format("{}", fmt::join(option.choices, " "))].push_back(
              quoted(path_of(command) + " " + name));
    for (const auto& [choices, names] : patterns)
      text += fmt::format("    {}) words={}; options= ;;\n", fmt::join(names, " | "), quoted(choices));
  });
  return text;
}

}  // namespace

std::string bash_completion(const CommandEntry& program) {
  std::string paths, cases;
  for_each(program, [&](const CommandEntry& command) {
    const std::string path = path_of(command);
    if (!path.empty()) paths += (paths.empty() ? "" : " | ") + quoted(path);
    cases += fmt::format("    {}) words={}; options={} ;;\n", quoted(path),
                         quoted(fmt::format("{}", fmt::join(words_of(command), " "))),
                         quoted(fmt::format("{}", fmt::join(names_of(command.options), " "))));
  });
  return fmt::format(R"(# bash completion for tread, written by `tread manual`.
_tread() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command='' words='' options='' next i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    next=${{command:+$command }}${{COMP_WORDS[i]}}
    case $next in
    {0}) command=$next ;;
    esac
  done
  case $command in
{1}  esac
  case "$command $previous" in
{2}  esac
  [[ $current == -* ]] && words=$options
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _tread tread
)",
                     paths, cases, bash_values(program));
}

std::string zsh_completion(const CommandEntry& program) {
  std::string paths, cases, values;
  for_each(program, [&](const CommandEntry& command) {
    const std::string path = path_of(command);
    if (!path.empty()) paths += (paths.empty() ? "" : " | ") + quoted(path);
    std::string words, options;
    for (const CommandEntry& part : command.commands) words += " " + described(part.words.back(), part.text);
    for (const OptionEntry& positional : command.positionals)
      for (const std::string& choice : positional.choices) words += " " + quoted(choice);
    for (const OptionEntry& option : command.options) {
      for (const std::string& name : option.names) options += " " + described(name, option.text);
      if (option.value.empty()) continue;
      for (const std::string& name : option.names)
        values += fmt::format("    {}) values=({}); free=1 ;;\n", quoted(path + " " + name),
                              fmt::join(option.choices, " "));
    }
    cases +=
        fmt::format("    {})\n      commands=({})\n      options=({}) ;;\n", quoted(path), words, options);
  });
  return fmt::format(R"(#compdef tread
# zsh completion for tread, written by `tread manual`.
_tread() {{
  local place= next= i free=0
  local -a commands options values
  for ((i = 2; i < CURRENT; ++i)); do
    next=${{place:+$place }}${{words[i]}}
    case $next in
    {0}) place=$next ;;
    esac
  done
  case "$place ${{words[CURRENT - 1]}}" in
{2}  esac
  if (( $#values )); then
    compadd -a values
    return
  fi
  case $place in
{1}  esac
  if (( ! free )) && [[ ${{words[CURRENT]}} == -* ]]; then
    _describe -o option options
    return
  fi
  (( free || ! $#commands )) || _describe command commands
  _files
}}
_tread "$@"
)",
                     paths, cases, values);
}

std::string fish_completion(const CommandEntry& program) {
  std::string text = "# fish completion for tread, written by `tread manual`.\n";
  for_each(program, [&](const CommandEntry& command) {
    std::string condition;
    for (std::size_t i = 1; i < command.words.size(); ++i)
      condition += fmt::format("{}__fish_seen_subcommand_from {}", condition.empty() ? "" : "; and ",
                               command.words[i]);
    const std::string here = fmt::format("complete -c tread -n {}",
                                         quoted(condition.empty() ? "__fish_use_subcommand" : condition));
    for (const CommandEntry& part : command.commands)
      text += fmt::format("{} -a {} -d {}\n", here, part.words.back(), quoted(part.text));
    for (const OptionEntry& positional : command.positionals)
      if (!positional.choices.empty())
        text +=
            fmt::format("{} -a {}\n", here, quoted(fmt::format("{}", fmt::join(positional.choices, " "))));
    for (const OptionEntry& option : command.options) {
      text += here;
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                       : fmt::format(" -s {}", name.substr(1));
      if (!option.value.empty()) text += " -r";
      if (!option.choices.empty())
        text += fmt::format(" -f -a {}", quoted(fmt::format("{}", fmt::join(option.choices, " "))));
      text += fmt::format(" -d {}\n", quoted(option.text));
    }
  });
  return text;
}

}  // namespace tread
