// Errors when an output cannot be written, and the files that remain then.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/error.hpp"
#include "io/files/history_file.hpp"
#include "io/files/output_file.hpp"
#include "tests/commands_test.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

/// Stands for a full disk: files of this process cannot grow beyond `bytes`.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

std::string content(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class OutputErrors : public testing::Test {
 protected:
  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
  std::vector<Channel> channels_ = {{"time", "s", ""}, {"vertical_force", "N", ""}};
};

TEST_F(OutputErrors, MissingFolderIsNamed) {
  const std::string histories =
      samples::refusal<ResourceError>([&] { HistoryFile(folder_ / "absent", channels_); });
  EXPECT_NE(histories.find("absent/run.h5: No such file or directory"), std::string::npos) << histories;
  const std::string text =
      samples::refusal<ResourceError>([&] { write_text_file(folder_ / "absent/a.json", "{}"); });
  EXPECT_NE(text.find("absent/a.json"), std::string::npos) << text;
}

TEST_F(OutputErrors, FolderWithoutPermissionIsNamed) {
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  const uid_t user = ::geteuid();
  if (user == 0) {
    ASSERT_EQ(::seteuid(65534), 0);  // root may write everywhere, nobody may not
  }
  const std::string message = samples::refusal<ResourceError>([&] { HistoryFile(folder_, channels_); });
  ASSERT_EQ(::seteuid(user), 0);
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_NE(message.find("run.h5: Permission denied"), std::string::npos) << message;
}

TEST_F(OutputErrors, AFileInPlaceOfAFolderIsNamed) {
  const fs::path place = folder_ / "frames";
  std::ofstream(place) << "mine";
  const std::string expected =
      fmt::format("cannot create {0}: a file of that name is there; remove or rename {0}", place.string());
  EXPECT_EQ(samples::refusal<ResourceError>([&] { create_folder(place); }), expected);
  EXPECT_EQ(samples::refusal<ResourceError>([&] { create_last_folder(place); }), expected);
}

TEST_F(OutputErrors, UnreadableHdf5IsAnInputError) {
  const std::string absent = samples::refusal<InputError>([&] { Hdf5File::open_to_read(folder_ / "a.h5"); });
  EXPECT_NE(absent.find("a.h5: No such file or directory"), std::string::npos) << absent;
  write_text_file(folder_ / "text.h5", "not HDF5");
  const std::string foreign =
      samples::refusal<InputError>([&] { Hdf5File::open_to_read(folder_ / "text.h5"); });
  EXPECT_NE(foreign.find("text.h5"), std::string::npos) << foreign;

  Hdf5File::create(folder_ / "empty.h5").close();
  const Hdf5File empty = Hdf5File::open_to_read(folder_ / "empty.h5");
  const std::string dataset = samples::refusal<InputError>([&] { empty.read<double>("/histories/time"); });
  EXPECT_NE(dataset.find("'/histories/time'"), std::string::npos) << dataset;
  EXPECT_NE(dataset.find("empty.h5"), std::string::npos) << dataset;
}

/// Appends rows of the given values until the disk is full; returns the message and checks what is left.
std::string fill_disk(const fs::path& folder, const std::vector<Channel>& channels, double scale) {
  std::string message;
  std::int64_t kept = 0;
  {
    HistoryFile histories(folder, channels);
    const FileSizeLimit limit(60'000);
    message = samples::refusal<ResourceError>([&] {
      for (int i = 0; i < 100'000; ++i) histories.append(std::array{scale * i / 3e5, scale / (i + 1)});
    });
    kept = histories.rows_written();
  }
  EXPECT_NE(message.find(fmt::format("{} rows, up to time = ", kept)), std::string::npos) << message;
  EXPECT_NE(message.find("kept in " + (folder / "histories.csv").string()), std::string::npos) << message;

  const std::string csv = content(folder / "histories.csv");
  EXPECT_EQ(csv.back(), '\n');
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), kept + 1);
  EXPECT_GT(kept, 500);
  const Hdf5File run = Hdf5File::open_to_read(folder / "run.h5");
  EXPECT_GE(static_cast<std::int64_t>(run.read<double>("/histories/time").size()),
            kept - static_cast<std::int64_t>(HistoryFile::kBlock));
  return message;
}

TEST_F(OutputErrors, FullDiskKeepsWholeRowsOfTheCsvFile) {
  const std::string message = fill_disk(folder_, channels_, 1.0);  // long numbers: more than 16 B a row
  EXPECT_NE(message.find("histories.csv: File too large"), std::string::npos) << message;
}

TEST_F(OutputErrors, FullDiskLeavesAnHdf5FileThatOpens) {
  const std::string message = fill_disk(folder_, channels_, 0.0);  // "0,0": less than 16 B a row
  EXPECT_NE(message.find("run.h5"), std::string::npos) << message;
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
}

TEST_F(OutputErrors, AFileThatCannotBeReplacedStays) {
  const fs::path path = folder_ / "summary.json";
  write_text_file(path, "old");
  std::string message;
  {
    const FileSizeLimit limit(1000);
    message = samples::refusal<ResourceError>([&] { write_text_file(path, std::string(5000, 'x')); });
  }
  EXPECT_NE(message.find("summary.json"), std::string::npos) << message;
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_EQ(content(path), "old");
  EXPECT_FALSE(fs::exists(path.string() + ".part"));
}

/// The program in a shell that runs `before` first; its errors go to a file except where `before` closes
/// them.
class Descriptors : public samples::Commands {
 protected:
  /// Exit code of `tread arguments`; after a signal 128 + its number.
  int shell(const std::string& before, const std::string& arguments) const {
    const std::string command = fmt::format("cd {}; exec 2>errors; {}; {} {}; exit $?", folder_.string(),
                                            before, shell_word(TREAD_EXECUTABLE), arguments);
    return WEXITSTATUS(std::system(command.c_str()));
  }
};

TEST_F(Descriptors, ClosedOnesGoToNoFileOfARun) {
  const std::string run =
      fmt::format("run {} -o run -t 1 --set 'scene.element_size=8 mm'", scene("tyre.toml"));
  EXPECT_EQ(shell("exec 0<&- 1>&- 2>&-", run), 0);
  EXPECT_EQ(content("run/histories.csv").find("tread"), std::string::npos);
  EXPECT_EQ(content("run/histories.csv").find("[roll]"), std::string::npos);
}

TEST_F(Descriptors, ErrorsWithoutAListenerHaveTheirExitCode) {
  for (const char* closed : {"exec 1>&- 2>&-", "exec 1>&- 2>/dev/full"}) {
    EXPECT_EQ(shell(closed, "version"), 4) << closed;
    EXPECT_EQ(shell(closed, "run nope"), 2) << closed;
    EXPECT_EQ(shell(closed, "run nope --json"), 2) << closed;
    EXPECT_EQ(shell(closed, "check --json " + scene("tyre.toml")), 4) << closed;
  }
}

TEST_F(Descriptors, ABoundOnTheSizeOfFilesIsAnError) {
  EXPECT_EQ(shell("ulimit -f 0", "profile LMA -o u.txt >/dev/null 2>&1"), 4);
  EXPECT_EQ(shell("ulimit -f 0", "version >out"), 4);
}

TEST_F(Descriptors, SamplesThatAreKeptAreThoseInTheFiles) {
  std::string arguments = fmt::format(
      "run {} -o run -t 1 --quiet --set output.frames=0 --set output.history_interval=0.1us --set "
      "motion.duration=0.95ms --set material.steel.poissons_ratio=0.3",
      scene("bar-wave.toml"));
  for (const char* name :
       {"a", "b", "c", "d"})  // text takes more than binary numbers: the table is full first
    arguments += fmt::format(
        " --set probe.{0}.x=0.43m --set probe.{0}.y=2mm --set probe.{0}.depth=3mm --set "
        "probe.{0}.quantity=all",
        name);
  EXPECT_EQ(shell("ulimit -f 1580", arguments), 4);
  const std::string table = content("run/histories.csv");
  const auto rows = std::count(table.begin(), table.end(), '\n') - 1;
  EXPECT_GT(rows, 500);
  EXPECT_TRUE(samples::has(content("errors"), "histories.csv: File too large")) << content("errors");
  EXPECT_TRUE(samples::has(content("errors"), fmt::format("; {} samples are kept in run;", rows)))
      << content("errors");
}

TEST_F(Descriptors, LongTextIntoAFullOutputIsNamedLikeShortText) {
  for (const char* command : {"version", "scene-reference", "scene-reference --json", "verify --list"})
    for (const char* output : {">/dev/full", ">&-"}) {
      EXPECT_EQ(shell(":", fmt::format("{} {}", command, output)), 4) << command << output;
      EXPECT_TRUE(samples::has(content("errors"), "tread: standard output: ")) << content("errors");
      EXPECT_FALSE(samples::has(content("errors"), "unexpected")) << content("errors");
    }
}

TEST_F(Descriptors, ANameThatIsTooLongNamesItsOption) {
  const std::string name(300, 'x');
  for (const std::string command :
       {"run tyre -o ", "profile LMA --svg ", "export tyre -o ", "mesh tyre -o "}) {
    EXPECT_EQ(shell(":", command + name), 2) << command;
    EXPECT_TRUE(samples::has(content("errors"), "a name of 300 characters is too long")) << content("errors");
  }
}

TEST_F(Descriptors, ANamedPipeIsWrittenToAndALinkFollowed) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(shell("{ cat pipe >piped & }", "profile LMA -o pipe >/dev/null; wait"), 0) << content("errors");
  EXPECT_TRUE(std::filesystem::is_fifo(folder_ / "pipe"));
  std::filesystem::create_symlink("behind.txt", folder_ / "link");
  for (int i = 0; i < 2; ++i) {  // a link to nothing, to a file
    EXPECT_EQ(shell(":", "profile LMA -o link >/dev/null"), 0) << content("errors");
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
  }
  EXPECT_EQ(shell(":", "profile LMA -o /dev/stdout >shown"), 0) << content("errors");
  const std::string columns = content("behind.txt");
  EXPECT_GT(columns.size(), 1000U);
  EXPECT_TRUE(content("piped") == columns);
  EXPECT_TRUE(content("shown").starts_with(columns));
  EXPECT_GT(content("shown").size(), columns.size());
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_EQ(shell(":", "profile LMA -o folder"), 4);
}

