// Man pages and shell completion hold every command and option that `--help` shows.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/program.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using samples::content_of;
using samples::has;

class Manual : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(program_.call("manual -o " + folder_.string()), 0) << program_.errors(); }

  /// Page of a command, "bench kernels", without the marks of roff.
  std::string page(const std::string& command) const {
    const std::string file =
        "tread" + std::regex_replace(" " + command, std::regex(" +(?=.)|^ $"), "-") + ".1";
    return std::regex_replace(content_of(folder_ / "man1" / (command.empty() ? "tread.1" : file)),
                              std::regex(R"(\\f[BIR]|\\(?=-))"), "");
  }
  std::string help(const std::string& command) const {
    EXPECT_EQ(program_.call(command + " --help"), 0) << command;
    return program_.out();
  }
  /// Words that bash offers behind "tread " + `line`, whose last word is being typed.
  std::string offered(const std::string& line) const {
    const std::string command = fmt::format(
        "source {0}/bash/tread; COMP_WORDS=(tread {1}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _tread; "
        "echo \"${{COMPREPLY[*]}}\" >{0}/offered",
        folder_.string(), line);
    EXPECT_EQ(samples::wait_for(samples::child([&] {
                ::execlp("bash", "bash", "-c", command.c_str(), nullptr);
                ::_exit(127);
              })),
              0);
    return content_of(folder_ / "offered");
  }

  /// Words that zsh offers there; nothing where this machine has no zsh.
  std::optional<std::string> offered_by_zsh(const std::string& line) const {
    const std::string command = fmt::format(
        "compadd() {{ print -- ${{(P)2}} }}; _files() {{ print files }}; "
        "_describe() {{ local word; for word in ${{(P)@[-1]}}; do print -rn -- \"${{word%%:*}} \"; done; "
        "print; }}; "
        "words=(tread {1}); CURRENT=$#words; source {0}/zsh/_tread >{0}/offered",
        folder_.string(), line);
    const int code = samples::wait_for(samples::child([&] {
      ::execlp("zsh", "zsh", "-f", "-c", command.c_str(), nullptr);
      ::_exit(127);
    }));
    if (code == 127) return std::nullopt;
    EXPECT_EQ(code, 0) << line;
    return content_of(folder_ / "offered");
  }

  samples::Program program_;
  const fs::path& folder_ = program_.folder;
};

/// All matches of a pattern's first group.
std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

TEST_F(Manual, HoldsEveryCommandAndOption) {
  const std::string fish = content_of(folder_ / "fish/tread.fish");
  const std::string zsh = content_of(folder_ / "zsh/_tread");
  std::vector<std::string> commands = {""};
  std::size_t options = 0;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string command = commands[i];
    const std::string text = help(command);
    const std::string man = page(command);
    const std::string words = offered(command + " ''");
    const std::string flags = offered(command + " -");
    EXPECT_TRUE(has(man, ".SH NAME\ntread")) << command;
    const auto list = text.find("Subcommands:");
    if (list != std::string::npos)
      for (const std::string& part : matches(text.substr(list), R"(\n  ([a-z-]+) )")) {
        commands.push_back(command.empty() ? part : command + " " + part);
        EXPECT_TRUE(has(words, part)) << words;
        EXPECT_TRUE(has(fish, " -a " + part + " ")) << part;
        EXPECT_TRUE(has(zsh, " '" + part + ":")) << part;
      }
    for (const std::string& option : matches(text.substr(0, list), R"(\n  (?:-[a-z],)?(--[a-z-]+))")) {
      ++options;
      EXPECT_TRUE(has(man, option)) << command << " " << option;
      EXPECT_TRUE(has(flags, option)) << command << " " << option;
      EXPECT_TRUE(has(fish, fmt::format(" -l {} ", option.substr(2)))) << command << " " << option;
      EXPECT_TRUE(has(zsh, " '" + option + ":")) << command << " " << option;
    }
  }
  EXPECT_GT(commands.size(), 20U);
  EXPECT_GT(options, 100U);
}

TEST_F(Manual, CompletionOffersValuesAndLeavesFilesToTheShell) {
  EXPECT_EQ(offered("ctl out st"), "status stop\n");
  EXPECT_EQ(offered("run x.toml --quality ''"), "draft standard paper\n");
  EXPECT_EQ(offered("bench compare --by ''"), "rate limit instructions\n");
  EXPECT_EQ(offered("run x.toml --ov"), "--overwrite\n");
  EXPECT_EQ(offered("run x.toml -o ''"), "\n");
  EXPECT_EQ(offered("run ''"), "\n");
}

TEST_F(Manual, CompletionOfZshOffersTheSame) {
  EXPECT_TRUE(content_of(folder_ / "zsh/_tread").starts_with("#compdef tread\n"));
  const auto values = offered_by_zsh("run x.toml --quality ''");
  if (!values) GTEST_SKIP() << "this machine has no zsh";
  EXPECT_EQ(*values, "draft standard paper\n");
  EXPECT_EQ(offered_by_zsh("bench compare --by ''"), "rate limit instructions\n");
  EXPECT_EQ(offered_by_zsh("ctl out ''"), "status checkpoint frame stop \nfiles\n");
  EXPECT_TRUE(has(*offered_by_zsh("run x.toml --"), "--overwrite "));
  EXPECT_TRUE(has(*offered_by_zsh("be"), "bench "));
  EXPECT_TRUE(has(*offered_by_zsh("bench ''"), "kernels "));
  EXPECT_EQ(offered_by_zsh("run x.toml -o ''"), "files\n");
  EXPECT_EQ(offered_by_zsh("run ''"), "files\n");
}

TEST_F(Manual, IsTheSameEveryTime) {
  const std::string first = content_of(folder_ / "man1/tread-run.1");
  EXPECT_FALSE(std::regex_search(first, std::regex("20[0-9][0-9]-")));
  ASSERT_EQ(program_.call("manual -o " + folder_.string()), 0);
  EXPECT_EQ(content_of(folder_ / "man1/tread-run.1"), first);
}

/// Every variable of the environment that the sources read is explained.
TEST_F(Manual, ExplainsTheEnvironment) {
  const std::string man = content_of(folder_ / "man1/tread.1");
  std::set<std::string> names;
  for (const char* folder : {"core", "kernels", "io", "drivers"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TREAD_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".cpp" && entry.path().filename() != "man_page.cpp")
        for (const std::string& name : matches(content_of(entry.path()), "\"(TREAD_[A-Z_]+)\""))
          names.insert(name);
  EXPECT_GE(names.size(), 4U);
  for (const std::string& name : names) EXPECT_TRUE(has(man, ".B " + name + "\n")) << name;
}

}  // namespace
}  // namespace tread
