#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/report/markup.hpp"
#include "io/report/report.hpp"
#include "io/report/thinning.hpp"

namespace tread {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Chart, ThinningKeepsEveryPeak) {
  std::vector<double> values(449438, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(1e-4 * static_cast<double>(i));
  values[123456] = 193.19;
  values[123457] = -3.02;
  const std::vector<std::size_t> kept = thinned(values, 1000);
  EXPECT_LE(kept.size(), 2002U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), values.size() - 1);
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 123456U));
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 123457U));
}

TEST(Chart, ThinningKeepsGaps) {
  std::vector<double> values(5000, 1.0);
  values[2500] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> kept = thinned(values, 100);
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 2500U));
}

TEST(Chart, ShortSeriesAreNotThinned) {
  EXPECT_EQ(thinned(std::vector<double>(200), 100).size(), 200U);
}

TEST(Chart, TicksAreRound) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(-0.5, 1.2, 4), (std::vector<double>{-0.5, 0, 0.5, 1}));
  const std::vector<double> odd = ticks(2.31, 2.97, 7);
  EXPECT_NEAR(odd.front(), 2.4, 1e-12);
  EXPECT_NEAR(odd.back(), 2.9, 1e-12);
}

TEST(Chart, ValuesThatDifferByRoundingHaveOneTick) {
  for (const double value : {0.3, 83.3, -8340.0, 1e5})
    EXPECT_EQ(ticks(value, std::nextafter(value, 1e9), 7), std::vector<double>{value});
}

Figure one_curve(std::vector<double> x, std::vector<double> y) {
  Figure figure;
  figure.title = "F_N < 200 kN";
  figure.panels = {{"Force [kN]", {{"F_N", std::move(x), std::move(y)}}, {}, 200, std::nullopt}};
  return figure;
}

TEST(Chart, CurveLandsOnThePageGeometry) {
  const std::string html = figure_html(one_curve({0, 1, 2}, {0, 100, 50}));
  // Left and right edges of the plot, its bottom (0) and its top (100).
  EXPECT_NE(html.find("d=\"M72.00 218.00L489.00 18.00L906.00 118.00\""), std::string::npos) << html;
  EXPECT_NE(html.find("F<sub>N</sub> &lt; 200 kN"), std::string::npos);
}

/// chart.js writes the curves as CSV under these names; values there have no factor.
TEST(Chart, CurvesAndAxesCarryTheirNames) {
  Figure figure = one_curve({0, 1e-3}, {0, 2e6});
  figure.x_label = "Time \"t\" [s]";
  const std::string html = figure_html(figure);
  EXPECT_EQ(count(html, " × 10"), 2U) << html;
  EXPECT_EQ(count(html, "data-name=\"F_N\""), 1U) << html;
  EXPECT_EQ(count(html, "data-label=\"Force [kN]\""), 1U) << html;
  EXPECT_EQ(count(html, "data-label=\"Time &quot;t&quot; [s]\""), 1U) << html;
}

TEST(Chart, ValuesThatAreNotFiniteBreakTheLine) {
  const std::string html = figure_html(one_curve({0, 1, 2, 3, 4}, {0, 1, std::nan(""), 1, 0}));
  const std::size_t path = html.rfind("<path class=\"curve c0 solid\"");
  EXPECT_EQ(count(html.substr(path, html.find("/>", path) - path), "M"), 2U);
  EXPECT_EQ(count(html, "nan"), 0U);
}

/// Widened to whole ticks, the range needs larger steps.
TEST(Chart, AWidenedRangeHasTicksOfOneStep) {
  Figure figure = one_curve({0, 1}, {-0.299, 0.3});
  figure.panels.front().height = 150;
  const std::string html = figure_html(figure);
  EXPECT_EQ(count(html, "class=\"tick right\""), 3U) << html;
  EXPECT_EQ(count(html, "data-low=\"-0.5\" data-high=\"0.5\""), 1U) << html;
}

TEST(Chart, PicturesHaveKeysOfLabelledLevels) {
  Figure figure = one_curve({0, 1}, {0, 1});
  figure.panels.front().levels = {{0.5, "static"}, {0.7, ""}};
  const std::string svg = figure_svg(figure);
  EXPECT_EQ(count(svg, "<path class=\"level\""), 1U) << svg;
  EXPECT_EQ(count(svg, ">static</text>"), 1U) << svg;
}

