#pragma once
// The paper's seven conclusions, judged by our runs.

#include <string>
#include <vector>

#include "drivers/studies/paper/passage.hpp"
#include "io/report/report.hpp"

namespace tread {

enum class Verdict { not_run, reproduced, partly, not_reproduced };

/// For readers: "not run".
const char* name_of(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::not_run;
  std::string why;  ///< our numbers, or what is missing
};

struct Conclusion {
  int number;
  std::string claim;    ///< in our words
  std::string decided;  ///< what makes it reproduced
  Judgement (*judge)(const PassageRuns&);
};

const std::vector<Conclusion>& paper_conclusions();

/// Columns: number, conclusion, decided by, verdict, our numbers.
Table verdict_table(const PassageRuns& runs);

/// Columns: number, verdict, our numbers.
Table short_verdict_table(const PassageRuns& runs);

}  // namespace tread
