#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/scene/schema.hpp"
#include "io/text/units.hpp"
#include "tests/refusal.hpp"

namespace tread {
namespace {

struct Reading {
  const char* text;
  const Quantity& quantity;
  double si;
};

TEST(Units, QuantitiesAreExactlyTheirLiteralsInSi) {
  const std::vector<Reading> readings{
      {"15.2 m", kLength, 15.2},
      {"0.14 mm", kLength, 0.14e-3},
      {"1.1mm", kLength, 1.1e-3},
      {"  3 cm ", kLength, 3e-2},
      {"2.5e2 um", kLength, 250e-6},
      {"2 µm", kLength, 2e-6},
      {"+4 nm", kLength, 4e-9},
      {"-1.5 km", kLength, -1.5e3},
      {"1e-8 s", kTime, 1e-8},
      {"5 ms", kTime, 5e-3},
      {"2 min", kTime, 120},
      {"0.5 h", kTime, 1800},
      {"300 km/h", kSpeed, 300e3 / 3600},
      {"9.81 m/s2", kAcceleration, 9.81},
      {"9.81 m s^-2", kAcceleration, 9.81},
      {"9.81 m/s²", kAcceleration, 9.81},
      {"8000 kg", kMass, 8000},
      {"8 t", kMass, 8000},
      {"7790 kg/m3", kDensity, 7790},
      {"7.79 g/cm3", kDensity, 7790},
      {"7.79 t/m^3", kDensity, 7790},
      {"87.564 kN", kForce, 87564},
      {"22 MN/m", kStiffness, 22e6},
      {"22 kN/mm", kStiffness, 22e6},
      {"200 kN s/m", kViscousDamping, 200e3},
      {"200 kN*s/m", kViscousDamping, 200e3},
      {"200 kN·s/m", kViscousDamping, 200e3},
      {"13.8 kN m", kTorque, 13.8e3},
      {"205.9 GPa", kStress, 205.9e9},
      {"205900 N/mm2", kStress, 205.9e9},
      {"1000 Hz", kFrequency, 1000},
      {"1.5 kHz", kFrequency, 1500},
      {"2.5 GB", kData, 2.5e9},
      {"2.5e-9 kg/(N m)", kWear, 2.5e-9},
      {"2.5e-9 kg/(N*m)", kWear, 2.5e-9},
      {"2.5e-9 kg/(N·m)", kWear, 2.5e-9},
      {"2.5e-9 kg/J", kWear, 2.5e-9},
      {"2.5 ug/( N m )", kWear, 2.5e-9},
      {"2 N/(mm)^2", kStress, 2e6},
      {"3 kg/(m s)/s", kStress, 3},
  };
  for (const Reading& reading : readings) {
    EXPECT_EQ(parse_quantity(reading.text, reading.quantity), reading.si) << reading.text;
  }
}

struct Refusal {
  const char* text;
  const char* reason;
};

std::string length_error(const char* text) {
  return samples::refusal<InputError>([&] { parse_quantity(text, kLength); });
}

TEST(Units, RefusalsNameTheReasonAndAnExample) {
  const std::vector<Refusal> refusals{
      {"", "\"\" is not a number; expected a length, such as \"1 m\" (units: m, cm, mm, um, km)"},
      {"long", "\"long\" is not a number"},
      {"15.2", "\"15.2\" has no unit; expected a length, such as \"15.2 m\""},
      {"15.2 kg", "\"15.2 kg\" is a mass; expected a length"},
      {"3 m2", "is m^2 kg^0 s^0; expected a length"},
      {"3 m/m", "is a pure number; expected a length"},
      {"1 Pa", "\"1 Pa\" is a stress"},
      {"1 m/s2", "\"1 m/s2\" is an acceleration"},
      {"3 furlong", "unknown unit \"furlong\"; expected a length (units: m, cm, mm, um, km)"},
      {"3 (m", "unknown unit \"(m\""},
      {"3 m)", "unknown unit \"m)\""},
      {"3 m/()", "unknown unit \"m/()\""},
      {"3 m3/((m m))", "unknown unit"},
      {"3 MM", "unknown unit \"MM\""},
      {"3 m-m", "unknown unit \"m-m\""},
      {"3 m/", "unknown unit \"m/\""},
      {"3 m^", "the exponent must be an integer"},
      {"3 m0", "the exponent must be an integer"},
      {"1,5 m", "\"1,5 m\" has a decimal comma, not a point; write \"1.5 m\"; expected a length (units: m,"},
      {"1,5 kg", "\"1,5 kg\" has a decimal comma, not a point; expected a length (units: m,"},
      {"1,500 m", "\"1,500 m\" has a decimal comma, not a point; expected a length (units: m,"},
      {"1,5", "\"1,5\" has a decimal comma, not a point; expected a length (units: m,"},
      {"nan m", "not finite"},
      {"inf m", "not finite"},
      {"1e999 m", "too large or too small"},
      {"1e308 km", "too large or too small"},
      {"1 2 m", "unknown unit \"2 m\""},
  };
  for (const Refusal& refusal : refusals) {
    EXPECT_NE(length_error(refusal.text).find(refusal.reason), std::string::npos)
        << refusal.text << " -> " << length_error(refusal.text);
  }
}

/// Numbers with a unit in a text: "2.5e-9 kg/(N m)" of one that says that this is usual.
std::vector<std::string> quantities_in(const std::string& text) {
  static const std::regex kQuantity(R"((\d[\d.]*(e-?\d+)?) (([A-Za-z]+)([/*][A-Za-z]+\d?|/\([^)]*\)|\d)*))");
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), kQuantity), end; at != end; ++at) {
    try {
      parse_unit((*at)[4].str());
      found.push_back(at->str());
    } catch (const InputError&) {  // a word: "3 columns"
    }
  }
  return found;
}

