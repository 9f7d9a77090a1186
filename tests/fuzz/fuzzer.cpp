// libFuzzer's entry points for one target, TREAD_FUZZ_TARGET. The first argument that is a folder is the
// corpus: the target's seeds are put there before the start.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  for (int i = 1; i < *argc; ++i) {
    const std::filesystem::path folder = (*argv)[i];
    if (!std::filesystem::is_directory(folder)) continue;
    int number = 0;
    for (const std::string& seed : tread::fuzz::corpus(tread::fuzz::target(TREAD_FUZZ_TARGET)))
      std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
    break;
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tread::fuzz::Target& target = tread::fuzz::target(TREAD_FUZZ_TARGET);
  target.read(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
