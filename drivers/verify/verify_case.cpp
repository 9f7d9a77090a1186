#include "drivers/verify/verify_case.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"

namespace tread {

bool VerifyInputs::set(std::string_view name, std::string_view value) {
  for (VerifyInput& input : inputs_) {
    if (input.name != name) continue;
    double number = 0;
    try {
      number = input.quantity ? parse_quantity(value, *input.quantity) : parse_number(value);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--set {}={}: {}", name, value, error.what()));
    }
    const auto shown = [&](double si) {
      return input.quantity ? format_quantity(si, input.unit) : fmt::format("{:g}", si);
    };
    if (!(number >= input.allowed[0] && number <= input.allowed[1]))
      throw InputError(fmt::format("--set {} = {}: {} must lie between {} and {}", name, value, input.meaning,
                                   shown(input.allowed[0]), shown(input.allowed[1])));
    input.value = number;
    changed_ = true;
    return true;
  }
  return false;
}

double VerifyInputs::operator[](std::string_view name) const {
  for (const VerifyInput& input : inputs_)
    if (input.name == name) return input.value;
  throw std::logic_error("a verification case asks for the unknown input " + std::string(name));
}

double Finding::error() const {
  return absolute ? value - reference : value / reference - 1;
}

bool Finding::pass() const {
  return !bound || std::abs(error()) <= *bound;
}

Finding judged_by_slip_zone(Finding finding, double factor, double element, double width) {
  if (width > element)
    finding.bound = factor * element / width;
  else
    finding.quantity += fmt::format(", not resolved: {:.2f} elements slip", width / element);
  return finding;
}

Finding judged_above_floor(Finding finding, double bound, double floor) {
  finding.absolute = bound * std::abs(finding.reference) < floor;
  finding.bound = finding.absolute ? floor : bound;
  return finding;
}

Finding beside_record(Finding finding, double difference, double bound) {
  if (finding.absolute) {
    finding.quantity += fmt::format(", against the reference {:+g}", difference);
    finding.reference += difference;
  } else {
    finding.quantity += fmt::format(", against the reference {:+g} %", 100 * difference);
    finding.reference *= 1 + difference;
  }
  finding.bound = bound;
  return finding;
}

bool refused(const std::function<void()>& act, const std::vector<std::string>& parts) {
  try {
    act();
  } catch (const InputError& error) {
    const std::string text = error.what();
    return std::all_of(parts.begin(), parts.end(),
                       [&](const std::string& part) { return text.find(part) != std::string::npos; });
  }
  return false;
}

}  // namespace tread
