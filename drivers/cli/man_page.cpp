#include "drivers/cli/man_page.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "drivers/cli/exit_codes.hpp"
#include "drivers/process/version.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

constexpr std::array<std::pair<const char*, const char*>, 5> kEnvironment = {
    {{"TREAD_BACKEND", "Library that runs the threads, tbb or openmp; --backend overrides it."},
     {"TREAD_CACHE", "Folder of the preload cache, or off; --cache overrides it."},
     {"TREAD_CACHE_LIMIT", "Largest size of the preload cache, e.g. \"5 GB\"."},
     {"TREAD_INSTRUCTION_SET", "Instruction set of the elements: baseline, avx2 or avx512."},
     {"TREAD_SHARE", "Folder of data files in place of share/tread beside the program."}}};

/// Text for roff: hyphens that can be copied, no line that begins with a command.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\n')
      out += ' ';
    else
      out += c;
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string value_text(const OptionEntry& option) {
  std::string text = fmt::format("\\fI{}\\fR{}", roff(option.value), option.repeated ? " ..." : "");
  if (!option.choices.empty())
    text += fmt::format(" ({})", roff(fmt::format("{}", fmt::join(option.choices, ", "))));
  return text;
}

std::string option_text(const OptionEntry& option) {
  std::string heads;
  for (const std::string& name : option.names)
    heads += fmt::format("{}\\fB{}\\fR", heads.empty() ? "" : ", ", roff(name));
  if (!option.value.empty()) heads += fmt::format(" {}", value_text(option));
  return fmt::format(".TP\n{}\n{}\n", heads, roff(option.text));
}

std::string synopsis(const CommandEntry& command) {
  std::string text = fmt::format(".B {}\n", roff(command.name(" ")));
  text += "[\\fIoptions\\fR]";
  if (!command.commands.empty()) text += " \\fIcommand\\fR ...";
  for (const OptionEntry& positional : command.positionals) {
    const std::string name =
        fmt::format("\\fI{}\\fR{}", roff(positional.names[0]), positional.repeated ? " ..." : "");
    text += positional.required ? fmt::format(" {}", name) : fmt::format(" [{}]", name);
  }
  return text + "\n";
}

std::string arguments(const CommandEntry& command) {
  std::string text;
  if (!command.positionals.empty()) text += ".SH ARGUMENTS\n";
  for (const OptionEntry& positional : command.positionals) text += option_text(positional);
  if (!command.options.empty()) text += ".SH OPTIONS\n";
  for (const OptionEntry& option : command.options) text += option_text(option);
  if (!command.commands.empty()) text += ".SH COMMANDS\n";
  for (const CommandEntry& part : command.commands)
    text += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", roff(part.name("-")), roff(part.text));
  return text;
}

/// Exit codes, and the environment on the page of the program.
std::string exit_and_environment(bool of_program) {
  std::string text = ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : kExitCodes)
    text += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(code), roff(meaning));
  if (!of_program) return text;
  text += ".SH ENVIRONMENT\n";
  for (const auto& [name, meaning] : kEnvironment)
    text += fmt::format(".TP\n.B {}\n{}\n", name, roff(meaning));
  return text;
}

std::string page(const CommandEntry& command, const CommandEntry* parent) {
  const std::string name = command.name("-");
  std::string text =
      fmt::format(".TH {} 1 \"\" \"tread {}\" \"tread manual\"\n", roff(upper_case(name)), program_version());
  text +=
      fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", roff(name), roff(command.text), synopsis(command));
  text += arguments(command);
  text += exit_and_environment(parent == nullptr);
  if (parent) text += fmt::format(".SH SEE ALSO\n.BR {} (1)\n", roff(parent->name("-")));
  return text;
}

void add_pages(const CommandEntry& command, const CommandEntry* parent,
               std::map<std::string, std::string>& pages) {
  pages[command.name("-") + ".1"] = page(command, parent);
  for (const CommandEntry& part : command.commands) add_pages(part, &command, pages);
}

}  // namespace

std::map<std::string, std::string> man_pages(const CommandEntry& program) {
  std::map<std::string, std::string> pages;
  add_pages(program, nullptr, pages);
  return pages;
}

}  // namespace tread