/// A file is written by way of a neighbour, which must be no file of the user's and must not stay.
TEST_F(Descriptors, FilesBesideANamedOneStay) {
  for (const char* name : {"u.txt.part", "u.txt.tmp"}) std::ofstream(folder_ / name) << "mine";
  EXPECT_EQ(shell("umask 027", "profile LMA -o u.txt >/dev/null"), 0) << content("errors");
  EXPECT_EQ(fs::status(folder_ / "u.txt").permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  EXPECT_EQ(shell(":", "profile LMA -o /dev/stdout >u.txt"), 0) << content("errors");
  EXPECT_EQ(shell("ulimit -f 0", "profile LMA -o u.txt >/dev/null 2>&1"), 4);
  for (const char* name : {"u.txt.part", "u.txt.tmp"}) EXPECT_EQ(content(name), "mine") << name;
  // Those, u.txt and the errors.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 4);
}

TEST_F(Descriptors, WhatAKilledCommandLeftGoesAndWhatALivingOneWritesStays) {
  const fs::path left = folder_ / "u.txt.tread.part";
  const std::string words = "profile LMA -o u.txt >/dev/null";
  std::ofstream(left) << "half";
  EXPECT_EQ(shell(":", words), 0) << content("errors");
  EXPECT_FALSE(fs::exists(left));
  {
    const Neighbour living(folder_ / "u.txt");
    EXPECT_EQ(living.path(), left);
    EXPECT_EQ(shell(":", words), 0) << content("errors");
    EXPECT_TRUE(fs::exists(left));
  }
  EXPECT_EQ(shell(":", words), 0) << content("errors");
  // u.txt and the errors.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
  const std::string longest = std::string(254, 'x') + "y";
  EXPECT_EQ(Neighbour(folder_ / longest).path().filename().string(), longest.substr(0, 244) + ".tread.part");
}

TEST_F(Descriptors, AFolderThatIsMissingIsNamed) {
  for (const std::string command : {"profile LMA -o none/x.txt", "profile LMA --svg none/x.svg"}) {
    EXPECT_EQ(shell(":", command), 4);
    EXPECT_TRUE(samples::has(content("errors"), "cannot write none/x.")) << content("errors");
    EXPECT_TRUE(samples::has(content("errors"), "there is no folder none")) << content("errors");
  }
}

}  // namespace
}  // namespace tread
