#pragma once
// Style and script of reports, embedded at build time from report.css, figure.css, chart.js, patch_movie.js
// and copy.js.

namespace tread {

extern const char* const kReportStyle;  ///< style of everything but the figures
extern const char* const kFigureStyle;  ///< style of figures in reports and in SVG files, without variables
extern const char* const kReportScript;

}  // namespace tread
