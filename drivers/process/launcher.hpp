#pragma once
// Environment that launchers of several processes leave. Private to drivers/process/.

#include <string>

namespace tread {

/// Number of processes started together; 0: several or one, known to the library of messages alone.
int launched_count();

/// Throws InputError where processes that were started together cannot join: launched_count() is 2 or more.
/// One of them speaks; its end ends the others. `why`: clause about this program, with the way out.
[[noreturn]] void refuse_launch(const std::string& why);

}  // namespace tread
