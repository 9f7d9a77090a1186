// Numbers of a file into indices.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "core/index.hpp"
#include "io/mesh/imported_mesh.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

/// Objects of a file by their numbers.
class Numbers {
 public:
  /// `what`: "node". Faults: numbers that occur twice.
  template <class Object>
  Numbers(const std::vector<Object>& objects, const char* what, MeshFaults& faults) {
    entries_.reserve(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i)
      entries_.push_back({objects[i].number, static_cast<std::int32_t>(i)});
    std::sort(entries_.begin(), entries_.end());
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].number != entries_[i - 1].number) continue;
      const int first = objects[index(entries_[i - 1].place)].line,
                line = objects[index(entries_[i].place)].line;
      faults.add(line, fmt::format("{} numbers that occur twice", what),
                 fmt::format("{} {} is there already, in line {}: each needs a number of its own", what,
                             entries_[i].number, first));
    }
  }

  /// Place in the file's list, or -1.
  std::int32_t place(std::int64_t number) const {
    const auto at = lower(number);
    return at != entries_.end() && at->number == number ? at->place : -1;
  }
  /// Calls visit(place) for the objects of a range; false where a single number is unknown.
  template <class Visit>
  bool visit(const NumberRange& range, const Visit& visit) const {
    bool found = false;
    for (auto at = lower(range.first); at != entries_.end() && at->number <= range.last; ++at) {
      if ((at->number - range.first) % range.step != 0) continue;
      found = true;
      visit(at->place);
    }
    return found || range.first != range.last;
  }

 private:
  struct Entry {
    std::int64_t number;
    std::int32_t place;
    bool operator<(const Entry& other) const {
      return std::pair(number, place) < std::pair(other.number, other.place);
    }
  };
  std::vector<Entry>::const_iterator lower(std::int64_t number) const {
    return std::lower_bound(entries_.begin(), entries_.end(), Entry{number, -1});
  }

  std::vector<Entry> entries_;
};

using Members = std::vector<std::int32_t>;

void make_unique(Members& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

/// "3, 5 and 8"
std::string number_list(const std::vector<std::int64_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 == numbers.size() ? " and " : ", ", numbers[i]);
  return text;
}

class MeshNumbering {
 public:
  MeshNumbering(const MeshSource& source, const MeshWish& wish, MeshFaults& faults)
      : source_(source),
        wish_(wish),
        faults_(faults),
        nodes_(source.nodes, "node", faults),
        elements_(source.elements, "element", faults),
        element_sets_{source.element_sets, "set of elements"},
        node_sets_{source.node_sets, "set of nodes"} {}

  ImportedMesh make() {
    result_.format = source_.format;
    for (const auto& [keyword, times] : source_.ignored)
      ignored_ += fmt::format("{}{}{}", ignored_.empty() ? "" : ", ", keyword,
                              times > 1 ? fmt::format(" ({} times)", times) : "");
    if (!ignored_.empty()) result_.notes.push_back("not read: " + ignored_);
    resolve_corners();
    if (!faults_.empty()) return std::move(result_);
    resolve_element_sets();
    resolve_node_sets();
    choose();
    if (!faults_.empty()) return std::move(result_);
    number_nodes();
    add_sets();
    return std::move(result_);
  }

  const std::vector<int>& lines() const { return lines_; }

 private:
  /// Places of the elements' nodes in the file's list.
  void resolve_corners() {
    corners_.resize(source_.elements.size());
    for (std::size_t e = 0; e < corners_.size(); ++e) {
      const MeshSource::Element& element = source_.elements[e];
      for (std::size_t i = 0; i < 8; ++i) {
        corners_[e][i] = nodes_.place(element.nodes[i]);
        if (corners_[e][i] < 0)
          faults_.add(element.line, "elements with unknown nodes",
                      fmt::format("element {}: the file has no node {}", element.number, element.nodes[i]));
      }
      std::array<std::int64_t, 8> sorted = element.nodes;
      std::sort(sorted.begin(), sorted.end());
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (twice != sorted.end())
        faults_.add(
            element.line, "elements with repeated nodes",
            fmt::format("element {}: node {} occurs more than once; a wedge or tetrahedron written as "
                        "a hexahedron is not read",
                        element.number, *twice));
    }
  }

