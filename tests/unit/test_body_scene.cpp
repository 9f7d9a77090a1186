// Keys of bodies from files: what is read, what is refused and with which words.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/mesh/hex_mesh.hpp"
#include "drivers/bench/rolling_scene.hpp"
#include "drivers/run/run_model.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/import/import_study.hpp"
#include "drivers/studies/multibody/multibody_model.hpp"
#include "drivers/studies/study/study_plan.hpp"
#include "io/scene/body_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/device/device.hpp"
#include "tests/mesh_files.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

const std::string kBase = "[scene]\ntitle = \"body\"\nbased_on = \"highspeed-slab-2014\"\n";

/// Scenes beside the bar of tests/mesh_files.hpp, in which "bottom" and "edge" are sets of nodes.
class BodyScene : public testing::Test {
 protected:
  void SetUp() override {
    std::string deck = samples::keyword_file(samples::SolidCards::one);
    deck.insert(deck.find("*DATABASE"), "*SET_NODE_LIST_TITLE\nedge\n         2\n       135       136\n");
    write("bar.k", deck);
    write("bar.inp", with_edge(samples::abaqus_file()));
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path / name) << text;
  }
  static std::string with_edge(const std::string& inp) { return inp + "*NSET, NSET=edge\n135, 136\n"; }

  /// A table that replaces the disc by the bar of the Abaqus file; `more` are other lines of it.
  static std::string disc(const std::string& name, const std::string& more = "") {
    return "[body." + name +
           "]\nreplaces = \"disc\"\nfile = \"bar.inp\"\nunit = \"mm\"\ntread = \"bottom\"\naxle = "
           "\"edge\"\n" +
           more;
  }
  static std::string rail(const std::string& name, const std::string& more = "") {
    return "[body." + name +
           "]\nreplaces = \"rail\"\nfile = \"bar.inp\"\nunit = \"mm\"\nhead = \"bottom\"\nfoot = \"edge\"\n" +
           more;
  }

  ResolvedScene resolved(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return resolve_scene(SceneSource{"x.toml", kBase + text, folder_.path}, overrides);
  }
  /// The message with which the scene is refused, without the folder's name.
  std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    std::string message = samples::refusal<InputError>([&] { resolved(text, overrides); });
    const std::string folder = folder_.path.string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }

  samples::TemporaryFolder folder_;
};

TEST_F(BodyScene, TakesAMeshAboutItsOrigin) {
  const Scene scene =
      resolved(disc("web", "origin_x = \"5 mm\"\norigin_y = \"-1 cm\"\norigin_z = \"0.5 m\"\n")).scene;
  const BodySpec& body = scene.bodies.at("web");
  EXPECT_TRUE(body.on_wheel());
  EXPECT_EQ(body.reading, "Abaqus input file: 12 hexahedra, 36 nodes");
  EXPECT_EQ(body_notes(scene), std::vector<std::string>{"body.web: not read: *SOLID SECTION"});
  ASSERT_TRUE(body.mesh);
  EXPECT_EQ(body.mesh->node_sets.at(body.tread).size(), 12U);
  EXPECT_EQ(body.mesh->node_sets.at(body.axle).size(), 2U);
  std::size_t n = 0;
  samples::BarMesh::for_each_node([&](int, double x, double y, double z) {
    const Vec3 expected = 1e-3 * Vec3{x - 5, y + 10, z - 500};
    EXPECT_LT(norm(body.mesh->nodes[n++] - expected), 1e-15);
  });
}

TEST_F(BodyScene, TakesAPartOfAnotherFormatInItsUnit) {
  const ResolvedScene scene = resolved(
      "[body.web]\nreplaces = \"rail\"\nfile = \"bar.k\"\nunit = \"cm\"\npart = \"7\"\nhead = \"bottom\"\n"
      "foot = \"edge\"\n");
  const BodySpec& body = scene.scene.bodies.at("web");
  EXPECT_EQ(body.reading, "LS-DYNA keyword deck: 8 hexahedra, 27 nodes");
  ASSERT_TRUE(body.mesh);
  double last = 0;
  for (const Vec3& at : body.mesh->nodes) last = std::max(last, at.x);
  EXPECT_NEAR(last, 0.3, 1e-15);
  // The resolved scene reads back as the same.
  const ResolvedScene again = resolve_scene(SceneSource{"again.toml", resolved_toml(scene), "/nowhere"});
  EXPECT_EQ(again.scene.bodies.at("web").mesh->nodes.size(), 27U);
  EXPECT_EQ(again.scene.bodies.at("web").part, "7");
}

