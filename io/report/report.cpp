#include "io/report/report.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/report/assets.hpp"
#include "io/report/markup.hpp"

namespace tread {

namespace {

std::string cell(const char* tag, const Column& column, const std::string& text) {
  return fmt::format("<{0}{1}>{2}</{0}>", tag, column.align == Align::right ? " class=\"right\"" : "",
                     column.plain ? html_escaped(text) : html_text(text));
}

std::string html(const Text& text) {
  return "<p>" + html_text(text.text) + "</p>\n";
}

std::string html(const KeyFigures& figures) {
  std::string out = "<div class=\"figures\">\n";
  for (const KeyFigure& figure : figures)
    out += fmt::format("<div><b>{} <small>{}</small></b><span>{}</span></div>\n", html_text(figure.value),
                       html_text(figure.unit), html_text(figure.label));
  return out + "</div>\n";
}

std::string html(const Table& table) {
  constexpr std::size_t kMany = 9;  // columns; a table with more does not fit on a page
  std::string out =
      fmt::format("<div class=\"table{}\"><table>\n", table.columns.size() > kMany ? " many" : "");
  if (!table.title.empty()) out += "<caption>" + html_text(table.title) + "</caption>\n";
  out += "<thead><tr>";
  for (const Column& column : table.columns) out += cell("th", column, column.title);
  out += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.columns.size())
      throw std::logic_error("table '" + table.title + "': a row needs one cell per column");
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) out += cell("td", table.columns[i], row[i]);
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table></div>\n";
}

std::string html(const Figure& figure) {
  return figure_html(figure);
}

std::string html(const Heatmap& map) {
  return heatmap_html(map);
}

std::string html(const Reliefs& reliefs) {
  return reliefs_html(reliefs);
}

std::string html(const Scatter& scatter) {
  return scatter_html(scatter);
}

std::string html(const PatchMovie& movie) {
  return movie_html(movie);
}

std::string html(const Drawings& drawings) {
  std::string out = "<div class=\"drawings\">\n";
  for (const Drawing& drawing : drawings.drawings) out += drawing_html(drawing);
  return out + "</div>\n";
}

std::string difference(const Comparison& row) {
  if (!row.reference || !row.ours || *row.reference == 0) return "–";
  const double percent = 100 * (*row.ours - *row.reference) / std::abs(*row.reference);
  return fmt::format("{}{:.1f} %", percent < 0 ? "−" : "+", std::abs(percent));
}

}  // namespace

Table comparison_table(std::string title, const std::string& reference, const std::vector<Comparison>& rows) {
  Table table{std::move(title),
              {{"Quantity"},
               {"Unit"},
               {reference, Align::right},
               {"Here", Align::right},
               {"Difference", Align::right},
               {"Remark"}},
              {}};
  const auto shown = [](const std::optional<double>& value) { return value ? readable(*value) : "–"; };
  for (const Comparison& row : rows)
    table.rows.push_back(
        {row.quantity, row.unit, shown(row.reference), shown(row.ours), difference(row), row.remark});
  return table;
}

std::string report_html(const Report& report) {
  std::string nav;
  std::string body;
  for (std::size_t i = 0; i < report.chapters.size(); ++i) {
    const Chapter& chapter = report.chapters[i];
    nav += fmt::format("<a href=\"#chapter{}\">{}</a>\n", i + 1, html_text(chapter.title));
    body += fmt::format("<section id=\"chapter{}\">\n<h2>{}</h2>\n", i + 1, html_text(chapter.title));
    for (const Block& block : chapter.blocks)
      body += std::visit([](const auto& content) { return html(content); }, block);
    body += "</section>\n";
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>\n{7}{1}</style>\n</head>\n<body>\n"
      "<header>\n<h1>{8}</h1>\n<p>{2}</p>\n<nav>\n{3}</nav>\n</header>\n{4}"
      "<footer>{5}</footer>\n<script>\n{6}</script>\n</body>\n</html>\n",
      html_escaped(report.title), kReportStyle, html_escaped(report.subtitle), nav, body,
      html_escaped(report.footer), kReportScript, kFigureStyle, html_text(report.title));
}

}  // namespace tread
