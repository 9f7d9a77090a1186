#pragma once
// A checksum of 64 bits: every changed word changes it.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace tread {

/// FNV-1a by words of 8 bytes, with the high bits folded back. Each step maps both hash and word one to one,
/// so one flipped bit never goes unseen.
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 1099511628211ULL;
    value_ ^= value_ >> 29;
  }
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  /// Adds whole words, then the remaining bytes, filled up with zeros.
  void add(std::span<const std::byte> bytes) {
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, i + sizeof word <= bytes.size() ? sizeof word : bytes.size() - i);
      add(word);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace tread
