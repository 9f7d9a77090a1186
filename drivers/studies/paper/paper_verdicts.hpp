#pragma once
// The paper's seven conclusions, judged by our runs.

#include <string>
#include <vector>

#include "drivers/studies/paper/passage.hpp"
#include "io/report/report.hpp"

namespace tread {

enum class Verdict { not_run, reproduced, partly, not_reproduced };

/// Name for readers, such as "not run".
const char* name_of(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::not_run;
  std::string why;  ///< our numbers, or the missing passages
};

struct Conclusion {
  int number;
  std::string claim;    ///< conclusion in our words
  std::string decided;  ///< criterion for "reproduced"
  Judgement (*judge)(const PassageRuns&);
};

const std::vector<Conclusion>& paper_conclusions();

/// Table with the columns number, conclusion, decided by, verdict, our numbers.
Table verdict_table(const PassageRuns& runs);

/// Table with the columns number, verdict, our numbers.
Table short_verdict_table(const PassageRuns& runs);

}  // namespace tread
