#pragma once
// A scene brought to the first step of its motion.

#include <string>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/process/progress.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

class RollingScene {
 public:
  /// Makes mesh, preload (or finds it in the cache) and step. Throws InputError for a scene without a motion,
  /// and as scene_model() and settle_device() do.
  RollingScene(const ResolvedScene& resolved, const Progress& progress, const std::string& device = "");

  const Model& model() const { return model_; }
  double dt() const { return dt_; }
  /// Simulation at the start. Only one may exist at a time, as all share the model's contact.
  Simulation start() const;

 private:
  Model model_;
  Preload preload_;
  double dt_ = 0;  ///< [s]
};

}  // namespace tread
