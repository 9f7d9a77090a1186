#include "drivers/verify/verification.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/verify/cases.hpp"
#include "io/files/output_file.hpp"
#include "io/report/markup.hpp"
#include "io/report/plain_text.hpp"
#include "io/report/report.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

/// A case with the inputs that it was run with and what came out.
struct Outcome {
  const VerifyCase* verified;
  VerifyInputs inputs;
  CaseResult result;
  double seconds;
};

std::string shown(const VerifyInput& input) {
  return input.quantity ? format_quantity(input.value, input.unit) : fmt::format("{:g}", input.value);
}

/// By the names of cases or groups; without any, the standard ones.
std::vector<const VerifyCase*> chosen(std::vector<std::string> names) {
  if (names.empty()) names.emplace_back(kStandardCases);
  std::vector<const VerifyCase*> cases;
  for (const std::string& name : names) {
    const std::size_t before = cases.size();
    for (const VerifyCase& c : verify_cases())
      if (c.name == name || c.group == name) cases.push_back(&c);
    if (cases.size() > before) continue;
    std::vector<std::string> known = {std::string(kStandardCases), std::string(kExtremes)};
    for (const VerifyCase& c : verify_cases()) known.push_back(c.name);
    const std::string near = similar_text(name, known);
    throw InputError(fmt::format(
        "verify: there is no case '{}'; {}", name,
        near.empty() ? "`tread verify --list` names them" : fmt::format("did you mean '{}'?", near)));
  }
  return cases;
}

/// The inputs of every chosen case; each override must find at least one that has it.
std::vector<VerifyInputs> inputs_of(const std::vector<const VerifyCase*>& cases,
                                    const std::vector<std::string>& overrides) {
  std::vector<VerifyInputs> inputs;
  inputs.reserve(cases.size());
  for (const VerifyCase* c : cases) inputs.emplace_back(c->inputs);
  for (const std::string& text : overrides) {
    const auto equals = text.find('=');
    if (equals == std::string::npos)
      throw InputError(
          fmt::format("--set {}: expected name=value, for example --set radius=\"0.5 m\"", text));
    const std::string name = text.substr(0, equals);
    bool found = false;
    std::vector<std::string> known;
    for (VerifyInputs& of_case : inputs) {
      found = of_case.set(name, text.substr(equals + 1)) || found;
      for (const VerifyInput& input : of_case.all())
        if (std::find(known.begin(), known.end(), input.name) == known.end()) known.push_back(input.name);
    }
    if (found) continue;
    std::string names;
    for (const std::string& k : known) names += (names.empty() ? "" : ", ") + k;
    throw InputError(
        fmt::format("--set {}: no chosen case has the input '{}'; they have {}", text, name, names));
  }
  return inputs;
}

Table table_of(std::span<const Outcome> outcomes) {
  Table table{"",
              {{"Case"},
               {"Quantity"},
               {"Ours", Align::right},
               {"Reference", Align::right},
               {"Unit"},
               {"Error", Align::right},
               {"Bound", Align::right},
               {""}},
              {}};
  for (const Outcome& outcome : outcomes)
    for (const Finding& f : outcome.result.findings) {
      const auto error = [&](double value) {
        return f.absolute ? readable(value, 3) : fmt::format("{:+.2f} %", 100 * value);
      };
      const auto limit = [&](double value) {
        return f.absolute ? readable(value, 3) : fmt::format("{:.3g} %", 100 * value);
      };
      table.rows.push_back({outcome.verified->name, f.quantity, readable(f.value), readable(f.reference),
                            f.unit, error(f.error()), f.bound ? limit(*f.bound) : "",
                            f.bound ? (f.pass() ? "ok" : "FAILS") : ""});
    }
  return table;
}

std::string json_lines(const Outcome& outcome) {
  Json inputs = Json::object();
  for (const VerifyInput& input : outcome.inputs.all()) {
    Json& value = inputs[std::string(input.name)];
    if (input.quantity)
      value = shown(input);
    else
      value = input.value;
  }
  std::string lines;
  for (const Finding& f : outcome.result.findings)
    lines += json_line({{"case", outcome.verified->name},
                        {"inputs", inputs},
                        {"quantity", f.quantity},
                        {"value", f.value},
                        {"unit", f.unit},
                        {"reference", f.reference},
                        {"error", f.error()},
                        {"error_is_relative", !f.absolute},
                        {"bound", number_or_null(f.bound)},
                        {"pass", f.pass()},
                        {"seconds", outcome.seconds}});
  return lines;
}

/// Those of the names; without any, all.
std::vector<const VerifyCase*> listed_cases(const std::vector<std::string>& names) {
  if (!names.empty()) return chosen(names);
  std::vector<const VerifyCase*> all;
  for (const VerifyCase& c : verify_cases()) all.push_back(&c);
  return all;
}

void list_cases(const std::vector<const VerifyCase*>& cases) {
  for (const VerifyCase* c : cases) {
    fmt::print("{} ({}): {}\n", c->name, c->group, c->summary);
    for (const VerifyInput& input : c->inputs)
      fmt::print("    {} = {}    {}\n", input.name, shown(input), input.meaning);
  }
}

/// The same as one list.
std::string list_json(const std::vector<const VerifyCase*>& cases) {
  Json list = Json::array();
  for (const VerifyCase* c : cases) {
    Json one = {{"case", c->name}, {"group", c->group}, {"summary", c->summary}};
    one["inputs"] = Json::array();
    for (const VerifyInput& input : c->inputs)
      one["inputs"].push_back({{"name", input.name}, {"value", shown(input)}, {"meaning", input.meaning}});
    list.push_back(std::move(one));
  }
  return json_text(list);
}