TEST(Units, DescriptionsOfKeysHaveTheNotationThatIsRead) {
  int read = 0;
  for (const Key& key : scene_keys())
    for (const std::string& text : quantities_in(key.description)) {
      const std::string unit = text.substr(text.find(' '));
      EXPECT_NO_THROW(parse_unit(unit)) << key.path << ": " << text;
      ++read;
    }
  EXPECT_GT(read, 5);
  const std::vector<std::string> wear = quantities_in(find_key("wear.coefficient")->description);
  ASSERT_EQ(wear.size(), 1U);
  EXPECT_EQ(parse_quantity(wear.front(), kWear), 2.5e-9);
}

TEST(Units, RatiosAndNumbersAreStrict) {
  EXPECT_EQ(parse_ratio("1:40"), 1.0 / 40);
  EXPECT_EQ(parse_ratio("0.025"), 0.025);
  EXPECT_EQ(parse_number(" -1.5e3 "), -1500);
  for (const char* text : {"1:0", "1:", ":40", "1:2:3", "0x10", "1 2", "1.2.3", "--1", "+-1", "1e", "inf"}) {
    EXPECT_THROW(parse_ratio(text), InputError) << text;
  }
  for (const char* text : {"1/0", "1/2/3", "a/b", "/", "1/2:3"})
    EXPECT_THROW(parse_ratio(text), InputError) << text;
  EXPECT_EQ(samples::refusal<InputError>([] { parse_ratio("1/40"); }),
            "\"1/40\" is not a number; write 1:40 or 0.025");
}

TEST(Units, FormatShowsTheUnitAskedFor) {
  EXPECT_EQ(format_quantity(300 / 3.6, "km/h"), "300 km/h");
  EXPECT_EQ(format_quantity(0.14e-3, "mm"), "0.14 mm");
  EXPECT_EQ(format_quantity(205.9e9, "GPa"), "205.9 GPa");
}

}  // namespace
}  // namespace tread
