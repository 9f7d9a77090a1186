#pragma once
// A model as a keyword deck numbers it: nodes, parts, sets; and its motion at t = 0.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/studies/export/deck_options.hpp"
#include "io/deck/radioss_file.hpp"
#include "io/vtk/vtk_grid.hpp"

namespace tread {

/// The numbers of a deck given out last, by kind. Nodes, elements and sets of all kinds count through.
struct DeckNumbers {
  std::int64_t node = 0, element = 0, part = 0, section = 0, material = 0, set = 0, curve = 0, contact = 0,
               coordinates = 0;
};

/// Cards that OpenRadioss reads beside a preloaded deck, because no keyword of it would do.
struct RadiossCards {
  std::vector<RadiossTie> ties;
  std::vector<RadiossContact> contacts;
  std::vector<RadiossReference> references;
  std::vector<std::pair<std::int64_t, Vec3>> velocities;  ///< of each node at t = 0 [mm/ms]
};

class DeckModel {
 public:
  /// Keeps a reference. The scene has [motion]; without a preload its motion starts rigidly. `step`: of this
  /// program [s].
  DeckModel(const Model& model, const DeckOptions& options, double step);

  const Model& model() const { return *model_; }
  const Scene& scene() const { return model_->scene; }
  const DeckOptions& options() const { return options_; }
  const VtkGrid& grid() const { return grid_; }
  const BodyFrame& wheel() const { return wheel_; }  ///< at t = 0
  bool preloaded() const { return options_.preload != nullptr; }
  /// Displacements from the undeformed places at t = 0, by slot, in the nodes' bases [m].
  ConstNodeField displacement() const { return displacement_.data(); }

  /// Number of the node in a slot of the mesh.
  std::int64_t node(std::int64_t slot) const { return node_of_slot_[static_cast<std::size_t>(slot)]; }
  std::int64_t node(const SweptBlock& block, int section_node, int station) const {
    return node(block.base + block.slot(section_node, station));
  }
  std::int64_t slot(const VtkGrid::Point& point) const;
  /// Calls visit(number of the node, its weight) for the nodes that carry a point of a face.
  template <class Visit>
  void for_each_node_of(const Attachment& point, const Visit& visit) const {
    for (std::size_t k = 0; k < point.slot.size(); ++k)
      if (point.slot[k] >= 0 && point.weight[k] > 0) visit(node(point.slot[k]), point.weight[k]);
  }

  /// Place of a node in space at t = 0 [m].
  Vec3 place(const VtkGrid::Point& point) const;
  /// The same without its displacement.
  Vec3 undeformed_place(const VtkGrid::Point& point) const;
  Vec3 place(std::int64_t node) const { return place(grid_.points[static_cast<std::size_t>(node - 1)]); }
  /// Returns true if the node moves rigidly with wheel() at t = 0.
  bool rolls(const VtkGrid::Point& point) const;
  /// Its velocity in space [m/s].
  Vec3 velocity(const VtkGrid::Point& point) const;
  Vec3 velocity(std::int64_t node) const {
    return velocity(grid_.points[static_cast<std::size_t>(node - 1)]);
  }
  /// Motion of the sprung mass at t = 0 against that at rest.
  SprungStart sprung_start() const;

  /// Time at which the deck ends [s].
  double duration() const { return scene().motion->duration; }

  RadiossCards radioss;
  std::vector<std::pair<std::int64_t, int>> parts;  ///< of the bodies, and their blocks
  DeckNumbers numbers;                              ///< nodes of the mesh are numbered
  double step = 0;                                  ///< of this program [s]
  /// Nodes that are held, by their directions: 1 along, 2 across, 4 vertical, added up.
  std::map<int, std::vector<std::int64_t>> held;
  std::int64_t sprung = 0, unsprung = 0;              ///< nodes of these masses; 0: there are none
  std::vector<std::pair<std::int64_t, Vec3>> moving;  ///< nodes beside the mesh and their velocities [m/s]
  /// Constant forces on nodes beside the mesh, those of springs at t = 0 [N].
  std::vector<std::pair<std::int64_t, Vec3>> spring_forces;

 private:
  const Model* model_;
  DeckOptions options_;
  VtkGrid grid_;
  std::vector<std::int32_t> node_of_slot_;
  AlignedVector<double> displacement_, velocity_;  ///< relative to the frames [m], [m/s]
  BodyFrame wheel_;
};

/// Calls visit(near station, far station) for the elements along a block's sweep.
template <class Visit>
void for_each_pitch(const SweptBlock& block, const Visit& visit) {
  for (const Tile& tile : block.tiles)
    for (int element = 0; element < tile.elements; ++element)
      visit(tile.first_station + element, (tile.first_station + element + 1) % block.station_count());
}

}  // namespace tread
