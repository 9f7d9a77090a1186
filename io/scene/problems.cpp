#include "io/scene/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace tread {

namespace {

constexpr std::size_t kListedProblems = 50;

/// A problem and how often it occurs with another line and column.
struct Group {
  Problem first;
  int count = 0;
};

std::vector<Problem> sorted(std::vector<Problem> problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
  });
  return problems;
}

std::vector<Group> grouped(const std::vector<Problem>& problems) {
  std::vector<Group> groups;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> known;
  for (const Problem& problem : problems) {
    const auto [entry, is_new] =
        known.try_emplace({problem.file, problem.key, problem.message}, groups.size());
    if (is_new) groups.push_back({problem, 0});
    ++groups[entry->second].count;
  }
  return groups;
}

std::string listing(const std::vector<Problem>& problems) {
  const std::vector<Group> groups = grouped(problems);
  std::string text = problems.size() > 1 ? fmt::format("{} problems\n", problems.size()) : "";
  for (std::size_t i = 0; i < std::min(groups.size(), kListedProblems); ++i) {
    text += describe(groups[i].first);
    if (groups[i].count > 1) text += fmt::format(" ({} times)", groups[i].count);
    text += '\n';
  }
  if (groups.size() > kListedProblems) {
    text += fmt::format("... and {} more kinds\n", groups.size() - kListedProblems);
  }
  text.pop_back();
  return text;
}

}  // namespace

std::string describe(const Problem& problem) {
  std::string text = problem.file;
  if (problem.line > 0) text += fmt::format(":{}", problem.line);
  if (problem.column > 0) text += fmt::format(":{}", problem.column);
  if (!problem.key.empty()) text += fmt::format(": {}", problem.key);
  return text + ": " + problem.message;
}

ProblemsError::ProblemsError(std::vector<Problem> list)
    : InputError(listing(sorted(list))), problems(sorted(std::move(list))) {}

}  // namespace tread
