#pragma once
// Data files that come with the program: references/ and dial/ of share/.

#include <filesystem>
#include <vector>

namespace tread {

/// Folders that may hold the data files, first come first: TREAD_SHARE alone where the environment
/// has it; else ../share/tread beside the program's folder (an installed program), then share/ of the source
/// tree that it was built from.
std::vector<std::filesystem::path> share_folders();

/// The file of that name, "dial/NAME.jsonl", in the first of these folders that has it; an empty path where
/// none does.
std::filesystem::path find_share_file(const std::filesystem::path& name);

}  // namespace tread
