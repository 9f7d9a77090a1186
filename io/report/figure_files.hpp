#pragma once
// The files of a report: the page, and a picture and a table of each figure.

#include <filesystem>
#include <string>
#include <vector>

#include "io/report/report.hpp"

namespace tread {

/// Folder of these files beside the report.
inline constexpr const char* kFigureFolder = "figures";

/// Writes NAME.svg and NAME.csv of every figure of the report that has a name. Makes the folder if there is
/// anything to write. Throws ResourceError.
void write_figures(const std::filesystem::path& folder, const Report& report);

/// Writes the report and, in the folder kFigureFolder beside it, its figures. Throws ResourceError; an older
/// file stays until the new one is complete.
void write_report(const std::filesystem::path& path, const Report& report);

/// Names of the figures that write_figures() has left in the folder, without ending, in alphabetical order.
/// Empty if there is no folder.
std::vector<std::string> figures_in(const std::filesystem::path& folder);

/// Removes the files of these figures, and the folder if nothing else is in it.
void remove_figures(const std::filesystem::path& folder);

/// write_report() in place of an earlier one in the folder, whose figures go.
void replace_report(const std::filesystem::path& path, const Report& report);

}  // namespace tread
