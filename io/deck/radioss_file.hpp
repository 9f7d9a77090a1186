#pragma once
// An OpenRadioss starter file that reads a keyword deck and adds what keywords cannot say quickly.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/math/vec.hpp"

namespace tread {

struct RadiossTie {
  std::string title;
  std::int64_t nodes = 0, faces = 0;
  double reach = 0;  ///< [mm]
};

struct RadiossContact {
  std::string title;
  std::int64_t secondary = 0, primary = 0;  ///< sets of faces
  double friction = 0;                      ///< of fast slip [-]
  double more_friction = 0;                 ///< without slip, beyond that [-]
  double decay = 0;                         ///< of the latter [ms/mm]
};

struct RadiossReference {
  std::int64_t part = 0;
  std::vector<std::pair<std::int64_t, Vec3>> nodes;
};

/// Orders to the engine of OpenRadioss.
struct RadiossRun {
  std::string name;      ///< of the model
  double end = 0;        ///< [ms]
  double histories = 0;  ///< interval of the time history [ms]
  double frames = 0;     ///< interval of animations [ms]; 0: none
  double step = 0;       ///< largest [ms]
  double factor = 0;     ///< of the step of the nodes [-]
};

/// Text of the engine's file, NAME_0001.rad.
std::string radioss_run(const RadiossRun& run);

class RadiossFile {
 public:
  using Sink = std::function<void(std::string_view text)>;

  explicit RadiossFile(Sink sink) : sink_(std::move(sink)) {}

  /// Begins a model of this name, in mm, ms and kg, with the keyword deck in `deck`, a path relative to the
  /// folder of this file.
  void begin(std::string_view name, std::string_view deck);
  /// Ties a set of nodes to a set of faces that are at most `reach` [mm] away; sets as the deck numbers them.
  /// No mass is added to the faces (Spotflag 5).
  void tie(const RadiossTie& tie);
  /// Contact of two sets of faces whose overlap at the start pushes as later ones do; the time history gets
  /// its forces.
  void contact(const RadiossContact& contact);
  /// Places of a part's nodes at which its elements are free of stress [mm]. OpenRadioss takes the stress of
  /// elastic elements from there, and no initial stress.
  void reference(const RadiossReference& reference);
  /// Velocities of nodes by their numbers [mm/ms]. OpenRadioss makes an entity of each keyword
  /// *INITIAL_VELOCITY_NODE, which takes hours for as many nodes.
  void velocities(std::span<const std::pair<std::int64_t, Vec3>> nodes);
  void end();

 private:
  std::int64_t next_ = 90'000'000;  // no deck has as many of a kind
  Sink sink_;
};

}  // namespace tread
