#pragma once
// Data files and scenes that come with the program.

#include <filesystem>
#include <string>
#include <vector>

namespace tread {

/// Value of TREAD_SHARE in the environment; empty: none.
std::string stated_share();

/// Folders that may hold the data files, first come first: TREAD_SHARE alone where the environment
/// has it; else ../share/tread beside the program's folder (an installed program), then share/ of the source
/// tree that it was built from, if the build states one.
std::vector<std::filesystem::path> share_folders();

/// The file of that name, "dial/NAME.jsonl", in the first of these folders that has it; an empty path where
/// none does.
std::filesystem::path find_share_file(const std::filesystem::path& name);

/// Shipped scenes lie in scenes/ of these folders, or beside share/ of a source tree.
/// The scene or study at the path that the user states; where there is none, the shipped one of that name,
/// "tyre.toml" or "tyre". A path that leads nowhere is returned as it is.
std::filesystem::path find_scene(const std::filesystem::path& stated);

/// Names of the shipped scenes, "tyre".
std::vector<std::string> shipped_scenes();

/// Names of the shipped studies, "studies/contact_loss".
std::vector<std::string> shipped_studies();

}  // namespace tread
