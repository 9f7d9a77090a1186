#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/text/json.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

JsonRecord parsed(const std::string& text) {
  return parse_json(text, "text");
}

TEST(Json, NestsObjectsAndArrays) {
  Json json = {{"steps", 449438}, {"title", "D"}, {"converged", true}};
  json["vertical_force_N"] = {{"mean", 87.5e3}, {"list", {1, nullptr}}};
  json["empty"] = Json::array();
  EXPECT_EQ(json_text(json), R"({
  "steps": 449438,
  "title": "D",
  "converged": true,
  "vertical_force_N": {
    "mean": 87500,
    "list": [
      1,
      null
    ]
  },
  "empty": []
}
)");
  EXPECT_EQ(json_line(json),
            R"({"steps": 449438, "title": "D", "converged": true, "vertical_force_N": {"mean": 87500, )"
            R"("list": [1, null]}, "empty": []})"
            "\n");
}

TEST(Json, NumbersReadBackToTheSameBits) {
  for (const double number :
       {0.1, 1.0 / 3, 8.9e-8, -0.0, 5e-324, std::numeric_limits<double>::max(), 1e22, 9.5e-3}) {
    const std::string text = json_line(number);
    const double back = std::strtod(text.c_str(), nullptr);
    EXPECT_EQ(back, number);
    EXPECT_EQ(std::signbit(back), std::signbit(number));
    EXPECT_EQ(number_in(parsed("{\"n\": " + text + "}"), "n"), number);
  }
  EXPECT_EQ(json_line(0.1), "0.1\n");
  EXPECT_EQ(json_line(63613.0), "63613\n");
  EXPECT_EQ(json_line(9007199254740993), "9007199254740993\n");
}

/// Halfway cases of the shortest form: 5e-324 has one digit, 2^-44 needs seventeen of the decimal expansion.
TEST(Json, NumbersHaveTheirShortestForm) {
  EXPECT_EQ(json_line(5e-324), "5e-324\n");
  EXPECT_EQ(json_line(2.0 / 3), "0.6666666666666666\n");
  EXPECT_EQ(json_line(1e-7), "1e-07\n");
}

TEST(Json, NumbersThatAreNotFiniteBecomeNull) {
  EXPECT_EQ(json_line(std::nan("")), "null\n");
  EXPECT_EQ(json_line(-std::numeric_limits<double>::infinity()), "null\n");
  EXPECT_EQ(json_line(number_or_null(std::nullopt)), "null\n");
  EXPECT_EQ(json_line(number_or_null(0.5)), "0.5\n");
}

TEST(Json, EscapesText) {
  EXPECT_EQ(json_line("a\"b\\c\nd\te\x01"), "\"a\\\"b\\\\c\\nd\\te\\u0001\"\n");
  EXPECT_EQ(json_line("\xc2\xb5m \xe2\x89\xa4 \xf0\x9f\x9a\x86"),
            "\"\xc2\xb5m \xe2\x89\xa4 \xf0\x9f\x9a\x86\"\n");
}

TEST(Json, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(json_line("K\xf6ln"), "\"K\ufffdln\"\n");
  EXPECT_EQ(json_line("\xc0\xaf"), "\"\ufffd\ufffd\"\n");            // overlong
  EXPECT_EQ(json_line("\xed\xa0\x80"), "\"\ufffd\ufffd\ufffd\"\n");  // surrogate
  EXPECT_EQ(json_line("end\xe2\x89"), "\"end\ufffd\"\n");            // cut short
  EXPECT_EQ(json_line({{"K\xf6ln", 1}}), "{\"K\ufffdln\": 1}\n");
}

TEST(Json, TextsReadBackAsTheyWereWritten) {
  const std::string text = "a\r\n\t\b\f\x01\"\\ \u00e9 \u20ac \U0001f682";
  const JsonRecord read = parsed(json_text({{"text", text}, {"broken", "\xff"}}));
  EXPECT_EQ(text_in(read, "text"), text);
  EXPECT_EQ(text_in(read, "broken"), "\ufffd");
  for (const char* wrong : {R"({"a": "\u12"})", R"({"a": "\u12g4"})", R"({"a": "\ud83d"})", R"({"a": "\q"})"})
    EXPECT_THROW(parsed(wrong), InputError) << wrong;
}

TEST(Json, RecordsNameWhatLiesDeeperByItsPath) {
  const JsonRecord record =
      parsed(R"({"a": {"b.c": [1, {"d": "x"}], "e": null}, "f": true, "g": [], "a": 2})");
  EXPECT_EQ(record.size(), 2U);  // the last of two members with one name counts
  EXPECT_EQ(number_in(record, "a"), 2);
  EXPECT_TRUE(truth_in(record, "f"));
  const JsonRecord deep = parsed(R"({"a": {"b.c": [1, {"d": "x"}], "e": null}})");
  EXPECT_EQ(number_in(deep, "a.b.c.0"), 1);
  EXPECT_EQ(text_in(deep, "a.b.c.1.d"), "x");
  EXPECT_EQ(deep.size(), 2U);
  EXPECT_EQ(number_in(deep, "a.b.c.1.d"), std::nullopt);
  EXPECT_EQ(text_in(deep, "a.b.c.0"), "");
}

TEST(Json, BrokenTextsAreRefusedWithPlaceAndReason) {
  const auto message = [](const std::string& text) {
    return samples::refusal<InputError>([&] { parse_json(text, "summary.json"); });
  };
  EXPECT_EQ(message("[1]"), "summary.json: no JSON object: it is a JSON array");
  EXPECT_NE(message("{\n\"a\": nul}").find("summary.json: no JSON object: parse error at line 2, column 9"),
            std::string::npos)
      << message("{\n\"a\": nul}");
  for (const char* wrong : {"", "{", "{}}", "{\"a\": nan}", "{\"a\": 1e999}", "{\"a\": 01}", "{\"a\": 1,}"})
    EXPECT_NE(message(wrong), "") << wrong;
  EXPECT_NE(message("{\"a\": " + std::string(1 << 20, '[') + std::string(1 << 20, ']') + "}")
                .find("nested more than 32 deep"),
            std::string::npos);
}

TEST(Json, FilesAreRefusedWithTheirPath) {
  const samples::TemporaryFolder folder;
  const std::filesystem::path path = folder.path / "summary.json";
  std::ofstream(path) << "{\"a\": 1";
  const std::string message = samples::refusal<InputError>([&] { read_json(path); });
  EXPECT_TRUE(message.starts_with(path.string() + ": no JSON object: ")) << message;
  samples::expect_part(message, "`tread run` writes the file anew");
}

}  // namespace
}  // namespace tread