TEST(Chart, LonePointsAreDots) {
  EXPECT_EQ(count(figure_html(one_curve({1}, {3})), "h0\""), 1U);
  EXPECT_EQ(count(figure_html(one_curve({0, 1, 2}, {0, std::nan(""), 1})), "h0"), 2U);
  EXPECT_EQ(count(figure_html(one_curve({0, 1}, {0, 1})), "h0"), 0U);
}

TEST(Chart, EmptyAndConstantCurvesAreDrawn) {
  EXPECT_EQ(count(figure_html(one_curve({}, {})), "nan"), 0U);
  EXPECT_EQ(count(figure_html(one_curve({1}, {3e6})), "nan"), 0U);
  EXPECT_EQ(count(figure_html(Figure{}), "nan"), 0U);
  EXPECT_THROW(figure_html(one_curve({1, 2}, {1})), std::logic_error);
}

TEST(Markup, NumbersAreReadable) {
  EXPECT_EQ(readable(193.19), "193.2");
  EXPECT_EQ(readable(3.02), "3.02");
  EXPECT_EQ(readable(999.96), "1000");
  EXPECT_EQ(readable(-0.276), "−0.276");
  EXPECT_EQ(readable(8.9e-8), "8.9×10⁻⁸");
  EXPECT_EQ(readable(1460000), "1460000");
  EXPECT_EQ(readable(205.9e9), "2.059×10¹¹");
  EXPECT_EQ(readable(0), "0");
  EXPECT_EQ(readable(std::nan("")), "–");
}

TEST(Markup, OnlySingleLettersTakeSubscripts) {
  EXPECT_EQ(html_text("f F_N, d_m and N_cr"), "f F<sub>N</sub>, d<sub>m</sub> and N<sub>cr</sub>");
  EXPECT_EQ(html_text("F_N. F_L / F_N"), "F<sub>N</sub>. F<sub>L</sub> / F<sub>N</sub>");
  for (const char* text :
       {"vertical_force x_start a_b_c", "c_1.toml", "runs/c_1", "c_1/report.html", "probe.a_1", "smooth-c_1"})
    EXPECT_EQ(html_text(text), text);
  EXPECT_EQ(html_text("<a&\"b\">"), "&lt;a&amp;&quot;b&quot;&gt;");
}

TEST(Markup, BytesThatAreNotUtf8AreReplaced) {
  const std::string path = "caf\xE9/d\xC3\xA9p\xC3";
  const std::string shown = "caf\xEF\xBF\xBD/d\xC3\xA9p\xEF\xBF\xBD";
  for (const std::string& text : {html_escaped(path), html_text(path), svg_text(path)})
    EXPECT_EQ(text, shown);
}

TEST(Drawing, SectionsStandInContactPosition) {
  Section square;
  square.p = {-1, 1, 1, -1};
  square.q = {2, 2, 3, 3};
  square.quads = {{0, 1, 2, 3}};
  const Layer rail = section_layer("rail", square, Sweep::extruded);
  const Layer wheel = section_layer("wheel", square, Sweep::revolved, {0.5, 10});
  EXPECT_EQ(rail.cells.at(0).at(2), (std::array<double, 2>{1, 3}));
  EXPECT_EQ(wheel.cells.at(0).at(2), (std::array<double, 2>{1.5, 7}));  // below its axis
  Drawing drawing{"Contact", {rail, wheel}, Window{{-1, 1}, {1, 4}}, 416};
  const std::string html = drawing_html(drawing);
  EXPECT_NE(html.find("M8.0 408.0L408.0 408.0L408.0 208.0L8.0 208.0Z"), std::string::npos) << html;
  EXPECT_EQ(count(html, "Z\""), 1U);  // the wheel is outside the window
}

