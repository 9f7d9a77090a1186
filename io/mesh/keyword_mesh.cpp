#include "io/mesh/keyword_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "io/text/text.hpp"

namespace tread {

namespace {

constexpr std::array<int, 8> kTens = {10, 10, 10, 10, 10, 10, 10, 10};

/// Removes `end` from the end of a word; false where the word does not end so.
bool take_end(std::string& word, std::string_view end) {
  if (!word.ends_with(end)) return false;
  word.resize(word.size() - end.size());
  return true;
}

/// Returns true for *PART with options that leave title and card in the first place.
bool is_part_with_options(std::string name) {
  constexpr std::string_view kOptions[] = {"_INERTIA", "_REPOSITION",       "_CONTACT",
                                           "_PRINT",   "_ATTACHMENT_NODES", "_FIELD"};
  const auto take_option = [&](std::string_view option) { return take_end(name, option); };
  bool taken = true;
  while (taken) taken = std::any_of(std::begin(kOptions), std::end(kOptions), take_option);
  return name == "*PART";
}

double metres_of(std::string_view unit) {
  static const std::map<std::string, double, std::less<>> kUnits = {
      {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}};
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? 0 : found->second;
}

class KeywordMesh {
 public:
  KeywordMesh(std::string_view text, MeshFaults& faults) : lines_(text), faults_(faults) {
    source_.format = "LS-DYNA keyword deck";
  }

  MeshSource read() {
    while (!ended_ && lines_.next()) {
      const std::string_view line = lines_.line();
      if (line.starts_with('$')) continue;
      if (line.starts_with('*'))
        begin(line);
      else if (card_ != nullptr)
        (this->*card_)(line);
    }
    leave();
    if (!ended_)
      faults_.add(0, "files without an end",
                  "there is no line *END: is the file cut off? If it is whole, add that line");
    return std::move(source_);
  }

 private:
  using Card = void (KeywordMesh::*)(std::string_view);

  void fault(const std::string& kind, std::string message) {
    faults_.add(lines_.number(), kind, std::move(message));
  }

  /// A keyword: its name, in upper case, and an option behind a blank.
  void begin(std::string_view written) {
    leave();
    const std::string line = upper_case(written);
    const std::size_t end = std::min(line.find_first_of(" \t,("), line.size());
    std::string name = line.substr(0, end);
    const std::string_view rest = trimmed(std::string_view(line).substr(end));
    const bool tens = take_end(name, "%") || rest == "%" || (tens_everywhere_ && rest != "-");
    const bool is_long = take_end(name, "+") || rest == "+" || (long_everywhere_ && rest != "-");
    take_end(name, "-");
    number_width_ = tens ? 10 : 8;
    card_ = nullptr;
    cards_ = 0;
    titled_ = false;
    if (name == "*END") ended_ = true;
    if (name == "*END") return;
    if (name == "*KEYWORD") return begin_deck(rest);
    if (!choose(name)) {
      ++source_.ignored[name];
      return;
    }
    if (is_long)
      fault("keywords in the long format",
            fmt::format("{} is in the long format; save the deck in the standard format", name));
  }

  void begin_deck(std::string_view options) {
    const auto has = [&](std::string_view word) { return options.find(word) != std::string_view::npos; };
    tens_everywhere_ = has("I10=Y");
    long_everywhere_ = has("LONG=Y") || has("LONG=K");
  }

  /// Takes up a keyword with the cards that it has; false for one that is not read.
  bool choose(std::string name) {
    if (name == "*NODE") return take(&KeywordMesh::node_card);
    if (name == "*ELEMENT_SOLID") return take(&KeywordMesh::element_card);
    if (name == "*PART") return take(&KeywordMesh::part_card);
    if (is_part_with_options(name)) return take(&KeywordMesh::first_part_card);
    if (name == "*CONTROL_UNITS") return take(&KeywordMesh::units_card);
    constexpr std::string_view kRefused[] = {"*INCLUDE",        "*ELEMENT_SOLID_", "*ELEMENT_TSHELL",
                                             "*NODE_TRANSFORM", "*NODE_MERGE",     "*ELEMENT_GENERATE",
                                             "*PART_MOVE",      "*PART_DUPLICATE", "*PART_STACKED"};
    for (const std::string_view refused : kRefused)
      if (name.starts_with(refused)) {
        fault("keywords that cannot be read",
              fmt::format("{} is not read; {}", name,
                          refused == "*INCLUDE" ? "put the files into one"
                                                : "write the mesh with *NODE and *ELEMENT_SOLID alone"));
        return true;
      }
    titled_ = take_end(name, "_TITLE");
    const bool generated = take_end(name, "_GENERATE");
    take_end(name, "_LIST");
    if (name == "*SET_NODE" || name == "*SET_SOLID") {
      open_set(name == "*SET_NODE", "");
      return take(generated ? &KeywordMesh::range_card : &KeywordMesh::list_card);
    }
    if (name == "*SET_SEGMENT" && !generated) {
      open_set(true, "segments ");
      return take(&KeywordMesh::segment_card);
    }
    titled_ = false;
    return false;
  }