/// The first line of each format says something: nodes, the format, the width of numbers.
TEST_F(BodyScene, AByteOrderMarkBeforeAMeshIsSkipped) {
  std::vector<samples::MeshFile> meshes = samples::files();
  meshes.push_back({"node.inp", samples::abaqus_file()});
  meshes.back().text.erase(0, meshes.back().text.find("*Node"));
  for (const samples::MeshFile& mesh : meshes) {
    write(mesh.name, "\xEF\xBB\xBF" + mesh.text);
    EXPECT_EQ(read_mesh_text(folder_.path / mesh.name), mesh.text) << mesh.name;
    const ImportedMesh imported = read_mesh_file(folder_.path / mesh.name, {1e-3, {}, 1});
    EXPECT_EQ(imported.mesh.elements.size(), 12U) << mesh.name;
  }
}

TEST_F(BodyScene, ContentsOfTheFileTellScenesApart) {
  const SceneContent before = scene_content(resolved(disc("web")));
  EXPECT_EQ(difference(before, scene_content(resolved(disc("web")))), "");
  write("bar.inp", with_edge(samples::abaqus_file()) + "** another\n");
  const std::string apart = difference(before, scene_content(resolved(disc("web"))));
  EXPECT_NE(apart.find("body.web.file is a .inp file of checksum "), std::string::npos) << apart;
}

TEST_F(BodyScene, PointsOfAStudyShareFilesAndMeshes) {
  write("scene.toml", kBase + disc("web"));
  write("study.toml",
        "[study]\nscene = \"scene.toml\"\n[grid]\nmotion.speed = [\"200 km/h\", \"300 km/h\"]\n"
        "body.web.unit = [\"mm\", \"cm\"]\n");
  const StudyPlan plan = plan_study(read_study(folder_.path / "study.toml"), folder_.path / "runs");
  ASSERT_EQ(plan.points.size(), 4U);
  std::set<const std::string*> texts;
  std::map<std::string, std::set<const HexMesh*>> meshes;
  for (const PlannedPoint& point : plan.points) {
    for (const auto& [name, text] : point.resolved.source.files) texts.insert(text.get());
    const BodySpec& body = point.resolved.scene.bodies.at("web");
    meshes[body.unit].insert(body.mesh.get());
  }
  EXPECT_EQ(texts.size(), 1U);
  EXPECT_EQ(meshes["mm"].size(), 1U);
  EXPECT_EQ(meshes["cm"].size(), 1U);
  EXPECT_NE(meshes["mm"], meshes["cm"]);
}

TEST_F(BodyScene, UnknownSetsAreRefused) {
  EXPECT_EQ(
      refusal(disc("web"), {"body.web.tread=botom"}),
      "--set: body.web.tread: bar.inp has no set \"botom\" with nodes of the body; state one of \"ALL\", "
      "\"bottom\", \"edge\", \"face\" (did you mean \"bottom\"?)");
  // A set without nodes of the part is none.
  EXPECT_EQ(refusal(disc("web", "part = \"left end\"\n")),
            "x.toml:9:1: body.web.axle: bar.inp has no set \"edge\" with nodes of the body; state one of "
            "\"ALL\", \"bottom\", \"face\"");
  EXPECT_EQ(
      refusal(disc("web"), {"body.web.axle=ALL"}),
      "--set: body.web.axle: node 101 of bar.inp is in \"bottom\" of body.web.tread too; a node is tied "
      "to one part: leave it out of one of the sets");
  std::string many = with_edge(samples::abaqus_file());
  for (int i = 0; i < 9; ++i) many += "*NSET, NSET=more" + std::to_string(i) + "\n101\n";
  write("bar.inp", many);
  EXPECT_NE(refusal(disc("web"), {"body.web.tread=none"}).find("\"more5\" and 3 others"), std::string::npos);
}

TEST_F(BodyScene, OneOfSeveralSetsOfOneNameIsRefused) {
  std::string deck = samples::keyword_file(samples::SolidCards::one);
  for (const char* set :
       {"bottom\n         2\n       133       134\n", "edge\n         3\n       135       136\n"})
    deck.insert(deck.find("*DATABASE"), std::string("*SET_NODE_LIST_TITLE\n") + set);
  write("two.k", deck);
  const auto web = [](const std::string& tread) {
    return "[body.web]\nreplaces = \"disc\"\nfile = \"two.k\"\nunit = \"mm\"\ntread = \"" + tread +
           "\"\naxle = \"edge\"\n";
  };
  EXPECT_EQ(
      refusal(web("bottom")),
      "x.toml:8:1: body.web.tread: two.k has several sets \"bottom\"; state \"bottom (1)\" (12 nodes) or "
      "\"bottom (2)\" (2 nodes), or give each a name of its own in the file");
  EXPECT_EQ(refusal(web("bottom (1)")), "");
}

