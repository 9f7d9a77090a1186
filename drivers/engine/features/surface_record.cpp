#include "drivers/engine/features/surface_record.hpp"

namespace tread {

SurfaceRecord::SurfaceRecord(Contact& contact, const InternalForce& internal, const SweptBlock& rail,
                             const Place& place)
    : contact_(&contact),
      internal_(&internal),
      surface_(contact.nodes().grid()),
      line_(rail, place.patch_y),
      last_x_(place.last_x) {
  contact.record_in(&surface_);
}

std::vector<PhaseInfo> SurfaceRecord::phases() const {
  return {{StepPhase::surface_fields,
           "rail surface near the patch",
           {RunField::contact_points, RunField::displacement},
           {RunField::surface_fields}}};
}

std::vector<FieldBytes> SurfaceRecord::fields() const {
  return {{RunField::surface_fields, SurfaceFields::bytes(surface_.grid()), true}};
}

void SurfaceRecord::apply(StepPhase /*phase*/, StepState& step) {
  const PatchNodes& patch = contact_->nodes();
  if (contact_->steps() == nullptr) surface_.add_step(patch);
  if (!step.sampled) return;
  surface_.add_sample(patch, static_cast<double>(step.sampling) * step.dt);
  surface_.add_stress(patch, *internal_, contact_->options().rail_block,
                      {step.displacement, step.lag, step.laws});
  if (notes_deflection(step)) line_.note_rolling(step.displacement, step.wheel.origin.x);
}

void SurfaceRecord::watch(const StepState& step, WatchedNodes& nodes) const {
  if (!step.sampled) return;
  contact_->nodes().for_each_pressed_cell([&](int station, int row) {
    nodes.add_element(contact_->options().rail_block, surface_.grid().quad[static_cast<std::size_t>(row)],
                      station);
  });
  if (notes_deflection(step))
    for (const std::int64_t slot : line_.slots()) nodes.add(slot);
}

void SurfaceRecord::list_state(StateList& list) {
  list.add_part("fields", surface_);
  list.add_part("line", line_);
}

}  // namespace tread
