#include <utility>

#include "io/scene/key_builders.hpp"
#include "io/scene/key_table.hpp"

namespace tread::keys {

void add_corrugation(Keys& keys) {
  const auto sine = [](Key key) { return only_with("corrugation.kind", "sine", std::move(key)); };
  const auto length = [](const char* name, Effects effects, auto member, const char* unit, Bounds range,
                         const char* description) {
    return quantity(name, effects, at(&Scene::corrugation, member), kLength, unit, range, description);
  };
  const auto random = [](Key key) { return only_with("corrugation.kind", "random", std::move(key)); };
  keys.push_back(
      choice("corrugation.kind", {Effect::surface}, at(&Scene::corrugation, &CorrugationSpec::kind),
             {"sine", "table", "map", "random"},
             "Sine waves, measured depths along, measured depths along and across, or random roughness"));
  keys.push_back(sine(length("corrugation.wavelength", {Effect::surface}, &CorrugationSpec::wavelength, "mm",
                             above(0, 10), "Wavelength L")));
  keys.push_back(sine(length("corrugation.depth", {Effect::surface}, &CorrugationSpec::depth, "mm",
                             above(0, 0.01), "Depth d_m from crest to trough")));
  keys.push_back(
      only_with("corrugation.kind", std::vector<std::string>{"sine", "table", "random"},
                length("corrugation.width", {Effect::surface}, &CorrugationSpec::width, "mm", above(0, 0.1),
                       "Half width W across the rail, where the depth has fallen to zero")));
  keys.push_back(length("corrugation.start", {Effect::surface}, &CorrugationSpec::start, "m",
                        from(-1000, 1000), "x_s where it starts, a sine at a crest"));
  keys.push_back(
      only_with("corrugation.kind", std::vector<std::string>{"sine", "random"},
                length("corrugation.length", {Effect::surface}, &CorrugationSpec::length, "m", above(0, 1000),
                       "Length that the whole waves must fit into; of the roughness, which fades over half "
                       "the longest wave at either end")));
  keys.push_back(random(length("corrugation.rms", {Effect::surface}, &CorrugationSpec::rms, "um",
                               above(0, 0.01), "Root mean square of the roughness")));
  keys.push_back(random(length("corrugation.shortest", {Effect::surface}, &CorrugationSpec::shortest, "mm",
                               above(0, 10), "Shortest wave of the roughness")));
  keys.push_back(random(length("corrugation.longest", {Effect::surface}, &CorrugationSpec::longest, "mm",
                               above(0, 10), "Longest wave of the roughness")));
  keys.push_back(
      random(number("corrugation.seed", {Effect::surface}, at(&Scene::corrugation, &CorrugationSpec::seed),
                    {0, 2e9}, "Seed of the phases of the roughness' waves", Kind::integer)));
  keys.push_back(length("corrugation.centre", {Effect::surface}, &CorrugationSpec::centre, "mm", {-0.1, 0.1},
                        "y of the deepest line; absent: at the preload's largest pressure"));
  keys.push_back(choice("corrugation.apply", {Effect::surface},
                        at(&Scene::corrugation, &CorrugationSpec::apply), {"nodes", "gap"},
                        "Moved nodes, or depths added to the contact gap"));
  keys.push_back(only_with(
      "corrugation.kind", std::vector<std::string>{"table", "map"},
      required(
          file("corrugation.file", {Effect::surface}, at(&Scene::corrugation, &CorrugationSpec::file),
               "File of two columns, x from the start and depth positive downwards, after a line such as "
               "`# x [m]  d [mm]`; map: three, `# x [m]  y [mm]  d [um]`, each x with each y once, or HDF5 "
               "with x, "
               "y and depth; y counts from corrugation.centre"))));
}

void add_wear(Keys& keys) {
  keys.push_back(quantity("wear.coefficient", {Effect::wear}, at(&Scene::wear, &WearSpec::coefficient), kWear,
                          "ug/N/m", above(0, 1e-3),
                          "Mass worn off per frictional work: 2.5e-9 kg/(N m) is usual for mild wear, after "
                          "Krause and Poll (1984)"));
  keys.push_back(number(
      "wear.change", {Effect::wear}, at(&Scene::wear, &WearSpec::change), above(0, 1),
      "Largest relative change of the depth by one simulated passage; sets the number of real passages "
      "that it stands for"));
  keys.push_back(quantity("wear.shortest", {Effect::wear}, at(&Scene::wear, &WearSpec::shortest), kLength,
                          "mm", above(0, 10),
                          "Shortest wave that wear changes; shorter waves count as noise of the mesh"));
  keys.push_back(quantity("wear.longest", {Effect::wear}, at(&Scene::wear, &WearSpec::longest), kLength, "mm",
                          above(0, 10), "Longest wave that wear changes"));
  keys.push_back(
      flag("wear.across", {Effect::wear}, at(&Scene::wear, &WearSpec::across),
           "Each row of nodes across the rail wears by its own work; without it the depth keeps its "
           "parabola across"));
}

}  // namespace tread::keys