TEST_F(BodyScene, WrongUnitsAreRefused) {
  EXPECT_EQ(refusal(disc("web"), {"body.web.unit=inch"}),
            "--set: body.web.unit: \"inch\" is unknown; choose from: mm, cm, m");
  std::string table = disc("web");
  table.erase(table.find("unit"), std::string("unit = \"mm\"\n").size());
  EXPECT_EQ(refusal(table),
            "x.toml:4:7: body.web.unit: is missing; [body.web] needs a value: Unit of the file's lengths; it "
            "is never guessed");
  std::string deck = samples::files()[0].text;
  const std::string title = "*TITLE\nbar\n";
  write("bar.k", deck.replace(deck.find(title), title.size(), "*CONTROL_UNITS\nmm\n"));
  EXPECT_EQ(refusal(rail("web"), {"body.web.file=bar.k", "body.web.unit=m"}),
            "bar.k: the file states a unit of 0.001 m (*CONTROL_UNITS), body.web.unit one of 1 m; state the "
            "file's");
}

TEST_F(BodyScene, MaterialsAreThoseOfTheScene) {
  EXPECT_EQ(refusal(disc("web", "material = \"stel\"\n")),
            "x.toml:10:1: body.web.material: [body.web] needs [material.stel]; the scene's materials: "
            "gap_filler, mortar, slab, steel (did you mean steel?)");
  const std::string cast =
      "[material.cast]\nyoungs_modulus = \"170 GPa\"\npoissons_ratio = 0.27\ndensity = \"7200 kg/m3\"\n";
  EXPECT_EQ(refusal(cast + disc("web", "material = \"cast\"\n")), "");
  const std::string yields = "law = \"j2\"\nyield_stress = \"300 MPa\"\n";
  EXPECT_EQ(refusal(cast + yields + disc("web", "material = \"cast\"\n")),
            "x.toml:16:1: body.web.material: [material.cast] has law = \"j2\", and a body from a file is "
            "elastic; state body.web.material, a material with law = \"elastic\"");
  EXPECT_EQ(
      refusal(disc("web"), {"material.steel.law=j2", "material.steel.yield_stress=300 MPa"}),
      "--set: material.steel.law: [material.steel] has law = \"j2\", and a body from a file is elastic; "
      "state body.web.material, a material with law = \"elastic\"");
}

TEST_F(BodyScene, BrokenMeshesNameTheLine) {
  std::string broken = samples::abaqus_file();
  broken.replace(broken.find("101, 0"), 6, "101, x");
  write("bar.inp", broken);
  EXPECT_EQ(refusal(disc("web")).find("bar.inp:5: node 101"), 0U) << refusal(disc("web"));
  write("bar.inp", "");
  EXPECT_EQ(refusal(disc("web")), "bar.inp: the file is empty");
  EXPECT_EQ(refusal(disc("web"), {"body.web.file=none.inp"}),
            "--set: body.web.file: cannot read none.inp: No such file or directory");
  write("bar.inp", samples::abaqus_file());
  EXPECT_EQ(refusal(disc("web"), {"body.web.part=middle"})
                .find("bar.inp: there is no part \"middle\" with hexahedra; there are "),
            0U);
}

TEST_F(BodyScene, KeysOfTheOtherKindAreIdle) {
  EXPECT_EQ(refusal(disc("web", "head = \"bottom\"\n")),
            "x.toml:10:1: body.web.head: has an effect only with body.web.replaces = \"rail\"");
  EXPECT_EQ(refusal(rail("web", "axle = \"edge\"\n")),
            "x.toml:10:1: body.web.axle: has an effect only with body.web.replaces = \"disc\"");
  EXPECT_EQ(
      refusal("[body.web]\nreplaces = \"rail\"\nfile = \"bar.inp\"\nunit = \"mm\"\nhead = \"bottom\"\n"),
      "x.toml:4:7: body.web.foot: is missing; [body.web] needs a value: Set of the file's nodes that "
      "stand on the fastenings");
}

