#pragma once
// Names of the machine.

#include <string>

namespace tread {

/// Network name of the machine.
std::string host_name();

/// Name of the processor as the system states it; "processor of unknown name" where it states none.
std::string processor_name();

}  // namespace tread
