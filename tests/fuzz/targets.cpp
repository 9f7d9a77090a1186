#include "tests/fuzz/targets.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>

#include "core/error.hpp"
#include "core/math/hash.hpp"
#include "core/mesh/web_outline.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/roughness/roughness_levels.hpp"
#include "drivers/studies/roughness/roughness_profile.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/history_reader.hpp"
#include "io/files/output_file.hpp"
#include "io/files/sealed_file.hpp"
#include "io/files/step_files.hpp"
#include "io/mesh/imported_mesh.hpp"
#include "io/scene/profile_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/support_file.hpp"
#include "io/scene/surface_file.hpp"
#include "io/scene/table_reader.hpp"
#include "io/text/json.hpp"
#include "io/text/text_file.hpp"
#include "tests/mesh_files.hpp"

namespace tread::fuzz {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHeader = 512;  ///< of a sealed file [B]

/// A folder of this process, in memory where the system has such a file system.
const fs::path& workplace() {
  static const fs::path folder = [] {
    const fs::path base = fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
    const fs::path made = base / fmt::format("tread_fuzz_{}", ::getpid());
    fs::create_directories(made);
    return made;
  }();
  return folder;
}

struct Cleaner {
  ~Cleaner() {
    std::error_code ignored;
    fs::remove_all(workplace(), ignored);
  }
};

fs::path written(const std::string& name, const std::string& bytes) {
  static const Cleaner cleaner;
  const fs::path path = workplace() / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return path;
}

std::string content_of(const fs::path& path) {
  return read_bytes(path, std::numeric_limits<std::size_t>::max());
}

std::string shipped(const char* path) {
  return content_of(fs::path(TREAD_SOURCE_DIR) / path);
}

void require(bool condition, const std::string& what) {
  if (!condition) throw std::logic_error(what);
}

/// Resolved values of a scene, without their places in the file.
std::string values_of(const ResolvedScene& resolved) {
  std::string text;
  for (const Entry& entry : resolved.entries)
    text += fmt::format("{} = {} {}\n", entry.path, entry.value, entry.unit);
  return text;
}

/// A scene that is accepted must read back from its own resolved form.
void read_scene_text(const std::string& bytes) {
  try {
    const ResolvedScene resolved = resolve_scene(SceneSource{"scene.toml", bytes, workplace()});
    const SceneSource again{"again.toml", resolved_toml(resolved), workplace(), resolved.source.files};
    require(values_of(resolve_scene(again)) == values_of(resolved),
            "the resolved scene reads back differently");
  } catch (const Error&) {
  }
}

void read_table(const std::string& bytes) {
  const fs::path path = written("table.txt", bytes);
  for (const TableRules& rules :
       {TableRules{}, TableRules{true, true}, TableRules{.increasing = true, .pure_second = true},
        TableRules{.increasing = true, .units = {{"m", "um"}}},
        TableRules{.increasing = true, .first = {kLength, kTime}, .second = {kForce}}})
    try {
      const TwoColumns table = read_two_columns(path, rules);
      require(table.first.size() == table.second.size() && table.first.size() >= 2, "columns of a table");
    } catch (const Error&) {
    }
  std::vector<Problem> problems;
  try {
    const TwoColumns points = parse_two_columns(bytes, "web.txt", kWebOutline, problems);
    if (problems.empty())
      require(WebOutline(points.first, points.second).least_thickness() > 0, "faces of a web that meet");
  } catch (const Error&) {
  }
  problems.clear();
  const GridColumns grid = parse_grid(bytes, "map.csv", problems);
  require(!problems.empty() || grid.z.size() == grid.x.size() * grid.y.size(), "points of a map");
  for (const SupportSpec& support : parse_supports(bytes, "supports.txt", problems))
    require(support.fastening >= 1 && support.stiffness >= 0 && support.bed >= 0, "shares of a support");
}

/// In every format, as wheel and as rail.
void read_profile(const std::string& bytes) {
  for (const char* name : {"a.prw", "a.whl", "a.txt"})
    for (const bool wheel : {true, false}) try {
        std::vector<Problem> problems;
        const ProfileWish wish{wheel, !wheel, 1e-3, 1e-5};
        const UnderstoodProfile profile = profile_of(bytes, name, wish, ColumnAxes::any, problems);
        require(profile.y.size() == profile.z.size(), "columns of a profile");
        for (std::size_t i = 1; i < profile.y.size(); ++i)
          require(profile.y[i] > profile.y[i - 1], "a profile that folds back");
        require(profile.largest_deviation() <= 1.001e-5, "a deviation beyond the stated one");
      } catch (const Error&) {
      }
}

void read_roughness(const std::string& bytes) {
  try {
    const TwoColumns rows = read_two_columns(written("rail.txt", bytes), {true, true, {}});
    RoughnessProfile profile = even_profile(rows, "rail.txt");
    remove_spikes(profile);
    close_pits(profile);
    for (const std::optional<double>& level : roughness_levels(profile, 1.0).level)
      require(!level || *level < std::numeric_limits<double>::infinity(), "a level of roughness");
  } catch (const Error&) {
  }
}

void read_map(const std::string& bytes) {
  try {
    std::vector<Problem> problems;
    const GridColumns grid = parse_grid(read_map_text(written("map.h5", bytes)), "map.h5", problems);
    require(!problems.empty() || grid.z.size() == grid.x.size() * grid.y.size(), "points of a map");
  } catch (const Error&) {
  }
}

/// As they are, and with a header that makes the rest sound: what follows must not be believed either.
void read_checkpoint(const std::string& bytes) {
  for (const std::string& file : {bytes, resealed(bytes)}) try {
      const SealedContent content =
          read_sealed(written("checkpoint.h5", file), "checkpoint", kCheckpointFileVersion);
      std::size_t held = 0;
      for (const auto& [name, values] : content)
        held += std::visit([](const auto& v) { return v.size() * sizeof(v[0]); }, values);
      require(held <= file.size(), "a checkpoint that grows in memory");
    } catch (const Error&) {
    }
}

/// The first line names the file of a run's folder that holds the rest.
void read_run_folder(const std::string& bytes) {
  const std::size_t line = std::min(bytes.find('\n'), bytes.size());
  const std::string rest = bytes.substr(std::min(line + 1, bytes.size()));
  const fs::path folder = workplace() / "run";
  fs::remove_all(folder);
  const std::vector<std::string> names = {"histories.csv",
                                          "scene.resolved.toml",
                                          "status.json",
                                          "request",
                                          "records.jsonl",
                                          "checkpoint/order.h5",
                                          "checkpoint/step-000000000007.h5"};
  const auto known = std::find(names.begin(), names.end(), bytes.substr(0, line));
  written("run/scene.resolved.toml", shipped("scenes/tyre.toml"));
  written("run/histories.csv", "wheel_x [m],vertical_force [N]\n0,1\n1,2\n");
  written("run/" + (known == names.end() ? names.front() : *known), known == names.end() ? bytes : rest);
  const auto tolerant = [](const auto& action) {
    try {
      action();
    } catch (const Error&) {
    }
  };
  tolerant([&] {
    const auto columns = read_history(folder / "histories.csv", {{"wheel_x", "m"}, {"vertical_force", "N"}});
    require(columns.size() == 2 && columns[0].size() == columns[1].size(), "columns of a history");
  });
  tolerant([&] { read_scene(folder / "scene.resolved.toml"); });
  tolerant([&] { read_json_lines(folder / "records.jsonl"); });
  tolerant([&] { CheckpointFolder(folder / "checkpoint").read_order(); });
  std::vector<std::string> refused;
  CheckpointFolder(folder / "checkpoint").newest(refused);
  RunFolder taken(folder);
  tolerant([&] { read_text_file(folder / "status.json", 1 << 16); });
  written("run/request", rest);
  taken.take_request();
}

/// A mesh that is accepted has proper elements; one that is not has a fault.
void read_mesh(const std::string& bytes, const char* name) {
  for (const int pieces : {1, 3}) {
    MeshFaults faults;
    const ImportedMesh imported = mesh_of(bytes, name, {1e-3, {}, pieces}, faults);
    if (!faults.empty()) {
      require(!faults.list().front().message.empty(), "a fault without words");
      continue;
    }
    const HexMesh& mesh = imported.mesh;
    require(!mesh.elements.empty() && mesh.part.size() == mesh.elements.size(), "a mesh without elements");
    require(mesh.nodes.size() <= bytes.size() && mesh.elements.size() <= bytes.size(), "a mesh that grows");
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      require(hex_shape(mesh.corners(e)).smallest_jacobian > 0, "an accepted element without volume");
    for (const auto& [set, nodes] : mesh.node_sets)
      require(!nodes.empty() && nodes.back() < static_cast<std::int32_t>(mesh.nodes.size()),
              "a set of nodes");
  }
}
void read_mesh_deck(const std::string& bytes) {
  read_mesh(bytes, "a.k");
}
void read_mesh_gmsh(const std::string& bytes) {
  read_mesh(bytes, "a.msh");
}
void read_mesh_abaqus(const std::string& bytes) {
  read_mesh(bytes, "a.inp");
}

std::vector<std::string> scene_seeds() {
  std::vector<std::string> seeds;
  for (const char* name : {"tyre", "bar-wave", "hammer", "corrugation-d", "sphere-on-block"})
    seeds.push_back(shipped(fmt::format("scenes/{}.toml", name).c_str()));
  seeds.push_back(resolved_toml(resolve_scene(fs::path(TREAD_SOURCE_DIR) / "scenes/corrugation-d.toml")));
  return seeds;
}

std::vector<std::string> table_seeds() {
  return {"# x [m]  d [mm]\n0 0\n0.01 0.02\n0.02, 0\n", "1;2\n3;4\n5;-6e-1 # end\n",
          "# y [mm]  r [mm]\n-40 145\n-30 165\n-30 340\n-40 365\n35 365\n25 340\n25 165\n35 145\n",
          "# x [mm], y [mm], d [um]\n0,0,1\n1,0,2\n0,1,1\n1,1,3\n",
          "# fastening [-]  shift [mm]  stiffness [-]  damping [-]  bed [-]  holds [-]\n3 5 1 1 0.5 1\n1 0 0 "
          "0 1 0\n"};
}

/// A wheel with a flange and a rail's head, in the formats.
std::vector<std::string> profile_seeds() {
  std::string wheel, rail;
  for (double y = -68; y <= 60; y += 2)
    wheel += fmt::format("{:g} {:.4f}\n", y, y < -40 ? 28 - 0.08 * (y + 55) * (y + 55) : -0.03 * y);
  for (double y = -36; y <= 36; y += 1.5) rail += fmt::format("{:g} {:.4f}\n", y, -0.006 * y * y);
  const auto simpack = [](int type, const std::string& rows) {
    return fmt::format(
        "header.begin\n type = {}\nheader.end\nspline.begin\n units.len.f = 1000\n shift.y = 0\n mirror.y = "
        "0\n"
        " point.begin\n{} point.end\nspline.end\n",
        type, rows);
  };
  return {simpack(1, wheel),
          simpack(0, rail),
          "MPTypeNo=101\nXOffset=0\nColumnDef=X,Y\n\n" + wheel,
          "MINIPROF 101\nStock.:\n\n" + rail,
          "a wheel in mm\n65\n" + wheel,
          "# y [mm] z [mm]\n" + rail};
}

std::vector<std::string> roughness_seeds() {
  std::string text = "# x [m]  r [um]\n";
  for (int i = 0; i < 60; ++i) text += fmt::format("{:g} {}\n", 1e-3 * i, (i * i) % 7);
  return {text};
}

std::vector<std::string> map_seeds() {
  std::vector<std::string> seeds;
  for (const std::uint64_t rows : {1, 2, 3}) {
    const fs::path path = workplace() / "seed.h5";
    {
      Hdf5File file = Hdf5File::create(path);
      const std::vector<double> places = {0, 1, 2};
      file.write<double>("x", places);
      file.write<double>("y", std::span(places).first(rows));
      file.write<double>("depth", std::vector<double>(3 * rows, 0.5), {rows, 3});
      for (const char* name : {"x", "y", "depth"}) file.write_attribute(name, "unit", "mm");
    }
    seeds.push_back(content_of(path));
  }
  return seeds;
}

std::vector<std::string> checkpoint_seeds() {
  const SealedContent content = {{"order/scene/text", std::string("[scene]\n")},
                                 {"order/later/count", std::vector<std::int64_t>{0}},
                                 {"results/dt", std::vector{1e-7}},
                                 {"histories/samples", std::vector<double>(60, 0.5)},
                                 {"order/command", std::string()}};
  const fs::path path = workplace() / "seed.h5";
  write_sealed(path, "checkpoint", kCheckpointFileVersion, content);
  return {content_of(path)};
}

std::vector<std::string> run_folder_seeds() {
  std::vector<std::string> seeds = {
      "histories.csv\ntime [s],wheel_x [m],vertical_force [N]\n0,0.1,1e5\n1e-5,0.2,1.1e5\n",
      "scene.resolved.toml\n" + shipped("scenes/tyre.toml"), "status.json\n{\n  \"stage\": \"rolling\"\n}\n",
      "request\ncheckpoint\n",
      "records.jsonl\n{\"name\": \"a\", \"n\": 1e3, \"ok\": true, \"none\": null}\n"};
  for (const std::string& file : checkpoint_seeds())
    for (const char* name : {"checkpoint/order.h5\n", "checkpoint/step-000000000007.h5\n"})
      seeds.push_back(name + file);
  return seeds;
}

std::vector<std::string> mesh_deck_seeds() {
  return {samples::keyword_file(samples::SolidCards::one), samples::keyword_file(samples::SolidCards::two)};
}
std::vector<std::string> mesh_gmsh_seeds() {
  return {samples::gmsh_file("4.0"), samples::gmsh_file("4.1")};
}
std::vector<std::string> mesh_abaqus_seeds() {
  return {samples::abaqus_file()};
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {{"scene", read_scene_text, scene_seeds},
                                          {"table", read_table, table_seeds},
                                          {"profile", read_profile, profile_seeds},
                                          {"roughness", read_roughness, roughness_seeds},
                                          {"map", read_map, map_seeds},
                                          {"checkpoint", read_checkpoint, checkpoint_seeds},
                                          {"run_folder", read_run_folder, run_folder_seeds},
                                          {"mesh_deck", read_mesh_deck, mesh_deck_seeds},
                                          {"mesh_gmsh", read_mesh_gmsh, mesh_gmsh_seeds},
                                          {"mesh_abaqus", read_mesh_abaqus, mesh_abaqus_seeds}};
  return all;
}

const Target& target(const std::string& name) {
  for (const Target& target : targets())
    if (target.name == name) return target;
  throw InputError(fmt::format("there is no target '{}' in tests/fuzz/targets.cpp", name));
}

std::vector<std::string> corpus(const Target& target) {
  std::vector<std::string> all = target.seeds();
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(TREAD_SOURCE_DIR) / "tests/fuzz/corpus" / target.name))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) all.push_back(content_of(path));
  return all;
}

std::string resealed(const std::string& file) {
  if (file.size() < kHeader) return file;
  const std::string body = file.substr(kHeader);
  const auto stated = [&](const std::string& word) {
    const std::size_t at = file.substr(0, kHeader).find(word);
    if (at == std::string::npos) return std::string("0");
    return file.substr(at + word.size(), file.find('\n', at) - at - word.size());
  };
  Hash hash;
  hash.add(std::as_bytes(std::span(body)));
  std::string header = fmt::format("tread checkpoint\nversion {}\nbytes {}\nindex {}\nchecksum {:016x}\n",
                                   stated("version "), file.size(), stated("index "), hash.value());
  header.resize(kHeader, '\0');
  return header + body;
}

}  // namespace tread::fuzz
