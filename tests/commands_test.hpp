#pragma once
// Calls of the program in a folder of their own: exit code, output, errors, files.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace tread::samples {

struct Outcome {
  int code;
  std::string out;
  std::string errors;
};

class Commands : public testing::Test {
 protected:
  Outcome call(const std::string& arguments) const {
    const int code = program_.call(arguments);
    return {code, program_.out(), program_.errors()};
  }
  std::string scene(const std::string& name) const { return scene_word(name); }
  std::string content(const char* name) const { return content_of(folder_ / name); }

  TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path;

 private:
  Program program_;
};

}  // namespace tread::samples
