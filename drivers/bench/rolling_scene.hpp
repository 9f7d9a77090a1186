#pragma once
// A scene that has been brought to the first step of its motion.

#include <memory>

#include "drivers/engine/model.hpp"
#include "drivers/engine/preload.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/process/progress.hpp"

namespace tread {

class RollingScene {
 public:
  /// Mesh, preload, step. InputError for a scene without a motion.
  RollingScene(const Scene& scene, const Progress& progress);

  const Model& model() const { return *model_; }
  double dt() const { return dt_; }
  /// At the start; one at a time, as they share the model's contact.
  Simulation start() const;

 private:
  std::unique_ptr<Model> model_;
  Preload preload_;
  double dt_ = 0;  ///< [s]
};

}  // namespace tread
