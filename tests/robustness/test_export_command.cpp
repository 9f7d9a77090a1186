// `tread export` as users call it: the files that it leaves.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;
using nlohmann::json;

class ExportCommand : public ProgramTest {
 protected:
  static void SetUpTestSuite() { make_root(); }
  static int export_tyre(const std::string& file, const std::string& options) {
    return call(
        fmt::format("export {} -t 1 --quiet --set \"scene.element_size=10 mm\" --set "
                    "\"motion.duration=1 ms\" -o {} {}",
                    shell_word(kTyre), (root_ / file).string(), options));
  }
};

TEST_F(ExportCommand, APreloadedDeckHasFilesForOpenRadioss) {
  ASSERT_EQ(export_tyre("roll.k", "--preload --overlap \"5 um\" --json"), 0) << errors();
  EXPECT_EQ(json::parse(output())["radioss_file"], (root_ / "roll_0000.rad").string());
  const std::string starter = content_of(root_ / "roll_0000.rad");
  EXPECT_TRUE(has(starter, "/BEGIN\nroll\n"));
  EXPECT_TRUE(has(starter, "/INCLUDE_LS-DYNA/\nroll.k\n"));
  for (const char* card : {"/INTER/TYPE25/", "/TH/INTER/", "/XREF/", "/INIVEL/NODE/"})
    EXPECT_TRUE(has(starter, card)) << card;
  const std::string engine = content_of(root_ / "roll_0001.rad");
  EXPECT_TRUE(has(engine, "/RUN/roll/1/\n1\n"));
  EXPECT_FALSE(has(content_of(root_ / "roll.k"), "*CONTACT_"));
}

TEST_F(ExportCommand, LsDynaReadsOneFile) {
  ASSERT_EQ(export_tyre("dyna.k", "--preload --for ls-dyna"), 0) << errors();
  const std::string deck = content_of(root_ / "dyna.k");
  for (const char* keyword : {"*INITIAL_STRESS_SOLID\n", "*INITIAL_VELOCITY_NODE\n", "*CONTACT_AUTOMATIC"})
    EXPECT_TRUE(has(deck, keyword)) << keyword;
  EXPECT_FALSE(fs::exists(root_ / "dyna_0000.rad"));
}

TEST_F(ExportCommand, WithoutAPreloadThereIsTheDeckAlone) {
  ASSERT_EQ(export_tyre("rest.k", ""), 0) << errors();
  EXPECT_TRUE(has(output(), "undeformed and just touch;")) << output();
  EXPECT_FALSE(fs::exists(root_ / "rest_0000.rad"));
  EXPECT_FALSE(has(content_of(root_ / "rest.k"), "*INITIAL_STRESS_SOLID"));
}

TEST_F(ExportCommand, AnOverlapWithoutAPreloadIsNamed) {
  ASSERT_EQ(export_tyre("deep.k", "--overlap \"5 um\""), 0) << errors();
  EXPECT_TRUE(has(output(), "undeformed and overlap by 5 um;")) << output();
}

TEST_F(ExportCommand, WrongChoicesAreRefused) {
  EXPECT_EQ(export_tyre("no.k", "--preload --ramp \"1 ms\""), 2);
  EXPECT_TRUE(has(errors(), "leave one out")) << errors();
  EXPECT_EQ(export_tyre("no.k", "--overlap \"3 kg\""), 2);
  EXPECT_TRUE(has(errors(), "--overlap")) << errors();
  for (const char* wrong : {"5 m", "-20 um"}) {
    EXPECT_EQ(export_tyre("no.k", fmt::format("--overlap=\"{}\"", wrong)), 2);
    EXPECT_TRUE(has(errors(), "lies between 0 and 1 mm")) << errors();
  }
  EXPECT_EQ(export_tyre("no.k", "--preload --for ls-dyna --overlap \"5 um\""), 2);
  EXPECT_TRUE(has(errors(), "state --for openradioss")) << errors();
  EXPECT_FALSE(fs::exists(root_ / "no.k"));
  EXPECT_EQ(export_tyre("/dev/stdout", "--preload"), 2);
  EXPECT_TRUE(has(errors(), "name a file, or state --for ls-dyna")) << errors();
  EXPECT_EQ(output(), "");
}

}  // namespace
}  // namespace tread