TEST(Heatmap, CellsStandAtTheirPlaces) {
  Heatmap map{"F_N", "Speed", "Wave", "max", {1, 2}, {10, 20}, {0, 1, 2, 4}, {}, "", {}, {}, ""};
  map.marked = {false, false, false, true};
  map.dots = {{1.5, 15, 4, "run"}};
  map.lines = {{{1, 2}, {10, 20}, "1 Hz"}};
  const std::string html = heatmap_html(map);
  // The largest value in the upper right quarter of 700 x 420 px, in the darkest colour.
  EXPECT_NE(html.find("x=\"422.0\" y=\"18.0\""), std::string::npos) << html;
  EXPECT_NE(html.find("fill=\"#201942\"/>"), std::string::npos);
  EXPECT_NE(html.find("<path class=\"outline\" d=\"M422.0 228.0"), std::string::npos) << html;
  EXPECT_NE(html.find("cx=\"422.0\" cy=\"228.0\""), std::string::npos);
  EXPECT_NE(html.find("1 Hz"), std::string::npos);
  EXPECT_EQ(count(heatmap_svg(map), "xmlns"), 1U);
  // Viewers of SVG files know no variables of style sheets.
  EXPECT_EQ(count(heatmap_svg(map), "var("), 0U) << heatmap_svg(map);
  EXPECT_EQ(count(heatmap_svg(map), ".c0 { stroke: #1f5fa8; }"), 1U) << heatmap_svg(map);
  map.values.pop_back();
  EXPECT_THROW(heatmap_html(map), std::logic_error);
}

TEST(Heatmap, BordersStandHalfwayBetweenNeighbours) {
  const std::string html =
      heatmap_html({"", "Speed", "Wave", "max", {0, 1, 3}, {0}, {0, 1, 2}, {}, "", {}, {}, ""});
  // Borders -0.5, 0.5, 2 and 4 over 700 px.
  EXPECT_NE(html.find("x=\"72.0\" y=\"18.0\" width=\"155.6\""), std::string::npos) << html;
  EXPECT_NE(html.find("x=\"227.6\" y=\"18.0\" width=\"233.3\""), std::string::npos) << html;
  EXPECT_NE(html.find("x=\"460.9\" y=\"18.0\" width=\"311.1\""), std::string::npos) << html;
}

TEST(Relief, WhatStandsBeforeIsDrawnLast) {
  Reliefs reliefs{
      "Fig. <1>", {{"Pressure", "x [m]", "y [mm]", "[MPa]", {0, 1, 3}, {0, 2}, {0, 12, 0, 0, 0, 0}}}, ""};
  const std::string html = reliefs_html(reliefs);
  EXPECT_NE(html.find("Fig. &lt;1&gt;"), std::string::npos);
  // The peak, a third of the way along the front: x = 62 + 0.8 x 796 / 3, y = 282 - 0.58 x 248.
  EXPECT_EQ(count(html, "274.3 138.2"), 2U) << html;  // in the two quads beside it
  reliefs.reliefs.front().y = {0, 2, 4};
  reliefs.reliefs.front().values = {0, 0, 0, 12, 12, 12, 0, 0, 0};
  const std::string rows = reliefs_html(reliefs);
  EXPECT_LT(rows.find("M141.6 86.1"), rows.find("M62.0 282.0L274.3 282.0"))
      << rows;  // the strip behind comes first
  EXPECT_EQ(count(reliefs_svg(reliefs), "xmlns"), 1U);
  reliefs.reliefs.push_back(reliefs.reliefs.front());
  EXPECT_NE(reliefs_svg(reliefs).find("M522.0 282.0"), std::string::npos);  // beside the first relief
  reliefs.reliefs.back().values.pop_back();
  EXPECT_THROW(reliefs_html(reliefs), std::logic_error);
}

/// A movie of two stations and four rows; only the second row touches.
PatchMovie one_frame() {
  MovieFrame frame;
  frame.centre = 10;
  frame.note = "t < 1 ms";
  frame.x = {9.5, 10.5};
  frame.fields = {{0, 100, 0, 0, 0, 50, 0, 0}};
  frame.state = {0, 1, 0, 0, 0, 2, 0, 0};
  return {"Patch", "x [mm]", "y [mm]", {"Pressure [MPa]"}, {-1, 0, 1, 2}, {frame}, ""};
}

