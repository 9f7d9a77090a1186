// Figures of a report as files: tables with units, pictures, their names and their folder.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "io/report/figure_files.hpp"
#include "io/report/figure_tables.hpp"
#include "io/text/text_file.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

Figure two_panels() {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  Figure figure;
  figure.name = "forces";
  figure.title = "Forces";
  figure.x_label = "Position [m]";
  figure.panels = {{"Force [kN]",
                    {{"F_N", {0, 1, 2}, {90, kGap, 110.25}}, {"F_L, \"low\"", {0, 1, 2}, {1, 2, 3}}},
                    {},
                    200,
                    {}},
                   {"Height [mm]", {{"surface", {0.5, 1.5}, {-0.1, 0.1}}}, {}, 90, {}}};
  return figure;
}

TEST(FigureTables, CurvesShareTheirAbscissaAndStateUnits) {
  EXPECT_EQ(
      curves_csv(two_panels()),
      "Position [m],F_N: Force [kN],\"F_L, 'low': Force [kN]\",surface: Position [m],surface: Height [mm]\n"
      "0,90,1,0.5,-0.1\n"
      "1,,2,1.5,0.1\n"
      "2,110.25,3,,\n");
}

TEST(FigureTables, MapsHoldCellsDotsAndLines) {
  Heatmap map{"F_N", "Speed [km/h]", "Wave [mm]", "max [-]", {1, 2}, {10, 20}, {0, 1, 2, 4}, {}, "", {}, {},
              ""};
  map.marked = {false, false, false, true};
  map.marked_label = "loss";
  map.dots = {{1.5, 15, 4, "run"}};
  map.lines = {{{1, 2}, {10, 20}, "1 Hz"}};
  EXPECT_EQ(heatmap_csv(map),
            "Speed [km/h],Wave [mm],max [-],source,loss\n"
            "1,10,0,,0\n2,10,1,,0\n1,20,2,,0\n2,20,4,,1\n"
            "1.5,15,4,run,\n1,10,,1 Hz,\n2,20,,1 Hz,\n");
}

TEST(FigureTables, ScattersHoldTheirDots) {
  const Scatter scatter{"t", "Cost [min]", "Error [%]", {{"F_N", {{2, 0.5, "fine", true}}}}, ""};
  EXPECT_EQ(scatter_csv(scatter), "panel,Cost [min],Error [%],label,marked\nF_N,2,0.5,fine,1\n");
}

TEST(FigureTables, DrawingsHoldWhatTheyShow) {
  const Layer rail{"rail", {{{0, 0}, {1, 0}, {1, 1}}, {{8, 8}, {9, 8}, {9, 9}}}, {{{0, 1}, {1, 1}}}};
  const Drawings drawings{"mesh", {{"Around the patch", {rail}, Window{{-1, -1}, {2, 2}}, 440}}};
  EXPECT_EQ(drawings_csv(drawings),
            "drawing,layer,polygon,horizontal [m],vertical [m]\n"
            "Around the patch,rail,1,0,0\nAround the patch,rail,1,1,0\nAround the patch,rail,1,1,1\n"
            "Around the patch,rail,2,0,1\nAround the patch,rail,2,1,1\n");
}

/// A movie of two instants, two stations and three rows.
PatchMovie movie() {
  MovieFrame first{10, "t = 1 ms", {9.5, 10.5}, {{0, 100, 0, 0, 50, 0}}, {0, 1, 0, 0, 2, 0}};
  MovieFrame second = first;
  second.note = "t = 2 ms";
  second.fields[0][1] = 120;
  return {"Patch", "x [mm]", "y [mm]", {"Pressure [MPa]"}, {-1, 0, 1}, {first, second}, "", "patch-movie"};
}

TEST(FigureTables, MoviesHoldThePlacesInContact) {
  EXPECT_EQ(movie_csv(movie()),
            "instant,centre [mm],x [mm],y [mm],Pressure [MPa],state\n"
            "1,10,-0.5,0,100,1\n1,10,0.5,0,50,2\n2,10,-0.5,0,120,1\n2,10,0.5,0,50,2\n");
}

TEST(FigureFiles, EveryNamedFigureHasAPictureAndATable) {
  const samples::TemporaryFolder temporary;
  const fs::path folder = temporary.path / kFigureFolder;
  Figure nameless = two_panels();
  nameless.name = "";
  const Drawings drawings{"mesh",
                          {{"Section", {{"rail", {{{0, 0}, {1, 0}, {1, 1}}}, {}}}, std::nullopt, 440}}};
  Report report{"Title", "", {{"Empty", {nameless, Text{"text"}}}}, ""};
  write_figures(folder, report);
  EXPECT_FALSE(fs::exists(folder));  // nothing to write

  report.chapters.push_back({"Full", {two_panels(), drawings, movie()}});
  write_report(temporary.path / "report.html", report);
  EXPECT_EQ(figures_in(folder), (std::vector<std::string>{"forces", "mesh", "patch-movie"}));
  for (const std::string& name : figures_in(folder)) {
    const std::string svg = read_text_file(folder / (name + ".svg"), 1 << 20);
    EXPECT_TRUE(svg.starts_with("<svg xmlns=")) << name;
    EXPECT_EQ(svg.find("var("), std::string::npos) << name;
    EXPECT_GT(fs::file_size(folder / (name + ".csv")), 20U) << name;
  }
  // The map of the instant with the largest pressure.
  EXPECT_NE(read_text_file(folder / "patch-movie.svg", 1 << 20).find("t = 2 ms"), std::string::npos);

  std::ofstream(folder / "notes.txt") << "mine";
  std::ofstream(folder / "mine.svg") << "<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>";
  std::ofstream(folder / "mine.csv") << "mine";
  fs::copy_file(folder / "forces.svg", folder / "copy.svg");
  remove_figures(folder);
  EXPECT_TRUE(figures_in(folder).empty());
  for (const char* foreign : {"notes.txt", "mine.svg", "mine.csv", "copy.svg"})
    EXPECT_TRUE(fs::remove(folder / foreign)) << foreign;
  remove_figures(folder);
  EXPECT_FALSE(fs::exists(folder));
}

}  // namespace
}  // namespace tread
