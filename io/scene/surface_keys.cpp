#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"
#include "io/scene/surface_file.hpp"

namespace tread::keys {

void add_surface(Keys& keys, const std::string& name) {
  using Kinds = std::vector<std::string>;
  const std::string table = std::string(kSurfaceTables) + name;
  const auto with = [&](Kinds kinds, Key key) {
    return only_with(table + ".kind", std::move(kinds), std::move(key));
  };
  const auto place = [&](auto member) { return at(&Scene::surfaces, name, member); };
  const Effects shape = {Effect::preload, Effect::cost};
  const auto length = [&](const char* key, Effects effects, double SurfaceSpec::*member, const char* unit,
                          Bounds range, const char* description) {
    return quantity(table + key, effects, place(member), kLength, unit, range, description);
  };
  keys.push_back(required(choice(
      table + ".kind", shape, place(&SurfaceSpec::kind),
      {"dip", "dent", "waves", "polygon", "flat", "profile", "map"},
      "A dip over the whole width: a weld, a joint, a rounded flat; a dent: a squat, a shell; waves along "
      "the "
      "rail; waves around the wheel; a chord across the wheel; measured depths along; measured depths along "
      "and across")));
  keys.push_back(with({"dip", "dent", "profile", "map"},
                      choice(table + ".on", {Effect::preload}, place(&SurfaceSpec::on), {"rail", "wheel"},
                             "Body of the surface")));
  keys.push_back(
      required(length(".at", {Effect::preload}, &SurfaceSpec::at, "m", from(-1000, 1000),
                      "x of the middle of dip, dent or flat; of a polygon's crest; where the waves "
                      "begin; of the file's zero")));
  keys.push_back(
      with({"dip", "dent", "waves", "polygon"},
           required(length(".depth", shape, &SurfaceSpec::depth, "mm", {-kDeepestSurface, kDeepestSurface},
                           "Largest depth, of a bump negative; of waves from crest to trough"))));
  keys.push_back(with({"dip", "dent", "waves", "flat"},
                      required(length(".length", shape, &SurfaceSpec::length, "mm", above(0, 1000),
                                      "Length of dip or dent; of the flat's chord; that the whole waves must "
                                      "fit into"))));
  keys.push_back(with(
      {"dent"}, required(length(".width", shape, &SurfaceSpec::width, "mm", above(0, 0.2), "Width across"))));
  keys.push_back(with({"dent", "map"},
                      length(".centre", {Effect::preload}, &SurfaceSpec::centre, "mm", {-0.1, 0.1},
                             "y of the dent's middle, of the file's zero, from the rail's centre line")));
  keys.push_back(
      with({"dip"}, choice(table + ".shape", shape, place(&SurfaceSpec::shape), {"smooth", "pointed"},
                           "One wave of a cosine, or two parabolas that meet at an angle of 8 depth "
                           "/ length")));
  keys.push_back(with({"waves"}, required(length(".wavelength", shape, &SurfaceSpec::wavelength, "m",
                                                 above(0, 1000), "Wavelength"))));
  keys.push_back(with({"polygon"}, required(number(table + ".order", shape, place(&SurfaceSpec::order),
                                                   {1, 1000}, "Waves around the wheel", Kind::integer))));
  keys.push_back(
      with({"profile", "map"},
           required(file(
               table + ".file", shape, place(&SurfaceSpec::file),
               "Profile: two columns, x and depth positive into the body, after a line such as `# x [m]  d "
               "[mm]`, on a wheel also `# angle [deg]  d [um]`; map: three columns, `# x [mm]  y [mm]  d "
               "[um]`, each x with each y once, or HDF5 with x, y and depth (a row for each y), each with an "
               "attribute `unit`. Beyond the file the depth stays; around a wheel it closes, and x or angle "
               "grows in the order in which places meet the rail, against the wheel's own angle"))));
}

}  // namespace tread::keys
