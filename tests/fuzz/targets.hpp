#pragma once
// Readers of files that others may have written, each as a function of the bytes. Whatever these are, it must
// return: errors of the program's own kind are the right answer to bad bytes, anything else is a finding.

#include <filesystem>
#include <string>
#include <vector>

namespace tread::fuzz {

struct Target {
  const char* name;  ///< the corpus lies in tests/fuzz/corpus/<name>
  void (*read)(const std::string& bytes);
  /// Sound files, made by the program's own writers or shipped as scenes.
  std::vector<std::string> (*seeds)();
};

const std::vector<Target>& targets();

/// InputError where there is none.
const Target& target(const std::string& name);

/// The seeds, and the files of the corpus.
std::vector<std::string> corpus(const Target& target);

/// A sealed file with the bytes behind the header replaced and the header made right for them.
std::string resealed(const std::string& file);

}  // namespace tread::fuzz
