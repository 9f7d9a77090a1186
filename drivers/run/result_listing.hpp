#pragma once
// `tread results`: files of a run or a study, their datasets and the state of the run.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/files/hdf5_file.hpp"

namespace tread {

/// A dataset of an HDF5 file, or a column of a CSV file.
struct ResultItem {
  std::string name;
  std::vector<std::uint64_t> shape;
  std::string type;         ///< as Hdf5File::type() names it; "text" for columns
  std::string unit;         ///< "-" for pure numbers; empty where the file states none
  std::string description;  ///< empty where the file states none
};

/// A file or a folder of files of one kind.
struct ResultFile {
  std::string name;
  std::int64_t bytes = 0;  ///< [B]
  std::string content;     ///< a few words; empty for a table of unknown name
  std::string problem;     ///< reason why it cannot be read now; empty: none
  std::vector<ResultItem> items;
};

/// A run within the folder of a study.
struct ResultRun {
  std::string name;
  std::string state;
};

struct ResultListing {
  std::string state;          ///< one sentence; names the command that goes on with an unfinished run
  bool complete = false;      ///< all results are there
  Hdf5Attributes attributes;  ///< attributes of the run's first HDF5 file
  std::vector<ResultFile> files;
  std::vector<ResultRun> runs;
};

/// Looks into a folder, and changes nothing there. A file that cannot be read costs its datasets alone.
/// Throws InputError if the folder is missing or holds no results.
ResultListing look_at_results(const std::filesystem::path& folder);

struct ResultsOptions {
  std::filesystem::path folder;
  bool json = false;  ///< true for an object instead of tables
};

/// Prints the listing on stdout. Throws as look_at_results().
void list_results(const ResultsOptions& options);

}  // namespace tread
