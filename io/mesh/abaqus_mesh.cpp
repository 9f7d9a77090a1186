#include "io/mesh/abaqus_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "io/text/text.hpp"

namespace tread {

namespace {

/// A keyword line: its name and parameters in lower case, their values as written.
struct KeywordLine {
  std::string name;
  std::map<std::string, std::string> parameters;

  const std::string* value(const std::string& parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? nullptr : &found->second;
  }
  std::string text(const std::string& parameter) const {
    const std::string* found = value(parameter);
    return found == nullptr ? std::string() : *found;
  }
};

std::string without_quotes(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text.substr(0, 80));
}

KeywordLine keyword_of(std::string_view line) {
  KeywordLine keyword;
  const MeshFields fields = MeshFields::between_commas(line);
  keyword.name = lower_case(fields[0]);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t equals = std::min(fields[i].find('='), fields[i].size());
    const std::string name = lower_case(trimmed(fields[i].substr(0, equals)));
    keyword.parameters[name] = without_quotes(fields[i].substr(std::min(equals + 1, fields[i].size())));
  }
  return keyword;
}

class AbaqusMesh {
 public:
  AbaqusMesh(std::string_view text, MeshFaults& faults) : lines_(text), faults_(faults) {
    source_.format = "Abaqus input file";
    source_.numbers_parts = false;
  }

  MeshSource read() {
    while (lines_.next()) {
      const std::string_view line = trimmed(lines_.line());
      if (line.starts_with("**") || line.empty()) continue;
      if (line.starts_with('*')) {
        begin(joined(line));
      } else if (card_ != nullptr) {
        const MeshFields fields = MeshFields::between_commas(line);
        if (fields.overfull())
          fault("lines with too many values",
                fmt::format("more than {} values in a line; break it", MeshFields::kMost));
        (this->*card_)(fields, line.ends_with(','));
      }
    }
    leave();
    return std::move(source_);
  }

 private:
  using Card = void (AbaqusMesh::*)(const MeshFields&, bool continued);

  void fault(const std::string& kind, std::string message) {
    faults_.add(lines_.number(), kind, std::move(message));
  }

  /// A keyword line that ends in a comma goes on in the next line.
  std::string joined(std::string_view line) {
    std::string all(line);
    while (all.ends_with(',') && all.size() < 4096 && lines_.next()) all += trimmed(lines_.line());
    return all;
  }

  void begin(const std::string& line) {
    leave();
    const KeywordLine keyword = keyword_of(line);
    card_ = nullptr;
    note_scope(keyword.name);
    if (keyword.name == "*node") return begin_nodes(keyword);
    if (keyword.name == "*element") return begin_elements(keyword);
    if (keyword.name == "*nset") return begin_set(keyword, source_.node_sets, "nset");
    if (keyword.name == "*elset") return begin_set(keyword, source_.element_sets, "elset");
    if (keyword.name == "*surface") return begin_surface(keyword);
    if (keyword.name == "*instance") return begin_instance();
    if (keyword.name == "*part" && ++parts_ > 1)
      fault("parts that cannot be read",
            "a second *PART: numbers would not be unique; write a flat file, or each body to its own");
    if (refused(keyword.name)) return;
    constexpr std::string_view kSilent[] = {"*heading",      "*part",         "*end part", "*assembly",
                                            "*end assembly", "*end instance", "*preprint"};
    if (std::find(std::begin(kSilent), std::end(kSilent), keyword.name) == std::end(kSilent))
      ++source_.ignored[upper(keyword.name)];
  }

  /// Sets of *PART or *INSTANCE end where those of *ASSEMBLY begin.
  void note_scope(const std::string& name) {
    if (name == "*assembly" || name == "*end instance") {
      in_assembly_ = true;
      inner_node_sets_ = source_.node_sets.size();
      inner_element_sets_ = source_.element_sets.size();
    }
    if (name == "*instance" || name == "*end assembly") in_assembly_ = false;
  }

  /// Returns true after a fault if a set of *ASSEMBLY has the name of one of its part.
  bool clashes(const std::vector<MeshSource::Set>& sets, const std::string& name) {
    const std::size_t inner = &sets == &source_.node_sets ? inner_node_sets_ : inner_element_sets_;
    for (std::size_t i = 0; in_assembly_ && i < inner; ++i)
      if (lower_case(sets[i].name) == lower_case(name)) {
        fault("sets of one name",
              fmt::format("the set {} of *ASSEMBLY has the name of one of its part in line "
                          "{}: rename one of them",
                          shown(name), sets[i].line));
        return true;
      }
    return false;
  }

  static std::string upper(std::string_view text) { return shown(upper_case(text)); }

