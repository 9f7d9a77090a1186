#pragma once
// Standard input, output and error.

#include <string>

namespace tread {

/// Puts /dev/null in the place of standard files that are closed, so that no file of a run takes their
/// numbers. Writing to a standard output that was closed still fails. Call it first.
void open_standard_files();

/// Lets writes beyond a bound on the size of files fail, where SIGXFSZ would kill the process.
void ignore_file_size_signal();

/// Writes to stderr. A missing listener is no reason to stop.
void print_error(const std::string& text);

}  // namespace tread