  bool take(Card card) {
    card_ = card;
    return true;
  }

  void open_set(bool of_nodes, const char* prefix) {
    set_ = MeshSource::Set{"", lines_.number()};
    set_of_nodes_ = of_nodes;
    set_prefix_ = prefix;
    in_set_ = true;
  }

  /// Ends the keyword before.
  void leave() {
    if (pending_) fault_cut_element();
    pending_ = false;
    if (part_pending_)
      fault("parts that are cut off", fmt::format("*PART \"{}\": its card is missing", shown(part_title_)));
    part_pending_ = false;
    if (in_set_ && cards_ > 0) (set_of_nodes_ ? source_.node_sets : source_.element_sets).push_back(set_);
    in_set_ = false;
  }

  void node_card(std::string_view line) {
    const std::array<int, 6> widths = {number_width_, 16, 16, 16, 8, 8};
    const MeshFields fields = MeshFields::of_widths(line, widths);
    if (fields.size() == 0) return;
    const auto number = integer_of(fields[0]);
    if (!number || *number <= 0) {
      fault("nodes without a number",
            fmt::format("node \"{}\": expected its number and its place", shown(line)));
      return;
    }
    Vec3 at;
    for (int i = 0; i < 3; ++i) {
      const std::string_view field = fields[1 + static_cast<std::size_t>(i)];
      const auto value = field.empty() ? std::optional(0.0) : real_of(field);
      if (!value) {
        fault("nodes with wrong places",
              fmt::format("node {}: \"{}\" is not a finite number", *number, shown(field)));
        return;
      }
      at[i] = *value;
    }
    source_.nodes.push_back({*number, at, lines_.number()});
  }

  /// Whole numbers of a card, blanks as 0; false after a fault.
  bool numbers_of(const MeshFields& fields, const char* of, std::array<std::int64_t, 10>& numbers) {
    numbers.fill(0);
    if (fields.size() > numbers.size())
      fault("cards with too many fields",
            fmt::format("{}: a card has {} fields at the most; break the line", of, numbers.size()));
    for (std::size_t i = 0; i < std::min(fields.size(), numbers.size()); ++i) {
      if (fields[i].empty()) continue;
      const auto value = integer_of(fields[i]);
      if (!value || *value < 0) {
        fault(fmt::format("{} with wrong numbers", of),
              fmt::format("{}: \"{}\" is not a number of a node, element or part", of, shown(fields[i])));
        return false;
      }
      numbers[i] = *value;
    }
    return true;
  }

  /// One card with number, part and nodes, or a card with number and part and one with the nodes.
  void element_card(std::string_view line) {
    std::array<int, 10> widths;
    widths.fill(number_width_);
    const MeshFields fields = MeshFields::of_widths(line, widths);
    if (fields.size() == 0) return;
    std::array<std::int64_t, 10> numbers;
    if (!numbers_of(fields, "elements", numbers)) {
      pending_ = !pending_ && fields.size() <= 2;
      skipped_ = pending_;
      return;
    }
    if (pending_) {
      pending_ = false;
      if (!skipped_) add_element({numbers.data(), 10});
      skipped_ = false;
      return;
    }
    element_ = {numbers[0], numbers[1], {}, lines_.number()};
    pending_ = std::all_of(numbers.begin() + 2, numbers.end(), [](std::int64_t n) { return n == 0; });
    if (!pending_) add_element({numbers.data() + 2, 8});
  }

