#include "drivers/report/energy_tables.hpp"

#include <fmt/core.h>

#include "drivers/report/mesh_measures.hpp"
#include "drivers/results/run_warnings.hpp"
#include "io/report/markup.hpp"
#include "kernels/material/law_state.hpp"

namespace tread {

std::string energy_error_text(const Model& model, const RunResults& r) {
  return fmt::format(
      "Energy error {} %: largest residual over the sum of frictional work, losses in dampers{}{} and range "
      "of strain energy, at least 1 % of the strain energy{}.",
      readable(100 * r.energy_error, 2), model.has_branches() ? ", losses in materials" : "",
      has_laws(model.mesh) ? ", plastic work" : "", uncounted_loss(model));
}

Table body_energy_table(const Model& model, const RunResults& r) {
  Table table{r.part_energy.empty() ? "Energy of deformation" : "Energy of deformation at the end",
              {{"Body"},
               {"One-point stress [J]", Align::right},
               {"Hourglass [J]", Align::right},
               {"Hourglass share", Align::right}},
              {}};
  for (const BlockGroup& group : block_groups(model)) {
    DeformationEnergy sum;
    for (const int b : group.blocks) {
      const DeformationEnergy energy = r.part_energy.empty() ? model.energy(b, r.preload.displacement.data())
                                                             : r.part_energy[static_cast<std::size_t>(b)];
      sum.strain += energy.strain;
      sum.hourglass += energy.hourglass;
    }
    const double all = sum.strain + sum.hourglass;
    table.rows.push_back({group.name, readable(sum.strain), readable(sum.hourglass),
                          all > 0 ? fmt::format("{:.2f} %", 100 * sum.hourglass / all) : "–"});
  }
  return table;
}

Table momentum_table(const MomentumCheck& momentum, double error) {
  Table table{
      fmt::format("Momentum of wheelset, unsprung and sprung mass: error {} %", readable(100 * error, 2)),
      {{"Direction"},
       {"Impulse of all forces [N s]", Align::right},
       {"Change of momentum [N s]", Align::right},
       {"Impulse of the contact [N s]", Align::right}},
      {}};
  const auto row = [&](const char* name, double impulse, double change, double contact) {
    table.rows.push_back({name, readable(impulse), readable(change), readable(contact)});
  };
  row("along the rail", momentum.impulse.x, momentum.change.x, momentum.contact_impulse.x);
  row("vertical", momentum.impulse.z, momentum.change.z, momentum.contact_impulse.z);
  return table;
}

}  // namespace tread
