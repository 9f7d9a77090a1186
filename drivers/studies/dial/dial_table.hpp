#pragma once
// Cost of settings and errors of their passages against a reference; the cheapest one for a wanted error.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/studies/dial/dial_measures.hpp"

namespace tread {

/// One run.
struct DialRow {
  std::string point;
  std::vector<std::string> settings;  ///< what tells it from the scene: "scene.element_size=5 mm"
  double elements = 0;
  double steps = 0;
  double minutes = 0;  ///< of a core: mesh, preload and rolling times threads [min]
  std::map<std::string, CurveDifference> differences;  ///< by DialQuantity::name

  double element_steps() const { return elements * steps; }
};

struct DialTable {
  std::string scene;      ///< title of the passage
  std::string reference;  ///< point or folder that the rows are compared with
  std::vector<DialRow> rows;
};

/// The cost over which a front is drawn.
enum class DialCost { minutes, element_steps };

/// "minutes", "element-steps". InputError for any other text.
DialCost dial_cost(const std::string& text);

double cost_of(const DialRow& row, DialCost cost);

/// The largest of a row's errors counts as the quantity "all"; rows that lack a quantity have none.
inline constexpr const char* kAllQuantities = "all";

/// InputError where it is neither "all" nor a DialQuantity's name.
void require_quantity(const std::string& option, const std::string& quantity);

/// The row's error [-] in a quantity, of the fluctuation if measured; nothing where it was not compared in
/// it.
std::optional<double> error_of(const DialRow& row, const std::string& quantity);

/// Rows other than the reference that have an error in the quantity.
std::vector<const DialRow*> compared_rows(const DialTable& table, const std::string& quantity);

/// Returns true if any row has an error of the fluctuation.
bool has_fluctuation(const DialTable& table);

/// The Pareto front: rows than which no other row is both cheaper and more accurate, cheapest first. The
/// reference is not among them.
std::vector<const DialRow*> pareto_front(const DialTable& table, const std::string& quantity, DialCost cost);

/// The cheapest row whose error is `wanted` [-] at most, and that of all rows with as many elements or more
/// and no other settings beside the size than it has: no row by luck. The one with the fewest settings of
/// several as cheap within 1 %, then the nearest; null where there is none.
const DialRow* cheapest(const DialTable& table, const std::string& quantity, double wanted, DialCost cost);

/// The runs beside the reference. InputError where their curves do not read.
DialTable dial_table(const std::vector<FinishedRun>& runs, const FinishedRun& reference);

/// A line a run, for spreadsheets; units in the header.
std::string dial_csv(const DialTable& table);

/// The table as flat JSON objects, one a line, which parse_dial() reads.
std::string dial_lines(const DialTable& table);

/// The same objects as one list; empty without rows.
std::string dial_json(const DialTable& table);

/// Messages call the text `name`. InputError where it is not such a table.
DialTable parse_dial(const std::string& text, const std::string& name);

/// dial.jsonl of a dial's folder, or such a file. InputError.
DialTable read_dial(const std::filesystem::path& path);

/// The table that comes with the library's scene. [dial.md] InputError where the file is missing.
DialTable measured_dial();

}  // namespace tread
