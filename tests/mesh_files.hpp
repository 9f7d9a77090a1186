#pragma once
// A bar of hexahedra in the formats of other programs.

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tread::samples {

/// 3 x 2 x 2 hexahedra of 10 mm, 5 mm and 4 mm; two parts along x; numbers with gaps. Lengths in mm.
class BarMesh {
 public:
  static constexpr std::array<int, 3> kElements = {3, 2, 2};

  static int node(int i, int j, int k) { return 101 + i + 4 * (j + 3 * k); }
  static int element(int i, int j, int k) { return 11 + i + 3 * (j + 2 * k); }
  static int part(int i) { return i == 0 ? 3 : 7; }

  template <class Visit>
  static void for_each_node(const Visit& visit) {
    for (int k = 0; k <= kElements[2]; ++k)
      for (int j = 0; j <= kElements[1]; ++j)
        for (int i = 0; i <= kElements[0]; ++i)
          visit(node(i, j, k), 10.0 * i, 5.0 * j + 0.25 * i * k, 4.0 * k);
  }
  /// visit(number, part, nodes)
  template <class Visit>
  static void for_each_element(const Visit& visit) {
    for (int k = 0; k < kElements[2]; ++k)
      for (int j = 0; j < kElements[1]; ++j)
        for (int i = 0; i < kElements[0]; ++i)
          visit(element(i, j, k), part(i),
                std::array<int, 8>{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                   node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                   node(i, j + 1, k + 1)});
  }
  /// Nodes of the faces at z = 0.
  static std::vector<int> bottom() {
    std::vector<int> nodes;
    for (int j = 0; j <= kElements[1]; ++j)
      for (int i = 0; i <= kElements[0]; ++i) nodes.push_back(node(i, j, 0));
    return nodes;
  }
};

enum class SolidCards { one, two };

inline std::string keyword_file(SolidCards cards) {
  std::string text = "*KEYWORD\n$ a bar\n*TITLE\nbar\n*PART\nleft end\n";
  text += fmt::format("{:>10}{:>10}{:>10}\n", 3, 1, 1);
  text += fmt::format("right end\n{:>10}{:>10}{:>10}\n*NODE\n$#   nid               x\n", 7, 1, 1);
  BarMesh::for_each_node([&](int number, double x, double y, double z) {
    text += fmt::format("{:>8}{:>16}{:>16}{:>16}{:>8}{:>8}\n", number, x, y, z, 0, 0);
  });
  text += cards == SolidCards::one ? "*ELEMENT_SOLID\n" : "*ELEMENT_SOLID (ten nodes format)\n";
  BarMesh::for_each_element([&](int number, int part, const std::array<int, 8>& nodes) {
    text += fmt::format("{:>8}{:>8}", number, part);
    if (cards == SolidCards::two) text += '\n';
    for (const int node : nodes) text += fmt::format("{:>8}", node);
    text += cards == SolidCards::two ? "       0       0\n" : "\n";
  });
  text += "*SET_NODE_LIST_TITLE\nbottom\n         1\n";
  int column = 0;
  for (const int node : BarMesh::bottom())
    text += fmt::format("{:>10}{}", node, ++column % 8 == 0 ? "\n" : "");
  text += "\n*SET_SOLID_GENERATE\n         5\n        11        13\n*SET_SEGMENT\n         1\n";
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i)
      text += fmt::format("{:>10}{:>10}{:>10}{:>10}\n", BarMesh::node(i, j, 0), BarMesh::node(i, j + 1, 0),
                          BarMesh::node(i + 1, j + 1, 0), BarMesh::node(i + 1, j, 0));
  return text + "*DATABASE_GLSTAT\n       1.0\n*END\n";
}

