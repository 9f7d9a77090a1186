#include "io/mesh/gmsh_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <utility>

namespace tread {

namespace {

/// An element type by its number in the file.
struct Kind {
  const char* name;
  int dimension;
};

/// Types up to order 2; others have numbers above.
constexpr std::array<Kind, 20> kKinds = {{{"unknown element", 3},    {"2-node line", 1},
                                          {"3-node triangle", 2},    {"4-node quadrangle", 2},
                                          {"4-node tetrahedron", 3}, {"8-node hexahedron", 3},
                                          {"6-node prism", 3},       {"5-node pyramid", 3},
                                          {"3-node line", 1},        {"6-node triangle", 2},
                                          {"9-node quadrangle", 2},  {"10-node tetrahedron", 3},
                                          {"27-node hexahedron", 3}, {"18-node prism", 3},
                                          {"14-node pyramid", 3},    {"point", 0},
                                          {"8-node quadrangle", 2},  {"20-node hexahedron", 3},
                                          {"15-node prism", 3},      {"13-node pyramid", 3}}};
constexpr std::int64_t kHexahedron = 5;

constexpr const char* kSave = "in Gmsh: File, Export, \"Version 4 ASCII\"";

/// Dimension and tag.
using Entity = std::pair<std::int64_t, std::int64_t>;

class GmshMesh {
 public:
  GmshMesh(std::string_view text, MeshFaults& faults) : lines_(text), faults_(faults) {}

  MeshSource read() {
    source_.format = "Gmsh";
    while (!stopped_ && lines_.next()) {
      const std::string section(lines_.line().substr(0, lines_.line().find_last_not_of(" \t") + 1));
      if (section.empty()) continue;
      if (section.starts_with('$'))
        read_section(section.substr(1));
      else
        stop(fmt::format("\"{}\": expected the beginning of a section, such as $Nodes", shown(section)));
    }
    if (!stopped_) finish();
    return std::move(source_);
  }

 private:
  void fault(const std::string& kind, std::string message) {
    faults_.add(lines_.number(), kind, std::move(message));
  }
  /// Ends the reading.
  void stop(const std::string& message) {
    fault("faults that end the reading", message);
    stopped_ = true;
  }

  void read_section(const std::string& name) {
    section_ = name;
    if (name == "MeshFormat")
      read_format();
    else if (version_ == 0)
      stop("the file does not begin with $MeshFormat");
    else if (name == "PhysicalNames")
      read_names();
    else if (name == "Entities")
      read_entities();
    else if (name == "Nodes")
      read_nodes();
    else if (name == "Elements")
      read_elements();
    else if (name == "PartitionedEntities")
      stop("the mesh is cut into partitions; save it without them");
    else
      return skip();
    if (stopped_) return;
    const std::string end = "$End" + section_;
    while (lines_.next()) {
      if (lines_.line().starts_with(end)) return;
      if (MeshFields::between_blanks(lines_.line()).size() > 0)
        return stop(fmt::format("\"{}\": expected {} behind as many rows as ${} states", shown(lines_.line()),
                                end, section_));
    }
    stop(fmt::format("there is no line {}: is the file cut off?", end));
  }

  /// Goes to the line that ends a section which is not read.
  void skip() {
    ++source_.ignored["$" + section_];
    const std::string end = "$End" + section_;
    while (lines_.next())
      if (lines_.line().starts_with(end)) return;
    stop(fmt::format("there is no line {}: is the file cut off?", end));
  }

  /// The next line's fields; false at the end of the section.
  bool next(MeshFields& fields) {
    while (lines_.next()) {
      if (lines_.line().starts_with('$')) break;
      fields = MeshFields::between_blanks(lines_.line());
      if (fields.size() > 0) return true;
    }
    stop(fmt::format("${} ends before it is whole: is the file cut off?", section_));
    return false;
  }

  /// The first `count` fields as integers; false, and the end of the reading, where there are none.
  bool integers(const MeshFields& fields, std::size_t count, std::int64_t* values) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = integer_of(fields[i]);
      if (!value) {
        stop(fmt::format("\"{}\" in ${}: expected {} whole numbers", shown(lines_.line()), section_, count));
        return false;
      }
      values[i] = *value;
    }
    return true;
  }