TEST(PatchMovie, KeepsTheRowsThatTouchAndTheirNeighbours) {
  const std::string html = movie_html(one_frame());
  EXPECT_NE(html.find("\"y\": [-1, 0, 1]"), std::string::npos) << html;
  EXPECT_NE(html.find("\"largest\": [100]"), std::string::npos) << html;
  // Expected bytes: 0 255 0 0 128 0, then the states 0 1 0 0 2 0.
  EXPECT_NE(html.find("\"values\": \"AP8AAIAAAAEAAAIA\""), std::string::npos) << html;
}

TEST(PatchMovie, OfASingleFrameDoesNotPlay) {
  PatchMovie movie = one_frame();
  EXPECT_NE(movie_html(movie).find("<button type=\"button\" hidden>"), std::string::npos);
  EXPECT_NE(movie_html(movie).find("aria-label=\"instant\" hidden>"), std::string::npos);
  movie.frames.push_back(movie.frames.front());
  EXPECT_EQ(movie_html(movie).find(" hidden>"), std::string::npos);
}

TEST(PatchMovie, SaysWhetherTheWheelRolls) {
  PatchMovie movie = one_frame();
  EXPECT_EQ(count(movie_html(movie), "\"rolls\": true"), 1U) << movie_html(movie);
  movie.rolls = false;
  EXPECT_EQ(count(movie_html(movie), "\"rolls\": false"), 1U) << movie_html(movie);
}

TEST(PatchMovie, TextsCannotEndTheScript) {
  PatchMovie movie = one_frame();
  movie.frames[0].note = "</script>";
  EXPECT_EQ(count(movie_html(movie), "</script>"), 1U);
}

TEST(PatchMovie, EveryFrameNeedsAllValues) {
  PatchMovie movie = one_frame();
  movie.frames[0].state.pop_back();
  EXPECT_THROW(movie_html(movie), std::logic_error);
  EXPECT_EQ(movie_html(PatchMovie{}), "");
}

TEST(Report, ComparesWithTheReference) {
  const Table table = comparison_table("Forces", "Paper",
                                       {{"Largest F_N", "kN", 193.19, 173.871, "coarse"},
                                        {"Shift", "mm", std::nullopt, 12.0, ""},
                                        {"Offset", "mm", 0.0, 1.0, ""}});
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"Largest F_N", "kN", "193.2", "173.9", "−10.0 %", "coarse"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"Shift", "mm", "–", "12", "–", ""}));
  EXPECT_EQ(table.rows[2][4], "–");
}

TEST(Report, IsOneFileThatNeedsNoNetwork) {
  Report report{"Title <1>", "subtitle", {}, "footer"};
  report.chapters = {
      {"Forces", {Text{"a < b"}, one_curve({0, 1}, {0, 1}), KeyFigures{{"largest", "1", "kN"}}}},
      {"Mesh", {Drawings{"", {Drawing{}}}, Table{"t", {{"key"}}, {{"value"}}}}}};
  const std::string html = report_html(report);
  EXPECT_EQ(count(html, "<section"), 2U);
  EXPECT_EQ(count(html, "src="), 0U);
  EXPECT_EQ(count(html, "@import"), 0U);
  EXPECT_EQ(count(html, "url("), 0U);
  EXPECT_EQ(count(html, "http"), count(html, "\"http://www.w3.org/2000/svg\""));  // a name, not an address
  EXPECT_NE(html.find("<title>Title &lt;1&gt;</title>"), std::string::npos);
  EXPECT_NE(html.find("a &lt; b"), std::string::npos);
  report.chapters[1].blocks.push_back(Table{"t", {{"one"}, {"two"}}, {{"value"}}});
  EXPECT_THROW(report_html(report), std::logic_error);
}

TEST(Report, NamesAndCommandsKeepTheirUnderscores) {
  Report report{"F_N over c_1", "fork of c_1", {}, "tread resume c_1"};
  Table table{"", {{"Quantity"}, {.title = "Value", .plain = true}}, {}};
  table.rows.push_back({"F_N", "tread run a.toml -o c_1"});
  report.chapters = {{"Provenance", {table}}};
  const std::string html = report_html(report);
  for (const char* part :
       {"<title>F_N over c_1</title>", "<h1>F<sub>N</sub> over", "<p>fork of c_1</p>",
        "<td>F<sub>N</sub></td><td>tread run a.toml -o c_1</td>", "<footer>tread resume c_1</footer>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace tread
