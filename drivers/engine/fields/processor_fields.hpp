#pragma once
// The fields of a run that one process moves: contact beside the elements away from the patch.
// [docs/architecture.md, Step]

#include <algorithm>
#include <cstdint>

#include "core/parallel/chunks.hpp"
#include "drivers/engine/fields/patch_tiles.hpp"
#include "drivers/engine/fields/precise_fields.hpp"

namespace tread {

template <class Real, class U>
class ProcessorFields final : public PreciseFields<Real, U> {
 public:
  explicit ProcessorFields(const Model& model)
      : PreciseFields<Real, U>(model), patch_tiles_(model, this->joined_tiles()) {
    this->use_large_pages();
    this->take_masses();
    // Memory lies near the thread that touches it first: the one that begins with these values in steps.
    for_chunks(3 * model.mesh.slots, [this](std::int64_t first, std::int64_t last) {
      std::fill(this->u().begin() + first, this->u().begin() + last, U{0});
      std::fill(this->v().begin() + first, this->v().begin() + last, Real{0});
    });
  }

  /// A patch of many points is better solved by all threads.
  bool follow_patch(const BodyFrame& wheel, double dt) override {
    const Model& model = this->model();
    return model.contact && !model.contact->shares_patch() && patch_tiles_.find(wheel, dt);
  }

  void move_with_contact(const StepLoads& loads, double time) override {
    this->force_bodies();
    const auto search = [&](std::int64_t first, std::int64_t last) {
      this->search_contact(loads, time, first, last);
    };
    const auto solve = [&] { this->solve_contact(loads); };
    this->internal().move(
        {patch_tiles_.near(), patch_tiles_.elsewhere(), this->model().contact->columns(), search, solve},
        this->update(), loads, this->force_fields());
  }

 private:
  PatchTiles patch_tiles_;
};

}  // namespace tread
