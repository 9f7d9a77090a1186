#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "drivers/cli/command_table.hpp"
#include "drivers/cli/commands.hpp"
#include "drivers/cli/man_page.hpp"
#include "drivers/cli/shell_completion.hpp"
#include "io/files/output_file.hpp"

namespace tread {

namespace {

void write_manual(const CommandEntry& program, const std::filesystem::path& folder) {
  const auto write = [&](const char* part, const std::string& name, const std::string& text) {
    make_directory(folder / part);
    write_text_file(folder / part / name, text);
  };
  for (const auto& [name, text] : man_pages(program)) write("man1", name, text);
  write("bash", "tread", bash_completion(program));
  write("zsh", "_tread", zsh_completion(program));
  write("fish", "tread.fish", fish_completion(program));
}

}  // namespace

void add_manual(CLI::App& app, const std::string& /*command_line*/) {
  auto folder = std::make_shared<std::string>();
  CLI::App& command =
      *app.add_subcommand("manual", "man pages, and completion for bash, zsh and fish, into a directory");
  command.add_option("-o,--output", *folder, "directory for man1, bash, zsh and fish")->required();
  command.callback([&app, folder] { write_manual(command_table(app), *folder); });
}

}  // namespace tread
