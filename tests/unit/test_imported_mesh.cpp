// Meshes of other programs: one bar in every format.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh/imported_mesh.hpp"
#include "kernels/element/element.hpp"
#include "tests/mesh_files.hpp"

namespace tread {
namespace {

using namespace samples;

ImportedMesh sound(const MeshFile& file, const MeshWish& wish = {1e-3, {}, 1}) {
  MeshFaults faults;
  ImportedMesh mesh = mesh_of(file.text, file.name, wish, faults);
  for (const LineFault& fault : faults.list())
    ADD_FAILURE() << file.name << ":" << fault.line << ": " << fault.message;
  return mesh;
}

std::vector<std::int64_t> numbers(const std::vector<std::int64_t>& all,
                                  const std::vector<std::int32_t>& indices) {
  std::vector<std::int64_t> list;
  for (const std::int32_t i : indices) list.push_back(all[static_cast<std::size_t>(i)]);
  return list;
}

TEST(ImportedMesh, IsTheSameInEveryFormat) {
  for (const MeshFile& file : files()) {
    const ImportedMesh imported = sound(file);
    const HexMesh& mesh = imported.mesh;
    ASSERT_EQ(mesh.nodes.size(), 36U) << file.name;
    ASSERT_EQ(mesh.elements.size(), 12U) << file.name;
    std::size_t n = 0;
    BarMesh::for_each_node([&](int number, double x, double y, double z) {
      EXPECT_EQ(mesh.node_number[n], number);
      EXPECT_LT(norm(mesh.nodes[n++] - 1e-3 * Vec3{x, y, z}), 1e-17);
    });
    BarMesh::for_each_element([&](int number, int part, const std::array<int, 8>& nodes) {
      const auto at = std::find(mesh.element_number.begin(), mesh.element_number.end(), number);
      ASSERT_NE(at, mesh.element_number.end()) << file.name;
      const auto e = static_cast<std::size_t>(at - mesh.element_number.begin());
      for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(mesh.node_number[static_cast<std::size_t>(mesh.elements[e][i])], nodes[i]);
      const std::string& name = mesh.parts[static_cast<std::size_t>(mesh.part[e])];
      const std::string expected = part == 3 ? "left end" : "right end";
      if (imported.format.starts_with("Gmsh")) {
        EXPECT_EQ(name, part == 3 ? "volume 5" : "volume 6");
        EXPECT_EQ(mesh.element_sets.at(expected).size(), part == 3 ? 4U : 8U);
      } else {
        EXPECT_EQ(name, expected);
      }
    });
    const std::vector<int> bottom = BarMesh::bottom();
    const std::vector<std::int64_t> expected(bottom.begin(), bottom.end());
    EXPECT_EQ(numbers(mesh.node_number, mesh.node_sets.at("bottom")), expected) << file.name;
  }
}

TEST(ImportedMesh, KeepsSetsOfElementsAndFaces) {
  const HexMesh deck = sound(files()[0]).mesh;
  EXPECT_EQ(numbers(deck.element_number, deck.element_sets.at("5")), (std::vector<std::int64_t>{11, 12, 13}));
  EXPECT_EQ(deck.node_sets.at("segments 1"), deck.node_sets.at("bottom"));
  const HexMesh abaqus = sound(files()[4]).mesh;
  EXPECT_EQ(abaqus.element_sets.at("whole").size(), 12U);
  EXPECT_EQ(abaqus.element_sets.at("row").size(), 3U);
  EXPECT_EQ(abaqus.node_sets.at("face"), abaqus.node_sets.at("bottom"));
  EXPECT_EQ(abaqus.node_sets.at("ALL").size(), 36U);
}

/// Gmsh lets a curve and a surface have one name, keyword decks two sets.
TEST(ImportedMesh, SetsOfOneNameAreNumbered) {
  std::string text = gmsh_file("4.1");
  const auto replace = [&](const std::string& before, const std::string& after) {
    ASSERT_NE(text.find(before), std::string::npos) << before;
    text.replace(text.find(before), before.size(), after);
  };
  replace("$PhysicalNames\n3\n", "$PhysicalNames\n4\n1 4 \"bottom\"\n");
  replace("$Entities\n1 0 1 2\n1 0 0 0 0\n", "$Entities\n1 1 1 2\n1 0 0 0 0\n3 0 0 0 30 0 0 1 4 0\n");
  replace("3 18 11 205\n", "4 19 11 300\n1 3 1 1\n300 101 102\n");
  const HexMesh mesh = sound({"a.msh", text}).mesh;
  EXPECT_FALSE(mesh.node_sets.contains("bottom"));
  EXPECT_EQ(numbers(mesh.node_number, mesh.node_sets.at("bottom (1)")),
            (std::vector<std::int64_t>{101, 102}));
  EXPECT_EQ(mesh.node_sets.at("bottom (2)").size(), 12U);

  text = keyword_file(SolidCards::one);
  replace("*DATABASE",
          "*SET_SOLID_TITLE\nrow\n         8\n        11        12        13\n"
          "*SET_SOLID_TITLE\nrow\n         9\n        14\n*DATABASE");
  EXPECT_EQ(sound({"a.k", text}).mesh.elements.size(), 12U);
  MeshFaults faults;
  mesh_of(text, "a.k", {1e-3, {"row"}, 1}, faults);
  ASSERT_EQ(faults.list().size(), 1U);
  EXPECT_EQ(faults.list().front().message,
            "there are 2 sets of elements \"row\", of 3 and 1 hexahedra; give each a name of its own in the "
            "file");
}

TEST(ImportedMesh, NamesWhatItLeavesOut) {
  const auto noted = [](const MeshFile& file, const char* part) {
    std::string all;
    for (const std::string& note : sound(file, {1e-3, {"left end"}, 1}).notes) all += note + "\n";
    EXPECT_NE(all.find(part), std::string::npos) << all;
  };
  noted(files()[0], "not read: *DATABASE_GLSTAT, *TITLE");
  noted(files()[0], "18 nodes belong to no chosen hexahedron and are left out, the first is node 103");
  noted(files()[0], "set \"5\": 1 of 3 elements belong to the mesh");
  noted(files()[3], "not read: $NodeData");
  noted(files()[4], "not read: *SOLID SECTION");
  MeshFile with_point = files()[4];
  with_point.text += "*Assembly, name=a\n*Node\n101, 7., 7., 7.\n*Nset, nset=point\n101\n*End Assembly\n";
  noted(with_point, "not read: *NODE in *ASSEMBLY, *NSET in *ASSEMBLY without INSTANCE, *SOLID SECTION");
}

TEST(ImportedMesh, TakesPartsByNameNumberOrSet) {
  for (const MeshFile& file : files()) {
    EXPECT_EQ(sound(file, {1e-3, {"Left End"}, 1}).mesh.elements.size(), 4U) << file.name;
    EXPECT_EQ(sound(file, {1e-3, {"left end", "right end"}, 1}).mesh.elements.size(), 12U) << file.name;
  }
  EXPECT_EQ(sound(files()[0], {1e-3, {"7"}, 1}).mesh.elements.size(), 8U);
  EXPECT_EQ(sound(files()[4], {1e-3, {"row"}, 1}).mesh.elements.size(), 3U);
}

/// Only where the file has numbers of parts; two parts of a name are told apart by them.
TEST(ImportedMesh, TakesNumbersOfPartsBeforeNames) {
  const auto renamed = [](std::string text, const std::vector<std::pair<std::string, std::string>>& names) {
    for (const auto& [from, to] : names) text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::string deck = keyword_file(SolidCards::one);
  EXPECT_EQ(sound({"a.k", renamed(deck, {{"left end", "7"}})}, {1e-3, {"7"}, 1}).mesh.elements.size(), 8U);
  const std::string twins = renamed(deck, {{"left end", "right end"}});
  MeshFaults faults;
  mesh_of(twins, "a.k", {1e-3, {"Right end"}, 1}, faults);
  ASSERT_EQ(faults.list().size(), 1U);
  EXPECT_EQ(
      faults.list().front().message,
      "there are 2 parts \"Right end\", numbers 3 and 7; state the number of one, or a set of elements that "
      "holds all");
  EXPECT_EQ(sound({"a.k", twins}, {1e-3, {"3"}, 1}).mesh.elements.size(), 4U);
  const std::string sets = renamed(
      abaqus_file(),
      {{"ELSET=left end", "ELSET=2"}, {"ELSET=right end", "ELSET=1"}, {"LEFT END, \"right end\"", "11, 12"}});
  EXPECT_EQ(sound({"a.inp", sets}, {1e-3, {"1"}, 1}).mesh.elements.size(), 8U);
}

/// Other keywords of parts have other cards in the place of the title's.
TEST(ImportedMesh, TakesTitlesFromPartsAlone) {
  std::string text = keyword_file(SolidCards::one);
  text.insert(text.find("right end"), "*PART_INERTIA_CONTACT\n");
  text.insert(text.find("*NODE\n"), "       0.5\n*PART_SENSOR\n         3         5\n         4\n");
  const ImportedMesh imported = sound({"a.k", text});
  EXPECT_EQ(imported.mesh.parts, (std::vector<std::string>{"left end", "right end"}));
  EXPECT_EQ(imported.notes.front(), "not read: *DATABASE_GLSTAT, *PART_SENSOR, *TITLE");
}

TEST(ImportedMesh, ReadsNumbersInTenCharacters) {
  std::string text = "*KEYWORD I10=Y\n*NODE\n";
  BarMesh::for_each_node([&](int number, double x, double y, double z) {
    text += fmt::format("{:>10}{:>16}{:>16}{:>16}\n", 1'000'000'000 + number, x, y, z);
  });
  text += "*ELEMENT_SOLID\n";
  BarMesh::for_each_element([&](int number, int part, const std::array<int, 8>& nodes) {
    text += fmt::format("{:>10}{:>10}\n", 1'000'000'000 + number, part);
    for (const int node : nodes) text += fmt::format("{:>10}", 1'000'000'000 + node);
    text += '\n';
  });
  const HexMesh mesh = sound({"a.k", text + "*END\n"}).mesh;
  EXPECT_EQ(mesh.elements.size(), 12U);
  EXPECT_EQ(mesh.element_number.front(), 1'000'000'011);
}

TEST(ImportedMesh, ReadsSegmentsWithAttributes) {
  for (const bool commas : {false, true}) {
    std::string text = keyword_file(SolidCards::one);
    text.insert(text.find("*DATABASE"), "*SET_SEGMENT\n         2       0.0\n");
    for (const int node : {101, 105, 106, 102, -1, -1, -1, -1}) {
      const std::string field = node > 0 ? std::to_string(node) : "0.5";
      text.insert(text.find("*DATABASE"), commas ? field + "," : fmt::format("{:>10}", field));
    }
    text.insert(text.find("*DATABASE"), "\n");
    const HexMesh mesh = sound({"a.k", text}).mesh;
    EXPECT_EQ(numbers(mesh.node_number, mesh.node_sets.at("segments 2")),
              (std::vector<std::int64_t>{101, 102, 105, 106}));
  }
}

TEST(HexShape, IsThatOfTheElement) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  for (int round = 0; round < 20; ++round) {
    std::array<Vec3, 8> at = {
        {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 1}, {1, 0, 1}, {1, 2, 1}, {0, 2, 1}}};
    for (Vec3& node : at)
      for (int i = 0; i < 3; ++i) node[i] += shift(random);
    const HexShape shape = hex_shape(at);
    const ElementGeometry geometry = element_geometry(at);
    EXPECT_NEAR(shape.volume / geometry.volume, 1, 1e-14);
    EXPECT_NEAR(shape.smallest_jacobian, geometry.smallest_jacobian, 1e-13);
    EXPECT_LE(shape.shortest_edge, shape.longest_edge);
  }
}

TEST(ImportedMesh, ConsistsOfAsManyPiecesAsStated) {
  // The middle column of elements is left out.
  const MeshFile file = files()[4];
  std::string text = file.text;
  for (const char* element : {"12", "15", "18", "21"}) {
    const std::size_t at = text.find(fmt::format("\n{}, 1", element), text.find("right end")) + 1;
    text.erase(at, text.find('\n', text.find('\n', at) + 1) + 1 - at);
  }
  EXPECT_EQ(sound({"a.inp", text}, {1e-3, {}, 2}).mesh.elements.size(), 8U);
  MeshFaults faults;
  mesh_of(text, "a.inp", {1e-3, {}, 1}, faults);
  ASSERT_EQ(faults.list().size(), 1U);
  EXPECT_NE(faults.list().front().message.find("2 pieces without a common face (4 from element 11, 4 from "
                                               "element 13 on), and 1 is stated"),
            std::string::npos)
      << faults.list().front().message;
}

}  // namespace
}  // namespace tread