TEST_F(BodyScene, AnUnclearKindIsTheOnlyProblem) {
  EXPECT_EQ(refusal(rail("web"), {"body.web.replaces=raill"}),
            "--set: body.web.replaces: \"raill\" is unknown; did you mean \"rail\"? choose from: disc, rail");
  EXPECT_EQ(refusal("[body.web]\nfile = \"bar.inp\"\nunit = \"mm\"\n" + disc("other"))
                .find("x.toml:4:7: body.web.replaces: is missing; [body.web] needs a value: Part "),
            0U);
}

TEST_F(BodyScene, APartIsReplacedOnce) {
  EXPECT_EQ(refusal(disc("a") + rail("b")), "");
  EXPECT_EQ(refusal(disc("a") + disc("b")),
            "x.toml:11:1: body.b.replaces: \"disc\" is replaced by [body.a] too; state body.b.present = "
            "false, or one mesh of both in one table");
}

TEST_F(BodyScene, NeedsThePartThatItReplaces) {
  EXPECT_EQ(
      refusal(disc("web") + "[wheel]\nshape = \"tyre\"\nprofile = \"cylinder\"\n"),
      "x.toml:5:1: body.web.replaces: \"disc\" is a part of a half wheelset, and wheel.shape is \"tyre\", "
      "a ring without a disc; state wheel.shape = \"half_wheelset\"");
  const std::string struck =
      "[hammer]\nposition = \"0 m\"\nforce = \"1 kN\"\nduration = \"20 us\"\n[wheel]\npresent = false\n"
      "[vehicle]\npresent = false\n[contact]\npresent = false\n";
  EXPECT_EQ(refusal(rail("web") + struck), "");
  EXPECT_EQ(refusal(disc("web") + struck),
            "x.toml:5:1: body.web.replaces: \"disc\" is a part of the wheel, and there is none; add [wheel], "
            "or state body.web.present = false");
  EXPECT_NE(
      refusal(rail("web") + "[rail]\nprofile = \"box\"\ninclination = 0\nwidth = \"150 mm\"\n")
          .find("x.toml:5:1: body.web.replaces: \"rail\" is the rail below its head, and rail.profile is "
                "\"box\", which has no head; state a rail such as rail.profile = \"CN60\""),
      std::string::npos);
}

TEST_F(BodyScene, KeysOfTheDiscThatIsReplacedAreNamed) {
  EXPECT_EQ(refusal(disc("web"), {"wheel.brake_rings=true"}),
            "--set: wheel.brake_rings: the rings lie on the disc, which the file replaces; state "
            "wheel.brake_rings = false");
  for (const std::string key : {"wheel.web_offset", "wheel.web_wave"})
    EXPECT_EQ(refusal(disc("web"), {key + "=10 mm"}),
              "--set: " + key + ": the web is a part of the disc, which the file replaces; state " + key +
                  " = \"0 mm\"");
}

/// Steps on a device, decks and the multi-body approach know swept parts alone.
TEST_F(BodyScene, IsRefusedWhereItCannotBeUsed) {
  const ResolvedScene scene = resolved(disc("web"));
  choose_device("emulated");
  const Progress quiet(true);
  const std::string on_device =
      samples::refusal<InputError>([&] { settle_device(scene.scene, "emulated", quiet); });
  const std::string timed = samples::refusal<InputError>([&] { const RollingScene rolling(scene, quiet); });
  settle_device(scene.scene, "auto", quiet);
  EXPECT_EQ(chosen_device(), nullptr);
  EXPECT_EQ(
      on_device,
      "body.web: the steps of a body from a file are those of one process; leave out --device, or state "
      "body.web.present = false");
  EXPECT_EQ(timed, on_device);
  EXPECT_EQ(samples::refusal<InputError>([&] { multibody_model(scene.scene, BeamTheory::timoshenko); }),
            "tread multibody: body.web has no section, from which masses and modes are made; state "
            "body.web.present = false");
}

TEST_F(BodyScene, UnknownKeysAndNames) {
  EXPECT_EQ(refusal(disc("web", "tred = \"edge\"\n")),
            "x.toml:10:1: body.web.tred: unknown key (did you mean body.web.tread?)");
  EXPECT_EQ(refusal("[body.\"my web\"]\nreplaces = \"disc\"\n"),
            "x.toml:4:7: body.my web: a body's name consists of letters, digits, _ and -");
}

}  // namespace
}  // namespace tread
