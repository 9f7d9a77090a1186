#pragma once
// Judge of a run's energies: the error of the balance cannot exceed the energy supplied. [theory.md, Energy
// stop]

#include <cstdint>

#include "core/state_list.hpp"
#include "drivers/engine/features/energy_ledger.hpp"

namespace tread {

/// Comparison, sample by sample, of the energy supplied to the elastic bodies with two others: the error of
/// the balance, and the energy of oscillations that the step hardly resolves. The second is needed because
/// central difference conserves its energy beyond the stable step too. Kinetic energy, the product of both
/// half steps' velocities, then falls below zero as strain energy grows.
class EnergyWatch {
 public:
  /// Takes the first sample. `excess`: mean of both half steps' kinetic energies less energy.kinetic;
  /// `elastic_kinetic`: kinetic energy of bodies that do not travel. [J]
  void start(const EnergyLedger& energy, double excess, double elastic_kinetic);

  /// Takes a later sample. Returns false if share() exceeds 1 for the second time in a row or a value is not
  /// finite.
  bool balanced(const EnergyLedger& energy, double excess);

  bool started() const { return started_ != 0; }
  double start_energy() const { return total_; }  ///< EnergyLedger::total() of the first sample [J]
  double missed() const { return missed_; }       ///< appeared (> 0) or vanished (< 0) since the start [J]
  double supplied() const { return supplied_; }   ///< since the start, what was there included [J]
  double share() const { return share_; }         ///< error over the error that ends a run [-]

  void list_state(StateList& list) {
    list.add("started", started_);
    list.add("total", total_);
    list.add("excess", excess_);
    list.add("kinetic", kinetic_);
    list.add("gravity", gravity_);
    list.add("stored", stored_);
    list.add("slowed", slowed_);
    list.add("fallen", fallen_);
    list.add("driven", driven_);
    list.add("missed", missed_);
    list.add("supplied", supplied_);
    list.add("share", share_);
    list.add("breaches", breaches_);
  }

 private:
  std::int64_t started_ = 0;  ///< 1 from the first sample on
  double total_ = 0;          ///< of the start [J]
  double excess_ = 0;         ///< of the start [J]
  double kinetic_ = 0;        ///< mean of both half steps at the start [J]
  double gravity_ = 0;        ///< of the start [J]
  double stored_ = 0;         ///< in springs and elastic motion at the start [J]
  double slowed_ = 0;         ///< largest loss of kinetic energy so far [J]
  double fallen_ = 0;         ///< largest loss of potential energy so far [J]
  double driven_ = 0;         ///< largest work of torque, guide and hammer so far [J]
  double missed_ = 0, supplied_ = 0, share_ = 0;
  std::int64_t breaches_ = 0;  ///< in a row
};

}  // namespace tread
