#include "drivers/run/program_hash.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "core/math/hash.hpp"
#include "io/text/text_file.hpp"

namespace tread {

std::uint64_t program_hash() {
  static const std::uint64_t value = [] {
    const std::string program = read_bytes("/proc/self/exe", std::numeric_limits<std::size_t>::max());
    Hash hash;
    hash.add(std::as_bytes(std::span(program)));
    return hash.value();
  }();
  return value;
}

}  // namespace tread