/// Inputs that differ from the case's own, each after `lead`.
std::string changed_inputs(const VerifyCase& verified, const VerifyInputs& inputs, std::string_view lead) {
  std::string text;
  for (std::size_t i = 0; i < verified.inputs.size(); ++i) {
    const VerifyInput& input = inputs.all()[i];
    if (input.value != verified.inputs[i].value)
      text += fmt::format("{}{}=\"{}\"", lead, input.name, shown(input));
  }
  return text;
}

/// The case's name and what differs from its own inputs, fit for a file's name.
std::string page_name(const Outcome& outcome) {
  std::string name = outcome.verified->name;
  for (const char c : changed_inputs(*outcome.verified, outcome.inputs, "-"))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_')
      name += c;
    else if (c == '=')
      name += '-';
  return name;
}

/// A chapter of docs/records/verification.md: Markdown table and SVG figures.
void write_page(const Outcome& outcome, const std::filesystem::path& directory) {
  const std::string name = page_name(outcome);
  const std::string command = "`tread verify " + outcome.verified->name +
                              changed_inputs(*outcome.verified, outcome.inputs, " --set ");
  std::string text =
      fmt::format("{}`: {}; {}.\n\n", command, outcome.verified->summary, duration_text(outcome.seconds));
  Table table = table_of({&outcome, 1});
  table.columns.erase(table.columns.begin());
  for (auto& row : table.rows) row.erase(row.begin());
  text += markdown(table);
  text += "\n";
  for (std::size_t i = 0; i < outcome.result.figures.size(); ++i) {
    const std::string file = fmt::format("{}-{}.svg", name, i);
    write_text_file(directory / file, figure_svg(outcome.result.figures[i]));
    text += fmt::format("![{}]({})\n\n", outcome.result.figures[i].title, file);
  }
  write_text_file(directory / (name + ".md"), text);
}

/// Throws InputError if nothing was compared within a bound: the case would pass without a judgement.
void require_judged(const VerifyCase& verified, const VerifyInputs& inputs, const CaseResult& result) {
  if (std::ranges::any_of(result.findings, [](const Finding& f) { return f.bound.has_value(); })) return;
  throw InputError(fmt::format("verify: {} judges nothing with these inputs:{}; state others", verified.name,
                               changed_inputs(verified, inputs, " ")));
}

bool passes(const Outcome& outcome) {
  const std::vector<Finding>& findings = outcome.result.findings;
  return std::all_of(findings.begin(), findings.end(), [](const Finding& finding) { return finding.pass(); });
}

/// "[verify] 2 of 9 done, 1 failed  carter": cases so far, and the next one.
std::string progress_line(const std::vector<Outcome>& outcomes, const std::vector<const VerifyCase*>& cases) {
  std::string line = fmt::format("[verify] {} of {} done", outcomes.size(), cases.size());
  const auto failed = std::count_if(outcomes.begin(), outcomes.end(),
                                    [](const Outcome& outcome) { return !passes(outcome); });
  if (failed > 0) line += fmt::format(", {} failed", failed);
  if (outcomes.size() < cases.size()) line += fmt::format("  {}", cases[outcomes.size()]->name);
  return line;
}

/// Runs the cases one after the other. `ended`: called with all outcomes after each.
void run_cases(const std::vector<const VerifyCase*>& cases, const std::vector<VerifyInputs>& inputs,
               const Progress& progress, std::vector<Outcome>& outcomes, const std::function<void()>& ended) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double started = progress.seconds();
    progress.say(progress_line(outcomes, cases));
    CaseResult result = cases[i]->run(inputs[i], [&](const std::string& text) {
      progress.say(fmt::format("[{}] {}", cases[i]->name, text));
    });
    require_judged(*cases[i], inputs[i], result);
    outcomes.push_back({cases[i], inputs[i], std::move(result), progress.seconds() - started});
    ended();
  }
  progress.say(progress_line(outcomes, cases));
}

}  // namespace

bool verify(const VerifyOptions& options) {
  if (options.list) {
    const std::vector<const VerifyCase*> cases = listed_cases(options.names);
    if (options.json)
      fmt::print("{}", list_json(cases));
    else
      list_cases(cases);
    return true;
  }
  use_threads(options.threads);
  choose_device(options.device);
  const std::vector<const VerifyCase*> cases = chosen(options.names);
  const std::vector<VerifyInputs> inputs = inputs_of(cases, options.overrides);
  if (!options.output.empty()) make_directory(options.output);
  const Progress progress(options.quiet);
  std::vector<Outcome> outcomes;
  const auto leave = [&] {
    if (!options.output.empty()) write_page(outcomes.back(), options.output);
    if (!options.json) return;
    fmt::print("{}", json_lines(outcomes.back()));
    std::fflush(stdout);
  };
  const auto print_table = [&] {
    if (!options.json) fmt::print("{}", plain_text(table_of(outcomes)));
  };
  try {
    run_cases(cases, inputs, progress, outcomes, leave);
  } catch (...) {
    if (!outcomes.empty()) print_table();
    throw;
  }
  print_table();
  return std::all_of(outcomes.begin(), outcomes.end(), passes);
}

}  // namespace tread
