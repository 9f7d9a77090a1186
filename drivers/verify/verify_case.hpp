#pragma once
// What a verification case is: inputs, a computation by the program's own model, figures beside theory.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/engine/preload.hpp"
#include "io/report/report.hpp"
#include "io/text/units.hpp"

namespace tread {

/// A number that a case depends on and the user may change.
struct VerifyInput {
  std::string name;
  const Quantity* quantity = nullptr;  ///< what it measures; nullptr: a pure number
  std::string unit;                    ///< in which it is shown
  double value = 0;                    ///< the default [SI]
  Range allowed{};                     ///< values that make sense, both ends included [SI]
  std::string meaning;
};

/// The inputs of one computation, by name.
class VerifyInputs {
 public:
  explicit VerifyInputs(std::vector<VerifyInput> inputs) : inputs_(std::move(inputs)) {}
  /// Reads "name=value"; false where the case has no such input. Throws InputError for a value that is wrong.
  bool set(std::string_view name, std::string_view value);
  double operator[](std::string_view name) const;
  const std::vector<VerifyInput>& all() const { return inputs_; }

 private:
  std::vector<VerifyInput> inputs_;
};

/// A quantity of ours beside its reference.
struct Finding {
  std::string quantity;
  std::string unit;
  double value = 0;
  double reference = 0;
  std::optional<double> bound{};  ///< largest error that passes; absent: stated without judgement
  bool absolute = false;          ///< the error is value - reference, else relative to the reference

  double error() const;
  bool pass() const;
};

/// Whether `act` throws an InputError whose text holds all `parts`.
bool refused(const std::function<void()>& act, const std::vector<std::string>& parts = {});

struct CaseResult {
  std::vector<Finding> findings;
  std::vector<Figure> figures;
};

/// Cases that belong together; their name chooses them all.
inline constexpr std::string_view kStandardCases = "standard";  ///< what `tread verify` runs by itself
inline constexpr std::string_view kExtremes = "extremes";       ///< where the program's range ends

struct VerifyCase {
  std::string name;
  std::string summary;  ///< what is compared with what
  std::vector<VerifyInput> inputs;
  std::function<CaseResult(const VerifyInputs&, const ProgressText&)> run;
  std::string_view group = kStandardCases;
};

}  // namespace tread