  /// Keywords that make or move nodes and elements.
  bool refused(const std::string& name) {
    static const std::map<std::string, const char*> kRefused = {
        {"*include", "put the files into one"}, {"*system", "write the places in the global axes"},
        {"*ngen", "write every node"},          {"*nfill", "write every node"},
        {"*ncopy", "write every node"},         {"*nmap", "write every node"},
        {"*elgen", "write every element"},      {"*elcopy", "write every element"},
        {"*import", "write the mesh itself"},   {"*submodel", "write the mesh itself"}};
    const auto found = kRefused.find(name);
    if (found == kRefused.end()) return false;
    fault("keywords that cannot be read", fmt::format("{} is not read; {}", upper(name), found->second));
    return true;
  }

  void begin_nodes(const KeywordLine& keyword) {
    if (in_assembly_) {  // reference points, with numbers of their own
      ++source_.ignored["*NODE in *ASSEMBLY"];
      return;
    }
    if (const std::string system = lower_case(keyword.text("system")); !system.empty() && system != "r")
      fault("keywords that cannot be read",
            "*NODE with SYSTEM is not read; write the places in Cartesian axes");
    if (keyword.value("input") != nullptr) fault_input("*NODE");
    collected_ = open(source_.node_sets, keyword.text("nset"));
    card_ = &AbaqusMesh::node_card;
  }

  void fault_input(const char* name) {
    fault("keywords that cannot be read",
          fmt::format("{} with INPUT is not read; put the files into one", name));
  }

  void begin_elements(const KeywordLine& keyword) {
    type_ = upper(keyword.text("type"));
    if (keyword.value("input") != nullptr) fault_input("*ELEMENT");
    collected_ = open(source_.element_sets, keyword.text("elset"));
    const bool solid = type_.starts_with("C3D") || type_.starts_with("DC3D") || type_.starts_with("AC3D");
    hexahedra_ = type_.starts_with("C3D8");
    if (!solid) ++source_.ignored[fmt::format("*ELEMENT, TYPE={}", type_)];
    if (!solid) return;
    const std::string name = keyword.text("elset").empty() ? std::string("elements") : keyword.text("elset");
    part_ = 0;
    for (const auto& [number, known] : source_.parts)
      if (lower_case(known) == lower_case(name)) part_ = number;
    if (part_ == 0) part_ = static_cast<std::int64_t>(source_.parts.size()) + 1;
    source_.parts.try_emplace(part_, name);
    card_ = &AbaqusMesh::element_card;
  }

  /// Index of the set of this name, which is made where it is new; nothing without a name.
  std::optional<std::size_t> open(std::vector<MeshSource::Set>& sets, const std::string& name) {
    if (name.empty()) return std::nullopt;
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (lower_case(sets[i].name) == lower_case(name)) return i;
    sets.push_back({name, lines_.number()});
    return sets.size() - 1;
  }

  void begin_set(const KeywordLine& keyword, std::vector<MeshSource::Set>& sets, const char* parameter) {
    const std::string name = keyword.text(parameter);
    if (name.empty())
      return fault("sets without a name",
                   fmt::format("*{0} has no name: expected {0}=NAME", upper(parameter)));
    if (in_assembly_ && keyword.value("instance") == nullptr) {  // of reference points
      ++source_.ignored[fmt::format("*{} in *ASSEMBLY without INSTANCE", upper(parameter))];
      return;
    }
    if (clashes(sets, name)) return;
    sets_ = &sets;
    set_ = *open(sets, name);
    if (const std::string* of = keyword.value("elset"); of != nullptr && &sets == &source_.node_sets)
      sets[set_].element_sets.push_back(*of);
    const bool generated = keyword.value("generate") != nullptr;
    card_ = generated ? &AbaqusMesh::range_card : &AbaqusMesh::member_card;
  }

  void begin_surface(const KeywordLine& keyword) {
    const std::string type = lower_case(keyword.text("type"));
    const std::string name = keyword.text("name");
    if (name.empty() || (!type.empty() && type != "element" && type != "node")) {
      ++source_.ignored["*SURFACE"];
      return;
    }
    if (clashes(source_.node_sets, name)) return;
    sets_ = &source_.node_sets;
    source_.node_sets.push_back({name, lines_.number()});
    set_ = source_.node_sets.size() - 1;
    card_ = type == "node" ? &AbaqusMesh::surface_node_card : &AbaqusMesh::surface_card;
  }

  void begin_instance() {
    if (++instances_ > 1)
      fault("parts that cannot be read",
            "a second *INSTANCE: numbers would not be unique; write a flat file, or each body to its own");
    card_ = &AbaqusMesh::instance_card;
  }
  void instance_card(const MeshFields& /*fields*/, bool /*continued*/) {
    fault("parts that cannot be read",
          "the instance is moved or turned; write a flat file, or the part in its place");
    card_ = nullptr;
  }

  /// Ends the keyword before.
  void leave() {
    if (pending_)
      faults_.add(element_.line, "elements that are cut off",
                  fmt::format("element {} ends after {} of 8 nodes", element_.number, nodes_));
    pending_ = false;
    collected_.reset();
  }

