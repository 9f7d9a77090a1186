#pragma once
// Style and script of reports, embedded at build time from report.css and chart.js.

namespace tread {

extern const char* const kReportStyle;
extern const char* const kChartScript;

}  // namespace tread
