// Meshes of other programs with one fault each, and the messages about them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh/imported_mesh.hpp"
#include "tests/mesh_files.hpp"

namespace tread {
namespace {

using namespace samples;

/// A file with one place changed, and words of the message that names the place.
struct Broken {
  const char* what;
  MeshFile file;
  std::string from, to;
  int line;  ///< of the message; 0: the file as a whole, -1: any
  std::vector<const char*> words;
};

std::vector<Broken> broken_decks() {
  const MeshFile deck = files()[0], two = files()[1];
  const std::string node = "     101               0", element = "      11       3     101     102     106";
  const std::string second = "      12       7     102     103";
  return {
      {"unknown node",
       deck,
       element,
       "      11       3     101     102     906",
       -1,
       {"element 11: the file has no node 906"}},
      {"repeated node",
       deck,
       element,
       "      11       3     101     102     102",
       -1,
       {"element 11: node 102 occurs more than once", "wedge"}},
      {"wrong node count",
       deck,
       "      11       3     101",
       "      11       3       0",
       -1,
       {"element 11 has 7 nodes; only hexahedra of 8 nodes"}},
      {"ten nodes",
       two,
       "       0       0\n      12",
       "     101     102\n      12",
       -1,
       {"element 11 has 10 nodes"}},
      {"same element number",
       deck,
       second,
       "      11       7     102     103",
       -1,
       {"element 11 is there already, in line"}},
      {"same node number", deck, "     102", "     101", -1, {"node 101 is there already, in line 12"}},
      {"node not finite",
       deck,
       node,
       "     101             nan",
       12,
       {"node 101: \"nan\" is not a finite number"}},
      {"node not a number", deck, node, "     101            0x10", 12, {"node 101: \"0x10\""}},
      {"no node number", deck, "     105", "     x05", -1, {"expected its number and its place"}},
      {"element without a number",
       deck,
       "      14       3",
       "      1a       3",
       -1,
       {"\"1a\" is not a number"}},
      {"cut off", deck, "*END\n", "", 0, {"there is no line *END"}},
      {"no elements", deck, "*ELEMENT_SOLID\n", "*ELEMENT_DISCRETE\n", 0, {"no hexahedra"}},
      {"cut in an element",
       two,
       "*ELEMENT_SOLID (ten nodes format)\n",
       "*ELEMENT_SOLID\n      99       3\n*ELEMENT_SOLID\n",
       -1,
       {"element 99: the card with its nodes is missing"}},
      {"include",
       deck,
       "*TITLE\nbar\n",
       "*INCLUDE\nmore.k\n",
       3,
       {"*INCLUDE is not read; put the files into one"}},
      {"long format", deck, "*KEYWORD", "*KEYWORD LONG=Y", -1, {"long format", "standard format"}},
      {"moved part", deck, "*TITLE\nbar\n", "*PART_MOVE\n", 3, {"*PART_MOVE is not read; write the mesh"}},
      {"copied part", deck, "*TITLE\nbar\n", "*PART_DUPLICATE\n", 3, {"*PART_DUPLICATE is not read"}},
      {"same part number",
       deck,
       "right end\n         7",
       "right end\n         3",
       9,
       {"part 3 is there already, \"left end\": each needs a number of its own"}},
      {"thick shells", deck, "*TITLE\nbar\n", "*ELEMENT_TSHELL\n", 3, {"*ELEMENT_TSHELL is not read"}},
      {"set with an unknown node",
       deck,
       "       101       102       103",
       "       101       902       103",
       -1,
       {"set \"bottom\": the file has no node 902"}},
      {"another unit",
       deck,
       "*TITLE\nbar\n",
       "*CONTROL_UNITS\nm         s\n",
       0,
       {"*CONTROL_UNITS", "--unit one of 0.001 m; state the file's"}},
  };
}

std::vector<Broken> broken_shapes() {
  const MeshFile file = files()[4];
  const std::string first = "11, 101, 102, 106, 105,\n 113, 114, 118, 117";
  return {
      {"inverted",
       file,
       first,
       "11, 113, 114, 118, 117,\n 101, 102, 106, 105",
       -1,
       {"element 11 is inverted", "nodes 5 to 8 before nodes 1 to 4"}},
      {"folded", file, first, "11, 101, 106, 102, 105,\n 113, 114, 118, 117", -1, {"element 11 is folded"}},
      {"flat", file, "113, 0, 0, 4", "113, 0, 0, 0", -1, {"element 11 has an edge of no length"}},
      {"copy",
       file,
       first,
       first + "\n911, 113, 114, 118, 117, 101, 102, 106, 105",
       -1,
       {"element 911 is inverted"}},
      {"same nodes",
       file,
       first,
       first + "\n911, 102, 106, 105, 101, 114, 118, 117, 113",
       -1,
       {"element 911 has the nodes of element 11"}},
      {"three on a face",
       file,
       first,
       first +
           "\n*NODE\n1, 5, 0, 0\n2, 5, 5, 0\n3, 5, 5, 4\n4, 5, 0, 4\n*ELEMENT, TYPE=C3D8, ELSET=left end\n"
           "911, 1, 2, 3, 4, 102, 106, 118, 114",
       -1,
       {"shares a face (nodes 102, 106, 114, 118)", "two elements at most"}},
      {"nodes on nodes",
       file,
       first,
       "11, 101, 936, 106, 105,\n 113, 114, 118, 117\n*NODE\n936, 10, 0.00001, 0\n"
       "*ELEMENT, TYPE=C3D8, ELSET=left end",
       -1,
       {"element 11 has node 936 on the place of node 102 of element 12", "merge coincident nodes"}},
      {"too far", file, "101, 0, 0, 0", "101, -1e300, 0, 0", -1, {"cannot tell such nodes apart"}},
  };
}

std::vector<Broken> broken_abaqus() {
  const MeshFile file = files()[4];
  return {
      {"tetrahedra", file, "C3D8R", "C3D4", -1, {"of type C3D4; only C3D8"}},
      {"quadratic", file, "C3D8R", "C3D20R", -1, {"of type C3D20R"}},
      {"seven nodes", file, "117, 118, 122, 121", "117, 118, 122", -1, {"has 7 nodes in place of 8"}},
      {"nine nodes",
       file,
       "117, 118, 122, 121",
       "117, 118, 122, 121, 120",
       -1,
       {"has 9 nodes in place of 8"}},
      {"cut in an element",
       file,
       "101, 102, 106, 105,\n 113, 114, 118, 117",
       "101, 102, 106, 105,\n*NODE",
       -1,
       {"element 11 ends after 4 of 8 nodes"}},
      {"include", file, "*Heading", "*INCLUDE, INPUT=more.inp", 2, {"*INCLUDE is not read"}},
      {"generation", file, "*Heading", "*NGEN", 2, {"*NGEN is not read; write every node"}},
      {"other axes", file, "*Node,", "*Node, SYSTEM=C,", -1, {"SYSTEM"}},
      {"plane node", file, "101, 0, 0, 0", "101, 0, 0", -1, {"node 101: \"\" is not a finite number"}},
      {"moved instance",
       file,
       "*NSET",
       "*Instance, name=a, part=b\n1., 0., 0.\n*NSET",
       -1,
       {"the instance is moved"}},
      {"sets of one name",
       file,
       "*NSET",
       "*Nset, nset=twin\n101\n*Assembly, name=a\n*Instance, name=i, part=p\n*End Instance\n"
       "*Nset, nset=Twin, instance=i\n102\n*End Assembly\n*NSET",
       -1,
       {"the set Twin of *ASSEMBLY has the name of one of its part"}},
      {"unknown set",
       file,
       "LEFT END,",
       "LEFT SIDE,",
       -1,
       {"set \"whole\": the file has no set of elements"}},
      {"set of itself", file, "LEFT END,", "whole,", -1, {"besides itself"}},
      {"wrong range", file, "101, 112", "112, 101", -1, {"expected first, last and step"}},
      {"too many values",
       file,
       "101, 112",
       "101, 112,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,1",
       -1,
       {"more than 32 values"}},
      {"unknown face", file, "below, S1", "below, S7", -1, {"S1 to S6"}},
  };
}

std::vector<Broken> broken_gmsh() {
  const MeshFile file = files()[3], old = files()[2];
  return {
      {"version 2", file, "4.1 0 8", "2.2 0 8", 2, {"version 2.2", "Version 4 ASCII"}},
      {"binary", file, "4.1 0 8", "4.1 1 8", 2, {"the file is binary; save the mesh as text"}},
      {"no format",
       file,
       "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
       "",
       1,
       {"does not begin with $MeshFormat"}},
      {"tetrahedra", file, "3 5 5 4", "3 5 4 4", -1, {"element 11 is a 4-node tetrahedron", "recombine"}},
      {"second order", file, "3 5 5 4", "3 5 12 4", -1, {"element 11 is a 27-node hexahedron"}},
      {"unknown type", old, "5 3 5 4", "5 3 99 4", -1, {"element 11 is an unknown element (type 99)"}},
      {"more nodes stated", file, "1 36 101 136", "1 37 101 136", -1, {"states 37 nodes and has 36"}},
      {"gigantic count", file, "3 5 0 36", "3 5 0 9000000000000000000", -1, {"ends before it is whole"}},
      {"fewer elements stated",
       file,
       "3 6 5 8",
       "3 6 5 7",
       -1,
       {"expected $EndElements behind as many rows"}},
      {"cut off",
       file,
       "$EndElements\n$NodeData\n1\nanything\n$EndNodeData\n",
       "",
       -1,
       {"is the file cut off?"}},
      {"unknown node", old, "11 101 102 106", "11 101 102 906", -1, {"element 11: the file has no node 906"}},
      {"nodes missing", file, "11 101 102 106", "11 101 102", -1, {"element 11 has 7 nodes in place of 8"}},
      {"number of an element",
       file,
       "\n11 101 102 106",
       "\n0 101 102 106",
       -1,
       {"element 0: expected a number above 0"}},
      {"infinite", file, "30 0 0\n", "inf 0 0\n", -1, {"node 104: \"inf\" is not a finite number"}},
      {"partitions", file, "$Entities", "$PartitionedEntities", -1, {"cut into partitions"}},
      {"text between", file, "$Nodes", "hello\n$Nodes", -1, {"expected the beginning of a section"}},
  };
}

void expect_refused(Broken broken) {
  std::string& text = broken.file.text;
  const std::size_t at = text.find(broken.from);
  ASSERT_NE(at, std::string::npos) << broken.what << ": the file has no such place: " << broken.from;
  text.replace(at, broken.from.size(), broken.to);
  MeshFaults faults;
  mesh_of(text, broken.file.name, {1e-3, {}, 1}, faults);
  std::string all;
  bool in_line = broken.line < 0;
  for (const LineFault& fault : faults.list()) {
    all += fmt::format("{}: {}\n", fault.line, fault.message);
    in_line = in_line || fault.line == broken.line;
  }
  EXPECT_TRUE(in_line) << broken.what << "\n" << all;
  for (const char* words : broken.words)
    EXPECT_NE(all.find(words), std::string::npos) << broken.what << "\n" << all;
}

TEST(BrokenMesh, IsRefusedWithItsElement) {
  for (const auto& list : {broken_decks(), broken_shapes(), broken_abaqus(), broken_gmsh()})
    for (const Broken& broken : list) expect_refused(broken);
}

TEST(BrokenMesh, EmptyAndForeignFilesAreNamed) {
  const auto refusal = [](const std::string& text, const char* name) {
    MeshFaults faults;
    mesh_of(text, name, {1e-3, {}, 1}, faults);
    return faults.empty() ? std::string() : faults.list().front().message;
  };
  EXPECT_EQ(refusal("", "a.k"), "the file is empty");
  EXPECT_EQ(refusal(" \n\n", "a.inp"), "the file is empty");
  EXPECT_NE(refusal("solid cube\nfacet\n", "a.stl").find("no mesh that can be read"), std::string::npos);
  EXPECT_NE(refusal(std::string("*KEYWORD\n\0\n", 11), "a.k").find("binary"), std::string::npos);
  EXPECT_NE(refusal("hello\n", "a.msh").find("expected the beginning of a section"), std::string::npos);
  EXPECT_NE(refusal("hello\n", "a.inp").find("no hexahedra"), std::string::npos);
}

TEST(BrokenMesh, ManyFaultsOfAKindAreCounted) {
  std::string text = "*NODE\n1,0,0,0\n*ELEMENT_SOLID\n";
  for (int e = 1; e <= 1000; ++e) text += fmt::format("{},1,1,2,3,4,5,6,7,8\n", e);
  MeshFaults faults;
  mesh_of(text + "*END\n", "a.k", {1, {}, 1}, faults);
  const std::vector<LineFault> list = faults.list();
  ASSERT_EQ(list.size(), 6U);
  EXPECT_EQ(list.back().message, "6995 more elements with unknown nodes");
}

}  // namespace
}  // namespace tread
