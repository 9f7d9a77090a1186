// Readers on the corpus of the fuzzers and some thousand changes of it, the same ones every time. What
// libFuzzer does for minutes: tests/fuzz.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/run/run_checkpoint.hpp"
#include "tests/fuzz/targets.hpp"

namespace tread {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t bound) {
  return bound == 0 ? 0 : random() % bound;
}

void flip(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  char& c = bytes[below(random, bytes.size())];
  c = static_cast<char>(c ^ (1 << below(random, 8)));
}

void cut(std::string& bytes, Random& random) {
  bytes.resize(below(random, bytes.size() + 1));
}

void leave_out(std::string& bytes, Random& random) {
  const std::size_t at = below(random, bytes.size() + 1);
  bytes.erase(at, below(random, 20));
}

/// A piece of the text once more somewhere else.
void repeat(std::string& bytes, Random& random) {
  const std::string piece = bytes.substr(below(random, bytes.size() + 1), below(random, 200));
  bytes.insert(below(random, bytes.size() + 1), piece);
}

void insert_oddity(std::string& bytes, Random& random) {
  static const std::vector<std::string> oddities = {"9223372036854775807",
                                                    "18446744073709551615",
                                                    "-1",
                                                    "1e308",
                                                    "1e-308",
                                                    "nan",
                                                    "inf",
                                                    "0",
                                                    "[",
                                                    "]",
                                                    "{",
                                                    "}",
                                                    "\"",
                                                    "\n",
                                                    std::string(1, '\0'),
                                                    "\xff\xfe",
                                                    "=",
                                                    ".",
                                                    "/dev/zero"};
  const std::string& oddity = oddities[below(random, oddities.size())];
  const std::size_t at = below(random, bytes.size() + 1);
  bytes.replace(at, std::min(below(random, 4), bytes.size() - at), oddity);
}

std::string changed(std::string bytes, Random& random) {
  constexpr void (*kChanges[])(std::string&, Random&) = {flip, cut, leave_out, repeat, insert_oddity};
  for (std::size_t i = 0; i <= below(random, 3); ++i)
    kChanges[below(random, std::size(kChanges))](bytes, random);
  return bytes;
}

class FuzzTargets : public testing::TestWithParam<const char*> {};

TEST_P(FuzzTargets, AnyBytesAreReadOrRefused) {
  const fuzz::Target& target = fuzz::target(GetParam());
  const std::vector<std::string> corpus = fuzz::corpus(target);
  ASSERT_GT(corpus.size(), 2U);
  for (const std::string& bytes : corpus) EXPECT_NO_THROW(target.read(bytes)) << bytes.substr(0, 300);
  Random random(20140501);
  constexpr int kRounds = 1000;
  for (int i = 0; i < kRounds; ++i) {
    const std::string bytes = changed(corpus[below(random, corpus.size())], random);
    EXPECT_NO_THROW(target.read(bytes)) << bytes.substr(0, 300);
    if (HasFailure()) return;
  }
}

/// The unpacking of a checkpoint, without each of its entries in turn, and with another in its place.
TEST(Unpacking, WhatIsMissingOrOfAnotherKindIsRefused) {
  RunResults results;
  results.samples.resize(2);
  SealedContent content = pack_order(
      {{"scene.toml", "[scene]\n", ".", {{"/depth.txt", std::make_shared<const std::string>("0 0\n")}}},
       {"a=1"},
       {"b=2"},
       "",
       "tread run",
       {}});
  StateList list;
  results.list_state(list);
  pack(list, "results", content);
  StateList samples;
  samples.add_records("samples", std::span(results.samples));
  pack(samples, "histories", content);
  content["step/reason"] = std::string("none");
  const auto unpack_all = [](const SealedContent& all) {
    RunResults back;
    unpack_order(all);
    unpack_results(all, back);
  };
  EXPECT_NO_THROW(unpack_all(content));
  constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max();
  const std::vector<SealedValues> others = {std::string("text"), std::vector<std::int64_t>{kMany},
                                            std::vector<double>(7, std::nan("")), std::vector<double>{}};
  for (const auto& [name, values] : content) {
    SealedContent without = content;
    without.erase(name);
    EXPECT_THROW(unpack_all(without), InputError) << name;
    for (const SealedValues& other : others) {
      SealedContent changed = content;
      changed[name] = other;
      const bool same_kind = other.index() == values.index();
      try {
        unpack_all(changed);
        EXPECT_TRUE(same_kind) << name;
      } catch (const InputError&) {
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FuzzTargets,
                         testing::Values("scene", "table", "profile", "roughness", "map", "checkpoint",
                                         "run_folder", "mesh_deck", "mesh_gmsh", "mesh_abaqus"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace tread
