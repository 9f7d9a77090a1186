#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/page_vector.hpp"

namespace tread {
namespace {

constexpr std::size_t kValues = PageAllocator<double>::kPage / sizeof(double);  // of a page

/// By page: 1 where it takes memory.
std::vector<unsigned char> resident(PageVector<double>& values) {
  std::vector<unsigned char> pages(values.size() / kValues);
  EXPECT_EQ(::mincore(values.data(), values.size() * sizeof(double), pages.data()), 0);
  for (unsigned char& page : pages) page &= 1U;
  return pages;
}

TEST(PageVector, ForgetsWholePagesThatLieInARange) {
  PageVector<double> values(64 * kValues);
  std::fill(values.begin(), values.end(), 3.0);
  forget(values, kValues + 1, 4 * kValues - 1);  // of three pages one lies in it
  for (std::size_t page = 0; page < 64; ++page) {
    EXPECT_EQ(resident(values)[page], page == 2 ? 0 : 1) << page;
    const bool kept = page != 2;
    EXPECT_EQ(values[page * kValues], kept ? 3.0 : 0.0) << page;
    EXPECT_EQ(values[(page + 1) * kValues - 1], kept ? 3.0 : 0.0) << page;
  }
  forget(values, 7, 7);
  EXPECT_EQ(values[7], 3.0);
}

TEST(PageVector, KeepsMarkedGroups) {
  constexpr std::size_t kGroup = 8;
  PageVector<double> values(5 * kValues);
  std::fill(values.begin(), values.end(), 1.0);
  std::vector<unsigned char> marks(values.size() / kGroup, 0);
  for (const std::size_t marked : {std::size_t{0}, kValues / kGroup, 5 * kValues / kGroup - 1})
    marks[marked] = 1;  // in the first two pages and the last one
  keep_marked(values, marks, kGroup);
  for (std::size_t page = 0; page < 5; ++page)
    EXPECT_EQ(values[page * kValues + 1], page == 2 || page == 3 ? 0.0 : 1.0) << page;
  keep_marked(values, {}, kGroup);  // no marks: of all groups
  EXPECT_EQ(std::count(values.begin(), values.end(), 1.0), std::ptrdiff_t{3 * kValues});
}

/// Flags that the kernel shows for the mapping that holds an address.
std::string flags_at(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool inside = false;
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t first = 0, last = 0;
    char dash = 0;
    std::istringstream range(line);
    if (range >> std::hex >> first >> dash >> last && dash == '-') inside = first <= at && at < last;
    if (inside && line.starts_with("VmFlags:")) return line + " ";
  }
  return {};
}

TEST(PageVector, AsksForLargePages) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage"))
    GTEST_SKIP() << "this kernel has no pages of 2 MiB";
  PageVector<double> values(1000 * kValues), others(1000 * kValues);
  use_large_pages(values);
  EXPECT_NE(flags_at(values.data()).find(" hg "), std::string::npos);
  EXPECT_EQ(flags_at(others.data()).find(" hg "), std::string::npos);
  EXPECT_EQ(values[values.size() - 1], 0.0);
  PageVector<double> none;
  use_large_pages(none);
}

}  // namespace
}  // namespace tread
