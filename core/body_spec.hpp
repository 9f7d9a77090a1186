#pragma once
// A mesh of another program in place of a swept part.

#include <memory>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace tread {

struct HexMesh;

/// [body.NAME]: a body of a file's hexahedra, tied to the parts beside it
struct BodySpec {
  std::string replaces = "disc";  ///< "disc", between tread and axle, or "rail", below the head
  std::string file;
  std::string unit = "mm";  ///< of the file's lengths
  std::string part;         ///< of the file, a part or set of elements; empty: all of it
  std::string material;     ///< one of Scene::materials; empty: that of wheel or rail
  /// Place in the file of the scene's origin: x = 0; y = 0, the rail's centre line; z = 0, the axle (disc) or
  /// the rail's top (rail). [m]
  double origin_x = 0, origin_y = 0, origin_z = 0;
  std::string tread, axle;              ///< disc: sets of the nodes that are tied to them
  std::string head, foot;               ///< rail: sets of the nodes under the head, on the fastenings
  std::shared_ptr<const HexMesh> mesh;  ///< of the file, about the origin [m]
  std::string reading;                  ///< sentence on what the file holds
  std::vector<std::string> notes;       ///< sentences on what of the file is left out

  bool on_wheel() const { return replaces == "disc"; }
};

}  // namespace tread