  /// Sets of a kind, resolved one by one.
  struct Sets {
    const std::vector<MeshSource::Set>& stated;
    const char* what;                                ///< "set of elements"
    std::vector<std::optional<Members>> known = {};  ///< places in the file's list

    std::optional<std::size_t> find(const std::string& name) const {
      for (std::size_t i = 0; i < stated.size(); ++i)
        if (lower_case(stated[i].name) == lower_case(name)) return i;
      return std::nullopt;
    }
  };

  void unknown_member(const MeshSource::Set& set, const std::string& member) {
    faults_.add(set.line, "sets with unknown members",
                fmt::format("set \"{}\": the file has no {}", shown(set.name), member));
  }

  /// Members of a set: `own` adds those that it does not have from other sets.
  template <class Own>
  const Members& resolve(Sets& sets, std::size_t i, int depth, const Own& own) {
    if (sets.known[i]) return *sets.known[i];
    constexpr int kDeepest = 20;
    const MeshSource::Set& set = sets.stated[i];
    Members members;
    own(set, members);
    const std::set<std::string> names(set.sets.begin(), set.sets.end());
    for (const std::string& name : names) {
      const auto other = sets.find(name);
      if (!other || depth == kDeepest) {
        unknown_member(set,
                       fmt::format("{} \"{}\"{}", sets.what, shown(name), other ? " besides itself" : ""));
        continue;
      }
      const Members& more = resolve(sets, *other, depth + 1, own);
      members.insert(members.end(), more.begin(), more.end());
    }
    make_unique(members);
    if (!sets.known[i]) sets.known[i] = std::move(members);
    return *sets.known[i];
  }

  /// Elements that are no hexahedra are left out.
  void resolve_element_sets() {
    element_sets_.known.resize(element_sets_.stated.size());
    for (std::size_t i = 0; i < element_sets_.known.size(); ++i)
      resolve(element_sets_, i, 0, [&](const MeshSource::Set& set, Members& members) {
        for (const NumberRange& range : set.numbers)
          elements_.visit(range, [&](std::int32_t place) { members.push_back(place); });
      });
  }

  void resolve_node_sets() {
    node_sets_.known.resize(node_sets_.stated.size());
    for (std::size_t i = 0; i < node_sets_.known.size(); ++i)
      resolve(node_sets_, i, 0, [&](const MeshSource::Set& set, Members& members) {
        for (const NumberRange& range : set.numbers)
          if (!nodes_.visit(range, [&](std::int32_t place) { members.push_back(place); }))
            unknown_member(set, fmt::format("node {}", range.first));
        for (const std::string& name : set.element_sets) add_faces_of(set, {name, 0, -1}, members);
        for (const FaceOfElements& face : set.faces) add_faces_of(set, face, members);
      });
  }

  /// Elements of the wanted parts.
  void choose() {
    chosen_.assign(source_.elements.size(), wish_.parts.empty());
    for (const std::string& part : wish_.parts)
      if (!choose_part(part) && !choose_set(part))
        faults_.add(
            0, "parts that are missing",
            fmt::format("there is no part \"{}\" with hexahedra; there are {}", shown(part), names()));
    if (source_.elements.empty())
      faults_.add(0, "empty meshes", "there are no hexahedra of 8 nodes: is it the right file?");
  }

  /// Name of a part, its number where the file has none.
  std::string part_name(std::int64_t part) const {
    const auto name = source_.parts.find(part);
    return name == source_.parts.end() ? std::to_string(part) : name->second;
  }