inline std::string abaqus_file() {
  std::string text = "** a bar\n*Heading\n bar of hexahedra\n*Node, nset=ALL\n";
  BarMesh::for_each_node([&](int number, double x, double y, double z) {
    text += fmt::format("{}, {}, {}, {}\n", number, x, y, z);
  });
  for (const int part : {3, 7}) {
    text += fmt::format("*ELEMENT, TYPE=C3D8R,\n ELSET={}\n", part == 3 ? "left end" : "right end");
    BarMesh::for_each_element([&](int number, int of, const std::array<int, 8>& nodes) {
      if (of != part) return;
      text += fmt::format("{},", number);
      for (std::size_t i = 0; i < 8; ++i)
        text += fmt::format(" {}{}", nodes[i], i == 3 ? ",\n" : i < 7 ? "," : "");
      text += '\n';
    });
  }
  text += "*NSET, NSET=bottom, GENERATE\n101, 112\n*ELSET, ELSET=whole\nLEFT END, \"right end\"\n";
  text += "*Elset, elset=row, generate\n11, 13, 1\n*Elset, elset=below, generate\n11, 16\n";
  text += "*SURFACE, TYPE=ELEMENT, NAME=face\nbelow, S1\n*SOLID SECTION, ELSET=whole, MATERIAL=steel\n1.,\n";
  return text;
}

/// `version`: "4.0" or "4.1"
inline std::string gmsh_file(const std::string& version) {
  const bool new_order = version == "4.1";
  std::string nodes, tags, elements[2];
  BarMesh::for_each_node([&](int number, double x, double y, double z) {
    tags += fmt::format("{}\n", number);
    nodes += new_order ? fmt::format("{} {} {}\n", x, y, z) : fmt::format("{} {} {} {}\n", number, x, y, z);
  });
  int count[2] = {0, 0};
  BarMesh::for_each_element([&](int number, int part, const std::array<int, 8>& corners) {
    const int of = part == 3 ? 0 : 1;
    ++count[of];
    elements[of] += fmt::format("{}", number);
    for (const int corner : corners) elements[of] += fmt::format(" {}", corner);
    elements[of] += '\n';
  });
  std::string quads;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i)
      quads +=
          fmt::format("{} {} {} {} {}\n", 200 + i + 3 * j, BarMesh::node(i, j, 0), BarMesh::node(i, j + 1, 0),
                      BarMesh::node(i + 1, j + 1, 0), BarMesh::node(i + 1, j, 0));
  const auto block = [&](int dimension, int tag, int more, int number) {
    return new_order ? fmt::format("{} {} {} {}\n", dimension, tag, more, number)
                     : fmt::format("{} {} {} {}\n", tag, dimension, more, number);
  };
  std::string text = fmt::format("$MeshFormat\n{} 0 8\n$EndMeshFormat\n", version);
  text += "$PhysicalNames\n3\n2 1 \"bottom\"\n3 2 \"left end\"\n3 3 \"right end\"\n$EndPhysicalNames\n";
  text += "$Entities\n1 0 1 2\n" + std::string(new_order ? "1 0 0 0 0\n" : "1 0 0 0 0 0 0 0\n");
  text += "9 0 0 0 30 10 0 1 1 0\n5 0 0 0 10 10 8 1 2 0\n6 10 0 0 30 10 8 1 3 0\n$EndEntities\n$Nodes\n";
  text += new_order ? "1 36 101 136\n" : "1 36\n";
  text += block(3, 5, 0, 36) + (new_order ? tags : "") + nodes + "$EndNodes\n$Elements\n";
  text += new_order ? "3 18 11 205\n" : "3 18\n";
  text += block(2, 9, 3, 6) + quads + block(3, 5, 5, count[0]) + elements[0] + block(3, 6, 5, count[1]) +
          elements[1];
  return text + "$EndElements\n$NodeData\n1\nanything\n$EndNodeData\n";
}

struct MeshFile {
  const char* name;
  std::string text;
};

/// The bar in every format.
inline std::vector<MeshFile> files() {
  return {{"a.k", keyword_file(SolidCards::one)},
          {"b.k", keyword_file(SolidCards::two)},
          {"c.msh", gmsh_file("4.0")},
          {"d.msh", gmsh_file("4.1")},
          {"e.inp", abaqus_file()},
          {"no suffix", keyword_file(SolidCards::one)},
          {"no suffix", gmsh_file("4.1")},
          {"no suffix", abaqus_file()}};
}

}  // namespace tread::samples
