#pragma once
// Profiles of VAMPIRE and of many programs more: lines of text, then columns of numbers.

#include <string>
#include <vector>

#include "io/profiles/profile_points.hpp"

namespace tread {

/// Rows of y and z behind a header of any text. A word of the header may state the units (mm, m, inches),
/// a number alone on the last line of the header counts the rows. Of four columns the first two, the left
/// side, are taken. Every bad line is added to `faults`.
FilePoints read_column_profile(const std::string& text, std::vector<LineFault>& faults);

}  // namespace tread