  void read_format() {
    MeshFields fields;
    if (!next(fields)) return;
    const auto version = real_of(fields[0]);
    std::int64_t binary = 0;
    if (!version || !integers(MeshFields::between_blanks(fields[1]), 1, &binary)) {
      stop(fmt::format("\"{}\": expected the version of the format", shown(lines_.line())));
    } else if (*version != 4.0 && *version != 4.1) {
      stop(fmt::format("version {:g} of the format; versions 4.0 and 4.1 are read: save the mesh anew, {}",
                       *version, kSave));
    } else if (binary != 0) {
      stop(fmt::format("the file is binary; save the mesh as text, {}", kSave));
    }
    if (stopped_) return;
    version_ = *version;
    source_.format = fmt::format("Gmsh {:.1f}", version_);
  }

  void read_names() {
    MeshFields fields;
    std::int64_t count = 0;
    if (!next(fields) || !integers(fields, 1, &count)) return;
    for (std::int64_t i = 0; i < count && next(fields); ++i) {
      std::array<std::int64_t, 2> entity{};
      if (!integers(fields, 2, entity.data())) return;
      const std::string_view line = lines_.line();
      const std::size_t first = line.find('"'), last = line.rfind('"');
      if (first == last) return stop(fmt::format("\"{}\": expected a name in quotes", shown(line)));
      names_[{entity[0], entity[1]}] =
          std::string(line.substr(first + 1, std::min(last - first - 1, std::size_t{70})));
    }
  }

