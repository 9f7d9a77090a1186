#pragma once
// A mesh as a file states it: its own numbers, before they are understood.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace tread {

/// Numbers first, first + step ... up to last; a single number has first = last.
struct NumberRange {
  std::int64_t first = 0, last = 0, step = 1;
};

/// Elements whose faces belong to a set of nodes.
struct FaceOfElements {
  std::string elements;  ///< name of a set, or empty
  std::int64_t element = 0;
  int face = 0;  ///< index into kHexFaces
};

struct MeshSource {
  struct Node {
    std::int64_t number = 0;
    Vec3 at;  ///< in the file's unit
    int line = 0;
  };
  struct Element {
    std::int64_t number = 0;
    std::int64_t part = 0;
    std::array<std::int64_t, 8> nodes = {};
    int line = 0;
  };
  /// A set by its numbers, by other sets and by faces of elements.
  struct Set {
    std::string name;
    int line = 0;
    std::vector<NumberRange> numbers = {};
    std::vector<std::string> sets = {};          ///< of the same kind
    std::vector<std::string> element_sets = {};  ///< all nodes of their elements
    std::vector<FaceOfElements> faces = {};
  };

  std::string format;  ///< "Gmsh 4.1"
  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::map<std::int64_t, std::string> parts;  ///< names by number
  bool numbers_parts = true;                  ///< false: the file has names of parts alone
  std::vector<Set> node_sets, element_sets;
  std::map<std::string, int> ignored;  ///< keywords that are not read, and how often they occur
  double stated_unit = 0;              ///< the file's own statement of its unit of length [m]; 0: none
};

}  // namespace tread