  void node_card(const MeshFields& fields, bool /*continued*/) {
    const auto number = integer_of(fields[0]);
    if (!number || *number <= 0)
      return fault("nodes without a number",
                   fmt::format("node \"{}\": expected its number and its place", shown(lines_.line())));
    Vec3 at;
    for (int i = 0; i < 3; ++i) {
      const std::string_view field = fields[1 + static_cast<std::size_t>(i)];
      const auto value = real_of(field);
      if (!value)
        return fault("nodes with wrong places",
                     fmt::format("node {}: \"{}\" is not a finite number", *number, shown(field)));
      at[i] = *value;
    }
    source_.nodes.push_back({*number, at, lines_.number()});
    if (collected_) source_.node_sets[*collected_].numbers.push_back({*number, *number});
  }

  void element_card(const MeshFields& fields, bool continued) {
    std::size_t i = 0;
    if (!pending_) {
      const auto number = integer_of(fields[0]);
      if (!number || *number <= 0)
        return fault("elements without a number",
                     fmt::format("element \"{}\": expected its number and its nodes", shown(lines_.line())));
      element_ = {*number, part_, {}, lines_.number()};
      nodes_ = 0;
      pending_ = true;
      i = 1;
    }
    for (; i < fields.size(); ++i) {
      const auto node = integer_of(fields[i]);
      if (!node) {
        pending_ = false;
        return fault(
            "elements with wrong numbers",
            fmt::format("element {}: \"{}\" is not the number of a node", element_.number, shown(fields[i])));
      }
      if (nodes_ < 8) element_.nodes[nodes_] = *node;
      ++nodes_;
    }
    if (!continued) add_element();
  }

  void add_element() {
    pending_ = false;
    if (!hexahedra_)
      return fault("elements that are no hexahedra of 8 nodes",
                   fmt::format("element {} is of type {}; only C3D8 and its variants are read",
                               element_.number, shown(type_)));
    if (nodes_ != 8)
      return fault("elements that are no hexahedra",
                   fmt::format("element {} has {} nodes in place of 8", element_.number, nodes_));
    source_.elements.push_back(element_);
    if (collected_) source_.element_sets[*collected_].numbers.push_back({element_.number, element_.number});
  }

  void member_card(const MeshFields& fields, bool /*continued*/) {
    MeshSource::Set& set = (*sets_)[set_];
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].empty()) continue;
      if (const auto number = integer_of(fields[i]))
        set.numbers.push_back({*number, *number});
      else
        set.sets.push_back(without_quotes(fields[i]));
    }
  }

  void range_card(const MeshFields& fields, bool /*continued*/) {
    const auto first = integer_of(fields[0]), last = integer_of(fields[1]);
    const auto step = fields[2].empty() ? std::optional<std::int64_t>(1) : integer_of(fields[2]);
    if (!first || !last || !step || *step <= 0 || *last < *first)
      return fault("sets with wrong ranges",
                   fmt::format("\"{}\": expected first, last and step of a range", shown(lines_.line())));
    (*sets_)[set_].numbers.push_back({*first, *last, *step});
  }

  void surface_node_card(const MeshFields& fields, bool /*continued*/) {
    if (const auto number = integer_of(fields[0]))
      (*sets_)[set_].numbers.push_back({*number, *number});
    else
      (*sets_)[set_].sets.push_back(without_quotes(fields[0]));
  }

  void surface_card(const MeshFields& fields, bool /*continued*/) {
    const std::string face = upper(fields[1]);
    if (face.size() != 2 || face[0] != 'S' || face[1] < '1' || face[1] > '6')
      return fault(
          "surfaces that cannot be read",
          fmt::format("\"{}\": expected elements and one of their faces S1 to S6", shown(lines_.line())));
    FaceOfElements of{"", 0, face[1] - '1'};  // S1 ... S6 are in the order of kHexFaces
    if (const auto number = integer_of(fields[0]))
      of.element = *number;
    else
      of.elements = without_quotes(fields[0]);
    (*sets_)[set_].faces.push_back(of);
  }

  MeshLines lines_;
  MeshFaults& faults_;
  MeshSource source_;
  Card card_ = nullptr;
  std::string type_;
  bool hexahedra_ = false;
  std::int64_t part_ = 0;
  int parts_ = 0, instances_ = 0;
  bool in_assembly_ = false;  ///< and in no instance of it
  std::size_t inner_node_sets_ = 0, inner_element_sets_ = 0;
  std::optional<std::size_t> collected_;  ///< set that takes up the nodes or elements
  std::vector<MeshSource::Set>* sets_ = nullptr;
  std::size_t set_ = 0;
  MeshSource::Element element_;
  std::size_t nodes_ = 0;  ///< of the element so far
  bool pending_ = false;   ///< the element goes on in the next line
};

}  // namespace

MeshSource read_abaqus_mesh(std::string_view text, MeshFaults& faults) {
  return AbaqusMesh(text, faults).read();
}

}  // namespace tread
