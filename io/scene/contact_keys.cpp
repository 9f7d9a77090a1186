#include <utility>

#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

namespace {

void add_friction(Keys& keys) {
  const auto with = [](std::vector<std::string> laws, Key key) {
    return only_with("contact.friction_law", std::move(laws), std::move(key));
  };
  keys.push_back(choice("contact.friction_law", {Effect::motion, Effect::cost},
                        at(&Scene::contact, &ContactSpec::friction_law), {"coulomb", "table", "falling"},
                        "Coefficient of friction: one for all, along the rail by a file, or falling with "
                        "the slip speed"));
  keys.push_back(
      with({"coulomb", "falling"},
           number("contact.friction", {Effect::motion}, at(&Scene::contact, &ContactSpec::friction), {0, 2},
                  "Coefficient of friction f; for falling friction, f without slip")));
  keys.push_back(with({"falling"}, number("contact.friction_fast", {Effect::motion},
                                          at(&Scene::contact, &ContactSpec::friction_fast), {0, 2},
                                          "Coefficient of friction of fast slip; dry rails: 0.4 f after "
                                          "Polach (2005)")));
  keys.push_back(with(
      {"falling"}, quantity("contact.friction_speed", {Effect::motion},
                            at(&Scene::contact, &ContactSpec::friction_speed), kSpeed, "m/s", above(0, 1000),
                            "Slip speed that leaves 1/e of the fall; dry rails: 1.67 m/s after Polach "
                            "(2005), wet ones 5 m/s")));
  keys.push_back(
      with({"falling"},
           required(quantity("contact.friction_memory", {Effect::motion},
                             at(&Scene::contact, &ContactSpec::friction_memory), kLength, "um", from(0, 1),
                             "Sliding length over which the coefficient follows the slip speed; "
                             "above zero"))));
  Key table =
      file("contact.friction_file", {Effect::motion}, at(&Scene::contact, &ContactSpec::friction_file),
           "File of two columns, x and coefficient of friction, after a line such as "
           "`# x [m]  f [-]`; linear between the rows, constant beyond them");
  // A table of a later layer takes the place of an earlier coefficient.
  keys.push_back(with({"table"}, required(instead_of("contact.friction", std::move(table)))));
  keys.push_back(with({"table"}, quantity("contact.friction_start", {Effect::motion},
                                          at(&Scene::contact, &ContactSpec::friction_start), kLength, "m",
                                          from(-1000, 1000), "x on the rail where the file's x is zero")));
}

}  // namespace

void add_contact(Keys& keys) {
  add_friction(keys);
  keys.push_back(
      number("contact.penetration_ratio", {Effect::preload},
             at(&Scene::contact, &ContactSpec::penetration_ratio), above(0, 0.5),
             "Penetration divided by the Hertz approach: sets the penalty stiffness; absent: 10 E / element "
             "size, E the harmonic mean of wheel and rail, but at most 2 %"));
  keys.push_back(quantity("contact.depth_room", {Effect::room, Effect::cost},
                          at(&Scene::contact, &ContactSpec::depth_room), kLength, "mm", from(0, 0.01),
                          "Corrugation depth that the searched surface has room for: the deepest that a fork "
                          "of the run may have; absent: the scene's own, with [forks] at least 0.2 mm"));
  keys.push_back(choice("contact.surface", {Effect::preload}, at(&Scene::contact, &ContactSpec::surface),
                        {"exact", "facets"},
                        "Surface that the gap is measured to: the profile's curves or the element faces"));
  keys.push_back(number("contact.points", {Effect::preload, Effect::cost},
                        at(&Scene::contact, &ContactSpec::points), {1, 4},
                        "Integration points per face and direction", Kind::integer));
}

}  // namespace tread::keys
