#include <utility>

#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

void add_body(Keys& keys, const std::string& name) {
  const std::string table = std::string(kBodyTables) + name;
  const Effects shape = {Effect::mesh};
  const Effects carried = {Effect::preload, Effect::cost};
  const auto place = [&](auto member) { return at(&Scene::bodies, name, member); };
  keys.push_back(required(choice(table + ".replaces", shape, place(&BodySpec::replaces), {"disc", "rail"},
                                 "Part that gives way: the wheel's disc, from below the tread to the axle, "
                                 "or the rail below its head")));
  keys.push_back(
      required(file(table + ".file", shape, place(&BodySpec::file),
                    "A mesh of hexahedra: an LS-DYNA keyword deck (.k), Gmsh version 4 as text (.msh) or an "
                    "Abaqus input file (.inp)")));
  keys.push_back(required(choice(table + ".unit", shape, place(&BodySpec::unit), {"mm", "cm", "m"},
                                 "Unit of the file's lengths; it is never guessed")));
  keys.push_back(text(table + ".part", shape, place(&BodySpec::part),
                      "Part or set of elements of the file, by name or number; empty: all elements"));
  keys.push_back(material_name(table + ".material", carried, place(&BodySpec::material),
                               "Material of the body, of the elastic law; empty: that of wheel or rail"));
  const auto origin = [&](const char* key, double BodySpec::*member, const char* description) {
    keys.push_back(quantity(table + key, shape, place(member), kLength, "m", from(-1000, 1000), description));
  };
  origin(".origin_x", &BodySpec::origin_x, "x in the file of the scene's x = 0");
  origin(".origin_y", &BodySpec::origin_y, "y in the file of the rail's centre line");
  origin(".origin_z", &BodySpec::origin_z, "z in the file of the axle (disc) or of the rail's top (rail)");
  const auto set = [&](const char* key, Effects effects, std::string BodySpec::*member, const char* part,
                       const char* description) {
    keys.push_back(only_with(table + ".replaces", part,
                             required(text(table + key, effects, place(member), description))));
  };
  set(".tread", shape, &BodySpec::tread, "disc", "Set of the file's nodes that are tied to the tread's ring");
  set(".axle", shape, &BodySpec::axle, "disc", "Set of the file's nodes that are tied to the axle");
  set(".head", shape, &BodySpec::head, "rail", "Set of the file's nodes that are tied to the rail's head");
  set(".foot", shape, &BodySpec::foot, "rail", "Set of the file's nodes that stand on the fastenings");
}

}  // namespace tread::keys
