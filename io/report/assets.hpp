#pragma once
// Style and script of reports, embedded at build time from report.css, chart.js, patch_movie.js and copy.js.

namespace tread {

extern const char* const kReportStyle;
extern const char* const kReportScript;

}  // namespace tread
