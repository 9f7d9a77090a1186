#pragma once
// Profiles of MiniProf: .ban (rail) and .whl (wheel), with the headers of the DOS and of the Windows program.

#include <string>
#include <vector>

#include "io/profiles/profile_points.hpp"

namespace tread {

/// Points [mm in the file] behind a header of `Key=Value` or, in old files, of free text and an empty line.
/// ColumnDef names the columns; XOffset and YOffset are added. Lines that begin with a quotation mark are
/// comments. Every bad line is added to `faults`.
FilePoints read_miniprof_profile(const std::string& text, std::vector<LineFault>& faults);

}  // namespace tread