  /// Chooses the elements of the part of that number, or else of that name; false where there is none. Fault:
  /// several parts of the name.
  bool choose_part(const std::string& wanted) {
    std::set<std::int64_t> parts, named;
    for (const MeshSource::Element& element : source_.elements) parts.insert(element.part);
    const auto number = source_.numbers_parts ? integer_of(wanted) : std::nullopt;
    if (number && parts.contains(*number))
      named = {*number};
    else
      std::copy_if(parts.begin(), parts.end(), std::inserter(named, named.end()),
                   [&](std::int64_t part) { return lower_case(part_name(part)) == lower_case(wanted); });
    if (named.size() > 1)
      faults_.add(0, "parts of one name",
                  fmt::format("there are {} parts \"{}\", numbers {}; state the number of one, or a set of "
                              "elements that holds all",
                              named.size(), shown(wanted), number_list({named.begin(), named.end()})));
    for (std::size_t e = 0; e < chosen_.size(); ++e)
      if (named.contains(source_.elements[e].part)) chosen_[e] = true;
    return !named.empty();
  }

  /// Chooses the elements of the set of that name; false where there is none. Fault: several sets.
  bool choose_set(const std::string& name) {
    std::vector<const Members*> all;
    for (std::size_t i = 0; i < element_sets_.known.size(); ++i)
      if (lower_case(element_sets_.stated[i].name) == lower_case(name) && !element_sets_.known[i]->empty())
        all.push_back(&*element_sets_.known[i]);
    if (all.size() > 1) {
      std::vector<std::int64_t> sizes;
      for (const Members* set : all) sizes.push_back(static_cast<std::int64_t>(set->size()));
      faults_.add(
          0, "sets of one name",
          fmt::format("there are {} sets of elements \"{}\", of {} hexahedra; give each a name of its "
                      "own in the file",
                      all.size(), shown(name), number_list(sizes)));
      return true;
    }
    for (const Members* set : all)
      for (const std::int32_t e : *set) chosen_[index(e)] = true;
    return !all.empty();
  }

  std::string names() const {
    std::set<std::string> known;
    for (const MeshSource::Element& element : source_.elements) known.insert(part_name(element.part));
    for (const MeshSource::Set& set : source_.element_sets) known.insert(set.name);
    std::string text;
    constexpr std::size_t kMost = 12;
    std::size_t listed = 0;
    for (const std::string& name : known) {
      if (listed++ == kMost) return text + ", ...";
      text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
    }
    return text;
  }

  void number_nodes() {
    HexMesh& mesh = result_.mesh;
    node_.assign(source_.nodes.size(), -1);
    element_.assign(source_.elements.size(), -1);
    for (std::size_t e = 0; e < chosen_.size(); ++e)
      for (std::size_t i = 0; chosen_[e] && i < 8; ++i) node_[index(corners_[e][i])] = 0;
    for (std::size_t n = 0; n < node_.size(); ++n) {
      if (node_[n] < 0) continue;
      node_[n] = static_cast<std::int32_t>(mesh.nodes.size());
      mesh.nodes.push_back(wish_.unit * source_.nodes[n].at);
      mesh.node_number.push_back(source_.nodes[n].number);
    }
    std::map<std::int64_t, std::int32_t> parts;
    for (std::size_t e = 0; e < chosen_.size(); ++e) {
      if (!chosen_[e]) continue;
      const MeshSource::Element& element = source_.elements[e];
      HexCorners corners;
      for (std::size_t i = 0; i < 8; ++i) corners[i] = node_[index(corners_[e][i])];
      element_[e] = static_cast<std::int32_t>(mesh.elements.size());
      mesh.elements.push_back(corners);
      mesh.element_number.push_back(element.number);
      lines_.push_back(element.line);
      const auto [part, added] =
          parts.try_emplace(element.part, static_cast<std::int32_t>(mesh.parts.size()));
      if (added) mesh.parts.push_back(part_name(element.part));
      mesh.part.push_back(part->second);
    }
    const std::size_t left = source_.nodes.size() - mesh.nodes.size();
    const auto first = std::find(node_.begin(), node_.end(), -1);
    if (left > 0)
      result_.notes.push_back(fmt::format(
          "{} nodes belong to no {}hexahedron and are left out, the first is node {}", left,
          wish_.parts.empty() ? "" : "chosen ", source_.nodes[index(first - node_.begin())].number));
  }

