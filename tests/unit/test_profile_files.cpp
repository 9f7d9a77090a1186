// Files of wheel and rail profiles: one shape written in every format, with the disorder of measured files.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "core/millimetre.hpp"
#include "io/profiles/column_profile.hpp"
#include "io/scene/profile_file.hpp"

namespace tread {
namespace {

struct Points {
  std::vector<double> y, z;  // [mm]
};

/// Points of a built-in profile about every 0.4 mm, without its upright ends.
Points sampled(const PlaneCurve& curve, double from, double to) {
  Points points;
  const double first = curve.at_x(from * mm), last = curve.at_x(to * mm);
  const int count = static_cast<int>(std::ceil((last - first) / (0.4 * mm)));
  for (int i = 0; i <= count; ++i) {
    const Point2 p = curve.at(first + (last - first) * i / count).position;
    points.y.push_back(p.x / mm);
    points.z.push_back(p.y / mm);
  }
  return points;
}

Points wheel() {
  return sampled(built_in_wheel("S1002").surface, -69.5, 60);
}
/// A head worn on its gauge side, so that left and right differ.
Points rail() {
  Points points = sampled(built_in_rail("60E1").running, -35.5, 35.5);
  for (std::size_t i = 0; i < points.y.size(); ++i)
    points.z[i] -= 0.4 * std::exp(-std::pow((points.y[i] + 15) / 8, 2));
  return points;
}

Points changed(Points points, double y_factor, double y_shift, double z_factor) {
  for (double& y : points.y) y = y_factor * y + y_shift;
  for (double& z : points.z) z *= z_factor;
  return points;
}
Points reversed(Points points) {
  std::reverse(points.y.begin(), points.y.end());
  std::reverse(points.z.begin(), points.z.end());
  return points;
}

std::string rows(const Points& points, const char* more = "") {
  std::string text;
  for (std::size_t i = 0; i < points.y.size(); ++i)
    text += fmt::format("{:.7f}\t{:.7f}{}\n", points.y[i], points.z[i], more);
  return text;
}

std::string simpack(const Points& points, int type, const std::string& keys) {
  return fmt::format(
      "! a profile\nheader.begin\n  version = 1\n  type = {} ! 0 rail\nheader.end\n"
      "spline.begin\n  comment = 'not a ! comment'\n{}  point.begin\n{}  point.end\nspline.end\n",
      type, keys, rows(points, "  1.0"));
}

UnderstoodProfile understood(const std::string& text, const std::string& name, const ProfileWish& wish,
                             ColumnAxes axes = ColumnAxes::any) {
  std::vector<Problem> problems;
  UnderstoodProfile profile = profile_of(text, name, wish, axes, problems);
  for (const Problem& problem : problems) ADD_FAILURE() << describe(problem);
  return profile;
}

/// Largest distance of the understood profile's points from the piecewise straight line through `expected`.
double error_of(const UnderstoodProfile& profile, const Points& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < profile.y.size(); ++i) {
    const double y = profile.y[i] / mm, z = profile.z[i] / mm;
    double nearest = 1e9;
    for (std::size_t k = 0; k < expected.y.size(); ++k)
      nearest = std::min(nearest, std::hypot(y - expected.y[k], z - expected.z[k]));
    worst = std::max(worst, nearest);
  }
  return worst;
}

const ProfileWish kWheel{.wheel = true};
const ProfileWish kRail{};

TEST(ProfileFiles, WheelInEveryFormatIsTheSame) {
  const Points exact = wheel();
  const struct {
    const char* name;
    std::string text;
    bool reversed, mirrored, z_turned;
    double from_back;
  } files[] = {
      {"w.prw", simpack(changed(exact, -1, 0, 1), 1, "  mirror.y = 1\n  units.len.f = 1000.\n"), false, false,
       false, 0},
      {"w.prw", simpack(reversed(changed(exact, 1e-3, 0, 1e-3)), 1, "  units.len.f = 1\n"), true, false,
       false, 0},
      {"w.txt", simpack(changed(exact, 1, 0, -1), 1, ""), false, false, true, 0},
      {"w.whl",
       "ProgramName=x\nXYPoints=100\nXOffset=0.5\nYoffset=0\nColumnDef=X,Y,A\nSide=L\n\n\" 1 1 comment\n" +
           rows(changed(exact, 1, 69.5, 1), " 0.1"),
       false, false, false, 70},
      {"w.WHL",
       "MINIPROF 101\nold.prd\n32.6 28 10.8 (Sd/Sh/qR)\n\n" + rows(reversed(changed(exact, 1, 70, 1))), true,
       false, false, 70},
      {"w.txt", "a wheel in millimetres, right\n" + rows(changed(exact, -1, 0, -1)), true, true, true, 0},
      {"w.txt", rows(changed(exact, 1, 70, 1)), false, false, false, 70},
      {"w.txt", "# y [m]  z [m]\n" + rows(reversed(changed(exact, -1e-3, 0, 1e-3))), false, true, false, 0},
  };
  for (const auto& file : files) {
    SCOPED_TRACE(file.text.substr(0, 60));
    const UnderstoodProfile profile = understood(file.text, file.name, kWheel);
    EXPECT_LT(error_of(profile, exact), 1e-3);
    EXPECT_GT(profile.y.size(), exact.y.size() - 8);  // the flange's back is cut where it leans by 80 degrees
    EXPECT_EQ(profile.reversed, file.reversed);
    EXPECT_EQ(profile.mirrored, file.mirrored);
    EXPECT_EQ(profile.z_turned, file.z_turned);
    EXPECT_NEAR(profile.from_back, file.from_back * mm, 1e-12);
    EXPECT_NEAR(profile.y.back(), 60 * mm, 2e-6);
  }
  EXPECT_EQ(understood(files[3].text, "w.whl", kWheel).side, "L");
  EXPECT_EQ(understood(files[5].text, "w.txt", kWheel).side, "right");
}

TEST(ProfileFiles, RailInEveryFormatIsTheSame) {
  const Points exact = rail();
  const ProfileWish mirrored{.mirrored = true};
  const ProfileWish shifted{.shift = 7 * mm};
  const struct {
    const char* name;
    std::string text;
    const ProfileWish& wish;
  } files[] = {
      {"r.prr", simpack(changed(exact, 1, 0, -1), 0, ""), kRail},
      {"r.prr", simpack(changed(exact, 1, -3, 1), 0, "  shift.y = 3\n  mirror.z = 1\n"), kRail},
      {"r.prr", simpack(changed(exact, -1, 0, -1), 0, ""), mirrored},
      {"r.ban", "MPTypeNo=299\nColumnDef=Y,X\n\n" + rows({exact.z, exact.y}), kRail},
      {"r.ban", "MPTypeNo=299\n\n" + rows(reversed(changed(exact, 1, -7, -1))), shifted},
      {"r.rai", "a rail [mm]\n  12\n" + rows(exact, " 0 0"), kRail},
      {"r.txt", "60E1 worn, mm\nmeasured in depot\n" + rows(exact), kRail},
      {"r.txt", "60 E1 new\n" + rows(exact), kRail},
      {"r.txt", "a rail\n2024 rail 3\n" + rows(exact), kRail},
      {"r.txt", rows(reversed(changed(exact, 1, 0, -1))), kRail},
  };
  for (const auto& file : files) {
    SCOPED_TRACE(file.text.substr(0, 60));
    const UnderstoodProfile profile = understood(file.text, file.name, file.wish);
    EXPECT_LT(error_of(profile, exact), 1e-4);
    EXPECT_GT(profile.y.size(), exact.y.size() - 10);
    EXPECT_TRUE(std::is_sorted(profile.y.begin(), profile.y.end()));
  }
}

TEST(ProfileFiles, HeadersTellWhatIsNotApplied) {
  const std::string header = "MPTypeNo=299\nTilt=2.86\nBaseTilt=0\nRail=Right\n\n";
  const auto reading = [&](bool mirrored) {
    return reading_of(understood(header + rows(rail()), "r.ban", {.mirrored = mirrored}));
  };
  EXPECT_TRUE(reading(false).ends_with(
      "Tilt = 2.86 of the header not applied, a right rail may need rail.profile_mirrored = true"))
      << reading(false);
  EXPECT_TRUE(reading(true).ends_with("Tilt = 2.86 of the header not applied")) << reading(true);
}

TEST(ProfileFiles, DuplicatesSpikesFoldsAndSidesAreRemoved) {
  const Points exact = rail();
  Points rough = exact;
  const auto insert = [&](std::size_t at, double y, double z) {
    rough.y.insert(rough.y.begin() + static_cast<std::ptrdiff_t>(at), y);
    rough.z.insert(rough.z.begin() + static_cast<std::ptrdiff_t>(at), z);
  };
  insert(120, rough.y[119], rough.z[119]);
  insert(90, rough.y[89], rough.z[89]);
  rough.z[60] += 1.5;
  rough.z[130] -= 0.9;
  // The sides go on below the head and turn under it.
  for (const double depth : {20.0, 25.0, 30.0, 35.0}) {
    rough.y.insert(rough.y.begin(), -36 - depth / 50);
    rough.z.insert(rough.z.begin(), -depth);
    rough.y.push_back(36 + depth / 50);
    rough.z.push_back(-depth);
  }
  rough.y.push_back(30);
  rough.z.push_back(-37);
  const UnderstoodProfile profile = understood(rows(rough), "r.txt", kRail);
  EXPECT_EQ(profile.duplicates, 2);
  EXPECT_EQ(profile.spikes, 2);
  EXPECT_GE(profile.folded + profile.cut, 5);
  EXPECT_LT(error_of(profile, exact), 1e-6);
  const std::string reading = reading_of(profile);
  EXPECT_NE(reading.find("removed: 2 duplicates, 2 spikes, "), std::string::npos) << reading;
}

TEST(ProfileFiles, SmoothingKeepsTheStatedDeviation) {
  const Points exact = rail();
  Points noisy = exact;
  for (std::size_t i = 0; i < noisy.z.size(); ++i)
    noisy.z[i] += 0.01 * std::sin(2.4 * static_cast<double>(i * i));
  const auto roughness = [](const UnderstoodProfile& p) {
    double sum = 0;
    for (std::size_t i = 2; i < p.y.size(); ++i)
      if (std::abs(p.y[i]) < 20 * mm)
        sum += std::abs((p.z[i] - p.z[i - 1]) / (p.y[i] - p.y[i - 1]) -
                        (p.z[i - 1] - p.z[i - 2]) / (p.y[i - 1] - p.y[i - 2]));
    return sum;
  };
  const UnderstoodProfile raw = understood(rows(noisy), "r.txt", kRail);
  for (const double largest : {5e-6, 20e-6}) {
    const UnderstoodProfile profile = understood(rows(noisy), "r.txt", {.smoothing = largest});
    EXPECT_LE(profile.largest_deviation(), largest);
    EXPECT_GT(profile.largest_deviation(), 0.98 * largest);
    for (std::size_t i = 0; i < profile.y.size(); ++i)
      EXPECT_NEAR(std::hypot(profile.y[i] - profile.raw_y[i], profile.z[i] - profile.raw_z[i]),
                  profile.deviation[i], 1e-12);
    EXPECT_LT(roughness(profile), (largest > 1e-5 ? 0.3 : 0.8) * roughness(raw));
  }
  // A circle stays one: its spline deviates by less than the noise.
  const UnderstoodProfile smooth = understood(rows(noisy), "r.txt", {.smoothing = 20e-6});
  double worst = 0;
  for (std::size_t i = 20; i + 20 < smooth.y.size(); ++i)
    worst = std::max(worst, std::abs(smooth.z[i] / mm - exact.z[i]));
  EXPECT_LT(worst, 0.02);
}

TEST(ProfileFiles, BrokenOnesAreRefusedWithPlaceAndReason) {
  const std::string w = rows(wheel()), r = rows(rail());
  const std::string head = "header.begin\ntype = 1\nheader.end\nspline.begin\n";
  const struct {
    const char* name;
    std::string text;
    bool wheel;
    const char* message;
  } files[] = {
      {"a.prw", head + w, true, "a.prw:5: \"-69.5"},
      {"a.prw", head, true, "a.prw: there is no line point.begin"},
      {"a.prw", head + "point.begin\n" + w, true, "a.prw: there is no line point.end: is the file cut off?"},
      {"a.prw", head + "point.begin\n1 x\npoint.end\n", true,
       "a.prw:6: \"1 x\": expected y and z and perhaps a weight"},
      {"a.prw", head + "point.begin\n1 2 3 4\npoint.end\n", true, "a.prw:6: \"1 2 3 4\": expected y and z"},
      {"a.prw", head + "units.len.f = mm\npoint.begin\n" + w + "point.end\n", true,
       "a.prw:5: units.len.f = mm: expected a number"},
      {"a.prw", head + "shift.y = 0,5\npoint.begin\n" + w + "point.end\n", true,
       "a.prw:5: \"shift.y = 0,5\": a comma separates columns: write decimal points, not commas"},
      {"a.prw", head + "point.begin\n-35,120 -9,874\npoint.end\n", true,
       "a.prw:6: \"-35,120 -9,874\": a comma separates columns: write decimal points, not commas"},
      {"a.prw", head + "units.len.f = 0\npoint.begin\n" + w + "point.end\n", true,
       "a.prw:5: units.len.f = 0: expected the number of units in a metre, 1000 for mm"},
      {"a.prw", head + "rotate = 0.02\npoint.begin\n" + w + "point.end\n", true,
       "a.prw: rotate = 0.02: a rotation in the file is not read; set it to 0 and state rail.inclination"},
      {"a.prr", head + "point.begin\n" + w + "point.end\n", false,
       "a.prr: the file says that it holds a wheel, and a rail is wanted"},
      {"a.prw", head + "units.len.f = 1\npoint.begin\n" + w + "point.end\n", true,
       "a.prw: the points are 1.295e+05 mm wide; a whole wheel profile has 90 to 200 mm: are the units m "
       "right?"},
      {"a.whl", "ColumnDef=A,C\n\n" + w, true, "a.whl:1: ColumnDef=A,C: expected the columns X and Y"},
      {"a.whl", "XYPoints=9999\n\n" + w, true,
       "a.whl: the header announces 9999 points (XYPoints), the file holds "},
      {"a.whl", "Stock=x\n\n1 2\n3\n", true,
       "a.whl:4: \"3\": expected a row of numbers, X in column 1 and Y in column 2"},
      {"a.whl", "Stock=x\n\n" + r, true,
       "a.whl: the points are 71 mm wide; a whole wheel profile has 90 to 200 mm"},
      {"a.whl", "Stock=x\n\n" + rows(changed(wheel(), 1, 1000, 1)), true,
       " points beyond the surface are cut, the others are "},
      {"a.whl", "Stock=x\n\n" + rows(changed(rail(), 2, 0, 1)), true,
       "a.whl: no flange of 15 mm or more is found: is it a whole wheel?"},
      {"a.ban", "Xoffset=left\n\n" + r, false, "a.ban:1: Xoffset=left: expected a number"},
      {"a.ban", "Xoffset=0,5\n\n" + r, false,
       "a.ban:1: \"Xoffset=0,5\": a comma separates columns: write decimal points, not commas"},
      {"a.ban", "XYPoints=1\n\n-35,120\t-9,874\n", false,
       "a.ban:3: \"-35,120\t-9,874\": a comma separates columns: write decimal points, not commas"},
      {"a.ban", "MPTypeNo=299\n\n1 2\n2 3\n", false, "a.ban: 2 points: a profile needs at least 10"},
      {"a.ban", "Rail=L\n\n" + rows(changed(rail(), 1, 0, 1e-4)), false,
       "a.ban: the middle lies 0.0011 mm from the line between the ends: is it a whole rail head?"},
      {"a.csv", "y;z\n-35;-9,9\n-34;-7,5\n", false,
       "a.csv:2: \"-35;-9,9\": a comma separates columns: write decimal points, not commas"},
      {"a.rai", "a rail\n500\n" + r, false, "a.rai: the header announces 500 rows, the file holds "},
      {"a.rai", "a rail\n" + r + "end\n", false,
       ": \"end\": expected a row of 2 numbers as the first row has"},
      {"a.txt", "0 0\n1 1\n2 x\n", false, "a.txt:3: \"x\" is not a number"},
      {"a.txt", "12.5 abc\n" + r, false, "a.txt:1: \"abc\" is not a number"},
      {"a.csv", "12;nan\n" + r, false, "a.csv:1: "},
  };
  for (const auto& file : files) {
    SCOPED_TRACE(file.message);
    std::string answer;
    try {
      std::vector<Problem> problems;
      profile_of(file.text, file.name, {.wheel = file.wheel}, ColumnAxes::any, problems);
      if (!problems.empty()) answer = describe(problems.front());
    } catch (const InputError& error) {
      answer = error.what();
    }
    EXPECT_NE(answer.find(file.message), std::string::npos) << answer;
  }
}

/// Rows without two numbers are faults behind a header, too; a title may begin with a number.
TEST(ProfileFiles, BrokenRowsBehindAHeaderAreNoHeader) {
  const std::string header = "y,z\n60 E1 new\n2024 rail 3\nNancy 5\n-nan-\n12\n45;\n60, worn rail\n1, new\n";
  const char* broken[] = {"nan,nan", "5,nan", "nan 5", "12;;abc", "5, -inf;", "+3 1e999"};
  std::string text = header;
  for (const char* row : broken) text += std::string(row) + "\n";
  std::vector<LineFault> faults;
  read_column_profile(text + rows(rail()), faults);
  ASSERT_EQ(faults.size(), std::size(broken));
  for (std::size_t i = 0; i < faults.size(); ++i) {
    EXPECT_EQ(faults[i].line, 10 + static_cast<int>(i));
    EXPECT_EQ(faults[i].message,
              fmt::format("\"{}\": expected a row of numbers, y and z; a comment begins with #", broken[i]));
  }
  faults.clear();
  EXPECT_EQ(read_column_profile(header + rows(rail()), faults).y.size(), rail().y.size());
  EXPECT_TRUE(faults.empty());
}

/// No double holds such a number of rows.
TEST(ProfileFiles, AFirstLineOfFourHundredDigitsIsAHeader) {
  std::vector<LineFault> faults;
  const FilePoints points = read_column_profile(std::string(400, '9') + "\n" + rows(rail()), faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(points.y.size(), rail().y.size());
}

}  // namespace
}  // namespace tread
