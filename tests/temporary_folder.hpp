#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace tread::samples {

/// A new folder that no other test or process has. It is removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() : path(made()) {}
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path path;

 private:
  static std::filesystem::path made() {
    std::string name = (std::filesystem::path(testing::TempDir()) / "tread_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make the folder " + name);
    return name;
  }
};

}  // namespace tread::samples
