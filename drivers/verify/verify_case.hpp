#pragma once
// A verification case: inputs, a computation by the program's own model, figures beside theory.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/engine/start/preload.hpp"
#include "io/report/report.hpp"
#include "io/text/units.hpp"

namespace tread {

/// A number that a case depends on and the user may change.
struct VerifyInput {
  std::string name;
  const Quantity* quantity = nullptr;  ///< measured quantity; nullptr: a pure number
  std::string unit;                    ///< unit in which the value is shown
  double value = 0;                    ///< default [SI]
  Range allowed{};                     ///< allowed values, both ends included [SI]
  std::string meaning;
};

/// The inputs of one computation, by name.
class VerifyInputs {
 public:
  explicit VerifyInputs(std::vector<VerifyInput> inputs) : inputs_(std::move(inputs)) {}
  /// Reads "name=value". Returns false if the case has no such input. Throws InputError for a wrong value.
  bool set(std::string_view name, std::string_view value);
  /// Returns true if no input was set.
  bool defaults() const { return !changed_; }
  double operator[](std::string_view name) const;
  const std::vector<VerifyInput>& all() const { return inputs_; }

 private:
  std::vector<VerifyInput> inputs_;
  bool changed_ = false;
};

/// A computed quantity beside its reference.
struct Finding {
  std::string quantity;
  std::string unit;
  double value = 0;
  double reference = 0;
  std::optional<double> bound{};  ///< largest error that passes; absent: stated without judgement
  bool absolute = false;          ///< true: the error is value - reference; false: relative to the reference

  double error() const;
  bool pass() const;
};

/// `finding` judged by the elements across a slip zone: the bound is `factor` times element [m] over width
/// [m]. A zone narrower than an element is not resolved: no bound, and the quantity says so.
Finding judged_by_slip_zone(Finding finding, double factor, double element, double width);

/// `finding` judged by `bound`, a share of its reference, or where this is less than `floor`, in the
/// finding's unit, by the floor.
Finding judged_above_floor(Finding finding, double bound, double floor);

/// `finding` against its reference changed by the difference of the two models that the records state, as a
/// share of the reference or, if the finding is absolute, in its unit. For inputs that the records hold
/// alone.
Finding beside_record(Finding finding, double difference, double bound);

/// Returns true if `act` throws an InputError whose text holds all `parts`.
bool refused(const std::function<void()>& act, const std::vector<std::string>& parts);

struct CaseResult {
  std::vector<Finding> findings;
  std::vector<Figure> figures;
};

/// Name that chooses all cases that belong together.
inline constexpr std::string_view kStandardCases = "standard";  ///< cases that `tread verify` runs by default
inline constexpr std::string_view kExtremes = "extremes";       ///< cases at the ends of the program's range

struct VerifyCase {
  std::string name;
  std::string summary;  ///< the compared quantities, in a sentence
  std::vector<VerifyInput> inputs;
  std::function<CaseResult(const VerifyInputs&, const ProgressText&)> run;
  std::string_view group = kStandardCases;
};

}  // namespace tread
