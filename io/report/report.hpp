#pragma once
// A report in one HTML file that needs no network and prints well.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/report/chart.hpp"
#include "io/report/drawing.hpp"
#include "io/report/heatmap.hpp"
#include "io/report/patch_movie.hpp"
#include "io/report/relief.hpp"
#include "io/report/scatter.hpp"

namespace tread {

/// A paragraph.
struct Text {
  std::string text;
};

enum class Align { left, right };

struct Column {
  std::string title;
  Align align = Align::left;
  bool plain = false;  ///< true for names, commands and values, whose underscores stay
};

struct Table {
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  ///< rows with one cell per column
};

/// A number that the reader should see first.
struct KeyFigure {
  std::string label;
  std::string value;
  std::string unit;
};

using KeyFigures = std::vector<KeyFigure>;

using Block = std::variant<Text, KeyFigures, Table, Figure, Drawings, Heatmap, Reliefs, PatchMovie, Scatter>;

struct Chapter {
  std::string title;
  std::vector<Block> blocks;
};

struct Report {
  std::string title;
  std::string subtitle;
  std::vector<Chapter> chapters;
  std::string footer;
};

/// A computed quantity beside its reference value.
struct Comparison {
  std::string quantity;
  std::string unit;
  std::optional<double> reference;
  std::optional<double> ours;
  std::string remark;
};

/// Table with the columns quantity, unit, reference, ours, difference in per cent of the reference, remark.
Table comparison_table(std::string title, const std::string& reference, const std::vector<Comparison>& rows);

/// The report as HTML. All text is plain; "F_N" and the like are set with subscripts, but not in plain
/// columns, subtitle and footer.
std::string report_html(const Report& report);

}  // namespace tread
