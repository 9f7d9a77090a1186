#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "io/text/json_reader.hpp"
#include "io/text/json_writer.hpp"

namespace tread {
namespace {

std::string json_of(double number) {
  return JsonWriter().value(number).text();
}
std::string json_of(const char* text) {
  return JsonWriter().value(text).text();
}

TEST(Json, NestsObjectsAndArrays) {
  JsonWriter json;
  json.begin_object().member("steps", 449438).member("title", "D").member("converged", true);
  json.key("vertical_force_N").begin_object().member("mean", 87.5e3).key("list").begin_array().value(1);
  json.null().end_array().end_object().key("empty").begin_array().end_array().end_object();
  EXPECT_EQ(json.text(), R"({
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
}

TEST(Json, NumbersReadBackToTheSameBits) {
  for (const double number : {0.1, 1.0 / 3, 8.9e-8, -0.0, 5e-324, std::numeric_limits<double>::max(), 1e22}) {
    const double back = std::strtod(json_of(number).c_str(), nullptr);
    EXPECT_EQ(back, number);
    EXPECT_EQ(std::signbit(back), std::signbit(number));
  }
  EXPECT_EQ(json_of(0.1), "0.1\n");
}

TEST(Json, NumbersThatAreNotFiniteBecomeNull) {
  EXPECT_EQ(json_of(std::nan("")), "null\n");
  EXPECT_EQ(json_of(-std::numeric_limits<double>::infinity()), "null\n");
}

TEST(Json, EscapesText) {
  EXPECT_EQ(json_of("a\"b\\c\nd\te\x01"), "\"a\\\"b\\\\c\\nd\\te\\u0001\"\n");
  EXPECT_EQ(json_of("\xc2\xb5m \xe2\x89\xa4 \xf0\x9f\x9a\x86"),
            "\"\xc2\xb5m \xe2\x89\xa4 \xf0\x9f\x9a\x86\"\n");
}

TEST(Json, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(json_of("K\xf6ln"), "\"K\\ufffdln\"\n");
  EXPECT_EQ(json_of("\xc0\xaf"), "\"\\ufffd\\ufffd\"\n");             // overlong
  EXPECT_EQ(json_of("\xed\xa0\x80"), "\"\\ufffd\\ufffd\\ufffd\"\n");  // surrogate
  EXPECT_EQ(json_of("end\xe2\x89"), "\"end\\ufffd\\ufffd\"\n");       // cut short
}

TEST(Json, TextsReadBackAsTheyWereWritten) {
  const std::string text = "a\r\n\t\b\f\x01\"\\ \u00e9 \u20ac \U0001f682";
  JsonWriter json;
  json.begin_object().member("text", std::string_view(text)).member("broken", std::string_view("\xff"));
  const auto read = parse_json(json.end_object().text(), JsonShape::flat);
  ASSERT_TRUE(read);
  EXPECT_EQ(text_in(*read, "text"), text);
  EXPECT_EQ(text_in(*read, "broken"), "\ufffd");
  for (const char* wrong : {R"({"a": "\u12"})", R"({"a": "\u12g4"})", R"({"a": "\ud83d"})", R"({"a": "\q"})"})
    EXPECT_FALSE(parse_json(wrong, JsonShape::flat)) << wrong;
}

TEST(Json, RefusesCallsOutOfOrder) {
  EXPECT_THROW(JsonWriter().begin_object().value(1), std::logic_error);
  EXPECT_THROW(JsonWriter().begin_array().key("k"), std::logic_error);
  EXPECT_THROW(JsonWriter().begin_object().key("k").end_object(), std::logic_error);
  EXPECT_THROW(JsonWriter().begin_object().end_array(), std::logic_error);
  EXPECT_THROW(JsonWriter().value(1).value(2), std::logic_error);
  EXPECT_THROW((void)JsonWriter().begin_object().text(), std::logic_error);
}

}  // namespace
}  // namespace tread
