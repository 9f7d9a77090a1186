#include "drivers/engine/step_features.hpp"

#include <algorithm>
#include <utility>

#include "drivers/engine/features/fastenings.hpp"
#include "drivers/engine/features/guided_wheel.hpp"
#include "drivers/engine/features/hammer.hpp"
#include "drivers/engine/features/tied_blocks.hpp"
#include "drivers/engine/features/torque.hpp"
#include "drivers/engine/features/wheel_load.hpp"
#include "drivers/engine/features/wheel_rail_contact.hpp"
#include "drivers/engine/fields/maxwell_branches.hpp"
#include "drivers/engine/start/traction.hpp"

namespace tread {

template <class F, class... Arguments>
F* StepFeatures::add(Arguments&&... arguments) {
  auto feature = std::make_unique<F>(std::forward<Arguments>(arguments)...);
  F* added = feature.get();
  all_.push_back(std::move(feature));
  return added;
}

StepFeatures::StepFeatures(const Model& model, double patch_y) {
  bodies_ = add<Bodies>(model);
  if (model.has_branches())
    add<MaxwellBranches>(3 * model.mesh.slots * static_cast<std::int64_t>(value_bytes(model.scene).other));
  if (model.wheelset) add_wheel(model, patch_y);
  if (model.ties) add<TiedBlocks>(*model.ties);
  if (model.fastenings) add<Fastenings>(*model.fastenings);
  if (model.scene.vehicle && !model.journal.empty())
    vehicle_ = add<Vehicle>(*model.scene.vehicle, model.journal, model.scene.gravity);
  if (model.scene.load && !model.scene.vehicle && !model.journal.empty())
    add<WheelLoad>(model.scene.load->wheel_load, model.journal);
  if (model.hammer) add<Hammer>(*model.scene.hammer, *model.hammer);
  std::vector<Feature*> sampled;
  for (const std::unique_ptr<Feature>& feature : all_) sampled.push_back(feature.get());
  sampling_ = add<Sampling>(model, std::move(sampled));
  measurements_ = add<Measurements>(model, patch_y);
  for (const std::unique_ptr<Feature>& feature : all_)
    for (const PhaseInfo& info : feature->phases())
      by_phase_[static_cast<std::size_t>(info.phase)].push_back(feature.get());
}

void StepFeatures::add_wheel(const Model& model, double patch_y) {
  auto guided = model.guide ? std::make_unique<GuidedWheel>(*model.guide, model.journal_load()) : nullptr;
  GuidedBore* bore = guided ? &guided->bore() : nullptr;
  const auto block = [&](int index) -> const SweptBlock& {
    return model.mesh.blocks[static_cast<std::size_t>(index)];
  };
  const bool facets = model.scene.contact && model.scene.contact->surface == "facets";
  const WheelParts parts{*model.wheelset, block(model.index.tread),
                         facets ? SurfaceKind::facets : SurfaceKind::exact, bore,
                         model.ties ? &*model.ties : nullptr};
  wheel_ = add<WheelMotion>(parts, patch_y, model.scene.gravity);
  if (guided) all_.push_back(std::move(guided));
  if (const double torque = full_torque(model); torque != 0)
    add<Torque>(*model.scene.motion, torque, model.torque, bore);
  if (!model.contact) return;
  add<WheelRailContact>(*model.contact, model.mass.data(), patch_y);
  const double middle = model.scene.zone_start + 0.5 * model.scene.zone_length;
  record_ = add<SurfaceRecord>(*model.contact, *model.internal, block(model.index.rail_cap),
                               SurfaceRecord::Place{patch_y, middle});
}

std::vector<PhaseInfo> StepFeatures::phases() const {
  std::vector<PhaseInfo> list;
  for (const std::unique_ptr<Feature>& feature : all_)
    for (PhaseInfo& info : feature->phases()) list.push_back(std::move(info));
  std::stable_sort(list.begin(), list.end(),
                   [](const PhaseInfo& a, const PhaseInfo& b) { return a.phase < b.phase; });
  return list;
}

std::vector<FieldBytes> StepFeatures::fields() const {
  std::vector<FieldBytes> list;
  for (const std::unique_ptr<Feature>& feature : all_)
    for (const FieldBytes& field : feature->fields()) list.push_back(field);
  std::stable_sort(list.begin(), list.end(),
                   [](const FieldBytes& a, const FieldBytes& b) { return a.field < b.field; });
  return list;
}

Vec3 StepFeatures::momentum(const Motion& motion) const {
  Vec3 sum;
  for (const std::unique_ptr<Feature>& feature : all_) feature->add_momentum(motion, sum);
  return sum;
}

void StepFeatures::list_state(StateList& list) {
  for (const std::unique_ptr<Feature>& feature : all_) list.add_part(feature->name(), *feature);
}

void StepFeatures::list_unshared_state(StateList& list) {
  struct Unshared {
    Feature* feature;
    void list_state(StateList& fields) const { feature->list_unshared_state(fields); }
  };
  for (const std::unique_ptr<Feature>& feature : all_) {
    Unshared part{feature.get()};
    list.add_part(feature->name(), part);
  }
}

}  // namespace tread