  /// Long lines: fields are walked through here, not stored.
  void read_entities() {
    MeshFields fields;
    std::array<std::int64_t, 4> counts{};
    if (!next(fields) || !integers(fields, 4, counts.data())) return;
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t i = 0; i < counts[dimension]; ++i) {
        if (!next(fields)) return;
        const std::size_t before = dimension == 0 && version_ > 4.0 ? 4 : 7;  // the tag, and a point or a box
        std::int64_t tag = 0, physicals = 0;
        const auto stated = integer_of(fields[before]);
        if (!integers(fields, 1, &tag)) return;
        physicals = stated.value_or(-1);
        if (physicals < 0 || physicals > static_cast<std::int64_t>(MeshFields::kMost))
          return stop(fmt::format("entity {} of dimension {}: expected the number of its physical groups",
                                  tag, dimension));
        for (std::int64_t k = 0; k < physicals; ++k) {
          const auto group = integer_of(fields[before + 1 + static_cast<std::size_t>(k)]);
          if (!group)
            return stop(
                fmt::format("entity {} of dimension {}: a physical group is missing", tag, dimension));
          groups_[{dimension, tag}].push_back(std::abs(std::max(*group, -INT64_MAX)));
        }
      }
  }

  void read_nodes() {
    MeshFields fields;
    std::array<std::int64_t, 4> head{};
    if (!next(fields) || !integers(fields, version_ > 4.0 ? 4 : 2, head.data())) return;
    for (std::int64_t block = 0; block < head[0]; ++block) {
      std::array<std::int64_t, 4> of_block{};  // dimension and tag, or tag and dimension; parametric; count
      if (!next(fields) || !integers(fields, 4, of_block.data())) return;
      std::vector<std::int64_t> tags;
      for (std::int64_t i = 0; version_ > 4.0 && i < of_block[3]; ++i) {
        std::int64_t tag = 0;
        if (!next(fields) || !integers(fields, 1, &tag)) return;
        tags.push_back(tag);
      }
      for (std::int64_t i = 0; i < of_block[3]; ++i) {
        if (!next(fields)) return;
        std::int64_t tag = 0;
        const std::size_t first = version_ > 4.0 ? 0 : 1;
        if (version_ > 4.0)
          tag = tags[static_cast<std::size_t>(i)];
        else if (!integers(fields, 1, &tag))
          return;
        add_node(tag, fields, first);
      }
    }
    if (static_cast<std::int64_t>(source_.nodes.size()) != head[1] && faults_.empty())
      fault("wrong counts", fmt::format("$Nodes states {} nodes and has {}", head[1], source_.nodes.size()));
  }

  void add_node(std::int64_t number, const MeshFields& fields, std::size_t first) {
    Vec3 at;
    for (int i = 0; i < 3; ++i) {
      const std::string_view field = fields[first + static_cast<std::size_t>(i)];
      const auto value = real_of(field);
      if (!value)
        return fault("nodes with wrong places",
                     fmt::format("node {}: \"{}\" is not a finite number", number, shown(field)));
      at[i] = *value;
    }
    source_.nodes.push_back({number, at, lines_.number()});
  }

  void read_elements() {
    MeshFields fields;
    std::array<std::int64_t, 4> head{};
    if (!next(fields) || !integers(fields, version_ > 4.0 ? 4 : 2, head.data())) return;
    for (std::int64_t block = 0; block < head[0]; ++block) {
      std::array<std::int64_t, 4> of_block{};
      if (!next(fields) || !integers(fields, 4, of_block.data())) return;
      const auto [one, two, kind, count] = of_block;
      const Entity entity = version_ > 4.0 ? Entity{one, two} : Entity{two, one};
      for (std::int64_t i = 0; i < count; ++i) {
        if (!next(fields)) return;
        std::int64_t number = 0;
        if (!integers(fields, 1, &number)) return;
        if (kind == kHexahedron && !add_hexahedron(number, entity.second, fields)) return;
        if (kind != kHexahedron && !add_other(number, kind, entity, fields)) return;
      }
    }
  }

  bool add_hexahedron(std::int64_t number, std::int64_t volume, const MeshFields& fields) {
    if (number <= 0) {
      stop(fmt::format("element {}: expected a number above 0", number));
      return false;
    }
    if (fields.size() != 9) {
      fault("elements that are no hexahedra",
            fmt::format("element {} has {} nodes in place of 8", number, fields.size() - 1));
      return true;
    }
    MeshSource::Element element{number, volume, {}, lines_.number()};
    for (std::size_t i = 0; i < 8; ++i) {
      const auto node = integer_of(fields[1 + i]);
      if (!node) {
        stop(fmt::format("element {}: \"{}\" is not the number of a node", number, shown(fields[1 + i])));
        return false;
      }
      element.nodes[i] = *node;
    }
    source_.parts.try_emplace(volume, fmt::format("volume {}", volume));
    source_.elements.push_back(element);
    members_[{3, volume}].push_back({number, number});
    return true;
  }

  /// Volumes of another kind are refused; faces, edges and points give their nodes to physical groups.
  bool add_other(std::int64_t number, std::int64_t kind, const Entity& entity, const MeshFields& fields) {
    const bool known = kind > 0 && kind < static_cast<std::int64_t>(kKinds.size());
    const Kind& of = kKinds[known ? static_cast<std::size_t>(kind) : 0];
    if (of.dimension == 3) {
      fault(
          "elements that are no hexahedra of 8 nodes",
          fmt::format("element {} is {} {} (type {}); only 8-node hexahedra are read: in Gmsh, recombine the "
                      "mesh and keep order 1",
                      number, of.name[0] == 'u' || of.name[0] == '8' ? "an" : "a", of.name, kind));
      return true;
    }
    if (!groups_.contains(entity)) return true;
    for (std::size_t i = 1; i < fields.size(); ++i) {
      const auto node = integer_of(fields[i]);
      if (!node) {
        stop(fmt::format("element {}: \"{}\" is not the number of a node", number, shown(fields[i])));
        return false;
      }
      members_[entity].push_back({*node, *node});
    }
    return true;
  }

  std::string name_of(const Entity& group) const {
    static constexpr const char* kGroups[] = {"point group", "curve group", "surface group", "volume group"};
    const auto found = names_.find(group);
    return found != names_.end() && !found->second.empty()
               ? found->second
               : fmt::format("{} {}", kGroups[static_cast<std::size_t>(group.first)], group.second);
  }

  void finish() {
    if (version_ == 0) return stop("the file does not begin with $MeshFormat: is it a mesh of Gmsh?");
    std::map<Entity, MeshSource::Set> sets;
    for (const auto& [entity, groups] : groups_)
      for (const std::int64_t group : groups) {
        MeshSource::Set& set = sets[{entity.first, group}];
        const auto numbers = members_.find(entity);
        if (numbers != members_.end())
          set.numbers.insert(set.numbers.end(), numbers->second.begin(), numbers->second.end());
      }
    for (auto& [group, set] : sets) {
      set.name = name_of(group);
      if (!set.numbers.empty()) (group.first == 3 ? source_.element_sets : source_.node_sets).push_back(set);
    }
  }

  MeshLines lines_;
  MeshFaults& faults_;
  MeshSource source_;
  std::string section_;
  double version_ = 0;
  bool stopped_ = false;
  std::map<Entity, std::string> names_;
  std::map<Entity, std::vector<std::int64_t>> groups_;  ///< physical groups of an entity
  std::map<Entity, std::vector<NumberRange>> members_;  ///< elements of volumes, nodes of other entities
};

}  // namespace

MeshSource read_gmsh_mesh(std::string_view text, MeshFaults& faults) {
  return GmshMesh(text, faults).read();
}

}  // namespace tread
