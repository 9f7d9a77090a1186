#include "drivers/engine/device/device_movers.hpp"

#include <algorithm>

#include "drivers/engine/fields/featured_nodes.hpp"
#include "drivers/engine/fields/node_fields.hpp"
#include "drivers/engine/model/restraints.hpp"
#include "kernels/device/device_contact.hpp"
#include "kernels/device/device_sums.hpp"
#include "kernels/device/field_kernels.hpp"

namespace tread {

namespace {

void choose_holders(const Model& model, Movers& movers) {
  movers.held.assign(static_cast<std::size_t>(model.mesh.slots), 0);
  for (const std::int64_t unknown : held_unknowns(model.mesh, model.restrained)) {
    const std::int64_t group = unknown / kGroupValues;
    int& mark = movers.marks[static_cast<std::size_t>(group)];
    if (mark >= 0) {
      movers.held_hosts.push_back(unknown);
    } else if (mark == kKeeps) {
      movers.held_ties.push_back(unknown);
    } else {
      mark = kHolds;
      mark_held(unknown, movers.held);
    }
  }
}

}  // namespace

Movers movers_of(const Model& model) {
  GroupMarks host = connected_groups(model);
  const GroupMarks surfaces = surface_groups(model);
  GroupMarks tied = tied_groups(model);
  if (meet(host, tied) || meet(surfaces, tied)) {
    add_marks(host, tied);
    std::fill(tied.begin(), tied.end(), 0);
  }
  Movers movers;
  for (std::size_t group = 0; group < host.size(); ++group) {
    movers.marks.push_back(host[group] != 0   ? static_cast<int>(movers.hosted.size())
                           : tied[group] != 0 ? kKeeps
                                              : kMoves);
    if (host[group] != 0) movers.hosted.push_back(static_cast<std::int64_t>(group));
  }
  movers.contact = model.contact && !meet(host, surfaces);
  choose_holders(model, movers);
  return movers;
}

void mark_held(std::int64_t unknown, std::vector<unsigned char>& held) {
  held[static_cast<std::size_t>(unknown / kGroupValues * kLanes + unknown % kLanes)] |=
      static_cast<unsigned char>(1U << unknown % kGroupValues / kLanes);
}

DeviceNeed device_need(const Model& model) {
  const Movers movers = movers_of(model);
  const auto groups = static_cast<std::int64_t>(movers.hosted.size());
  const ValueBytes bytes = value_bytes(model.scene);
  const std::int64_t moved = 2 * (bytes.displacement + bytes.other);  // before and after the step
  const int others = bytes.other * (model.has_branches() ? 2 : 1);    // forces, lag
  DeviceNeed need;
  need.host_nodes = groups * kLanes;
  need.bytes = 3 * model.mesh.slots * (moved + others) + model.mesh.slots * (bytes.other + 1) +
               groups * kGroupValues * (bytes.displacement + 2 * bytes.other);
  if (has_laws(model.mesh)) need.bytes += 2 * bytes.other * law_state_values(model.mesh);
  if (model.ties) need.bytes += model.ties->bytes();
  if (movers.contact) need.bytes += DeviceContact::bytes(*model.contact);
  need.bytes += DeviceSums<double, double>::bytes(model.mesh);
  need.bytes += model.internal->bytes() * bytes.other / static_cast<std::int64_t>(sizeof(double));
  return need;
}

}  // namespace tread