  void add_element(std::span<const std::int64_t> nodes) {
    const auto stated = nodes.size() - static_cast<std::size_t>(std::count(nodes.begin(), nodes.end(), 0));
    if (element_.number <= 0) {
      fault("elements without a number",
            fmt::format("element \"{}\": expected its number", shown(lines_.line())));
      return;
    }
    if (stated != 8 || std::count(nodes.begin(), nodes.begin() + 8, 0) > 0) {
      fault("elements that are no hexahedra",
            fmt::format("element {} has {} nodes; only hexahedra of 8 nodes are read", element_.number,
                        stated));
      return;
    }
    std::copy_n(nodes.begin(), 8, element_.nodes.begin());
    source_.elements.push_back(element_);
  }

  void fault_cut_element() {
    if (skipped_) return;
    faults_.add(element_.line, "elements that are cut off",
                fmt::format("element {}: the card with its nodes is missing", element_.number));
  }

  /// Pairs of a title and a card.
  void part_card(std::string_view line) {
    if (!part_pending_) {
      part_title_ = std::string(trimmed(line).substr(0, 70));
      part_pending_ = true;
      return;
    }
    part_pending_ = false;
    std::array<std::int64_t, 10> numbers;
    if (!numbers_of(MeshFields::of_widths(line, kTens), "parts", numbers)) return;
    const auto [part, is_new] =
        source_.parts.try_emplace(numbers[0], part_title_.empty() ? std::to_string(numbers[0]) : part_title_);
    if (!is_new)
      fault("part numbers that occur twice",
            fmt::format("part {} is there already, \"{}\": each needs a number of its own", numbers[0],
                        shown(part->second)));
  }
  /// Other cards follow those of the first part.
  void first_part_card(std::string_view line) {
    if (cards_++ < 2) part_card(line);
  }

  void units_card(std::string_view line) {
    if (cards_++ == 0) source_.stated_unit = metres_of(lower_case(MeshFields::of_widths(line, kTens)[0]));
  }

  /// Takes a title and the card with the set's number; true for the cards behind them.
  bool behind_head(std::string_view line) {
    if (titled_ && set_.name.empty() && cards_ == 0) {
      set_.name = std::string(trimmed(line).substr(0, 70));
      titled_ = false;
      return false;
    }
    if (cards_++ > 0) return true;
    const std::string_view number = MeshFields::of_widths(line, kTens)[0];
    if (!integer_of(number))
      fault("sets without a number", fmt::format("set \"{}\" has no number", shown(line)));
    if (set_.name.empty()) set_.name = set_prefix_ + std::string(number);
    return false;
  }

  void list_card(std::string_view line) {
    std::array<std::int64_t, 10> numbers;
    if (!behind_head(line) || !numbers_of(MeshFields::of_widths(line, kTens), "sets", numbers)) return;
    for (const std::int64_t number : numbers)
      if (number != 0) set_.numbers.push_back({number, number});
  }

  void range_card(std::string_view line) {
    std::array<std::int64_t, 10> numbers;
    if (!behind_head(line) || !numbers_of(MeshFields::of_widths(line, kTens), "sets", numbers)) return;
    for (std::size_t i = 0; i < 8; i += 2)
      if (numbers[i] != 0) set_.numbers.push_back({numbers[i], std::max(numbers[i], numbers[i + 1])});
  }

  void segment_card(std::string_view line) {
    std::array<std::int64_t, 10> numbers;
    MeshFields fields = MeshFields::of_widths(line, kTens);
    fields.keep(4);  // attributes follow
    if (!behind_head(line) || !numbers_of(fields, "sets", numbers)) return;
    for (std::size_t i = 0; i < 4; ++i)
      if (numbers[i] != 0) set_.numbers.push_back({numbers[i], numbers[i]});
  }

  MeshLines lines_;
  MeshFaults& faults_;
  MeshSource source_;
  Card card_ = nullptr;
  int cards_ = 0;  ///< of this keyword
  int number_width_ = 8;
  bool tens_everywhere_ = false, long_everywhere_ = false, ended_ = false;
  MeshSource::Element element_;
  bool pending_ = false;  ///< the element's nodes are on the next card
  bool skipped_ = false;  ///< and are not read, after a fault
  std::string part_title_;
  bool part_pending_ = false;
  MeshSource::Set set_;
  std::string set_prefix_;
  bool in_set_ = false, set_of_nodes_ = true, titled_ = false;
};

}  // namespace

MeshSource read_keyword_mesh(std::string_view text, MeshFaults& faults) {
  return KeywordMesh(text, faults).read();
}

}  // namespace tread