  void add_sets() {
    keep(element_sets_, element_, "elements", result_.mesh.element_sets);
    keep(node_sets_, node_, "nodes", result_.mesh.node_sets);
  }

  /// Stores sets by name; each of several of one name gets a number, "tread (1)".
  void keep(const Sets& of, const std::vector<std::int32_t>& known, const char* what,
            std::map<std::string, Members>& sets) {
    std::vector<Members> all;
    std::map<std::string, int> times;
    for (std::size_t i = 0; i < of.known.size(); ++i) {
      all.push_back(members_in_mesh(of.stated[i], *of.known[i], known, what));
      if (!all.back().empty()) ++times[of.stated[i].name];
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].empty()) continue;
      std::string name = of.stated[i].name;
      if (times[name] > 1)
        for (int copy = 1; times.contains(name) || sets.contains(name); ++copy)
          name = fmt::format("{} ({})", of.stated[i].name, copy);
      sets.emplace(std::move(name), std::move(all[i]));
    }
  }

  /// Members of a set that belong to the mesh, with notes on the others.
  Members members_in_mesh(const MeshSource::Set& set, const Members& places,
                          const std::vector<std::int32_t>& known, const char* what) {
    Members members;
    for (const std::int32_t place : places)
      if (known[index(place)] >= 0) members.push_back(known[index(place)]);
    make_unique(members);
    if (members.empty()) {
      result_.notes.push_back(
          fmt::format("set \"{}\" has no {} of the mesh and is left out", shown(set.name), what));
    } else if (members.size() < places.size()) {
      result_.notes.push_back(fmt::format("set \"{}\": {} of {} {} belong to the mesh", shown(set.name),
                                          members.size(), places.size(), what));
    }
    return members;
  }

  /// Nodes of one face of elements, or of all.
  void add_faces_of(const MeshSource::Set& set, const FaceOfElements& of, Members& members) {
    Members elements;
    if (of.elements.empty()) {
      elements = {elements_.place(of.element)};
      if (elements[0] < 0) return unknown_member(set, fmt::format("hexahedron {}", of.element));
    } else if (const auto named = element_sets_.find(of.elements)) {
      elements = *element_sets_.known[*named];
    } else {
      return unknown_member(set, fmt::format("set of elements \"{}\"", shown(of.elements)));
    }
    for (const std::int32_t e : elements)
      for (std::size_t i = 0; i < (of.face < 0 ? 8U : 4U); ++i)
        members.push_back(corners_[index(e)][of.face < 0 ? i : kHexFaces[index(of.face)][i]]);
  }

  const MeshSource& source_;
  const MeshWish& wish_;
  MeshFaults& faults_;
  Numbers nodes_, elements_;
  ImportedMesh result_;
  std::string ignored_;
  std::vector<HexCorners> corners_;  ///< places in the file's list of nodes
  Sets element_sets_, node_sets_;
  std::vector<char> chosen_;                  ///< by element of the file
  std::vector<std::int32_t> node_, element_;  ///< index in the mesh by place in the file, or -1
  std::vector<int> lines_;
};

}  // namespace

ImportedMesh numbered_mesh(const MeshSource& source, const MeshWish& wish, MeshFaults& faults,
                           std::vector<int>& lines) {
  MeshNumbering numbering(source, wish, faults);
  ImportedMesh result = numbering.make();
  lines = numbering.lines();
  return result;
}

}  // namespace tread
