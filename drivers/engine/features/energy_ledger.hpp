#pragma once
// The energy balance of a run. [theory.md, Energy stop]

#include <array>

namespace tread {

/// Energies and works by kind [J]; `residual` closes the balance.
struct EnergyLedger {
  double kinetic = 0;
  double strain = 0;      ///< stored by laws and hourglass stiffness, all bodies, and springs of branches
  double connectors = 0;  ///< springs of fastenings and suspension
  double penalty = 0;     ///< stored in contact
  double gravity = 0;     ///< potential
  double frictional_work = 0;  ///< dissipated
  double connector_loss = 0;   ///< dissipated in dampers of fastenings and suspension
  double contact_loss = 0;     ///< lost because contact forces lead the motion by half a step
  double material_loss = 0;    ///< dissipated in Maxwell branches
  double plastic_work = 0;     ///< dissipated by material laws with a state
  double torque_work = 0;      ///< done by the torque
  double guide_work = 0;       ///< done by the guide that holds the bore's forward speed
  double hammer_work = 0;      ///< done by the hammer
  double residual = 0;         ///< total() less that at the start

  /// Stored and lost energy less the work of torque, guide and hammer: constant [J].
  double total() const;
};

enum class EnergyRole { stored, lost, supplied };

/// Part of a model whose histories hold an energy.
enum class EnergyPart { bodies, contact, hammer, branches, laws };

/// An energy of the balance: its column in the histories, its title in figures.
struct EnergyKind {
  double EnergyLedger::*member;
  EnergyRole role;
  EnergyPart part;
  const char* name;
  const char* title;
};

/// All energies in the order in which total() adds them.
inline constexpr std::array kEnergyKinds = {
    EnergyKind{&EnergyLedger::kinetic, EnergyRole::stored, EnergyPart::bodies, "kinetic_energy",
               "kinetic energy of all bodies"},
    EnergyKind{&EnergyLedger::strain, EnergyRole::stored, EnergyPart::bodies, "strain_energy",
               "strain energy, hourglass part included"},
    EnergyKind{&EnergyLedger::connectors, EnergyRole::stored, EnergyPart::bodies, "connector_energy",
               "energy in springs"},
    EnergyKind{&EnergyLedger::penalty, EnergyRole::stored, EnergyPart::contact, "penalty_energy",
               "energy in the contact penalties"},
    EnergyKind{&EnergyLedger::gravity, EnergyRole::stored, EnergyPart::bodies, "gravity_energy",
               "potential energy"},
    EnergyKind{&EnergyLedger::frictional_work, EnergyRole::lost, EnergyPart::contact, "frictional_work",
               "frictional work"},
    EnergyKind{&EnergyLedger::connector_loss, EnergyRole::lost, EnergyPart::bodies, "connector_loss",
               "loss in dampers"},
    EnergyKind{&EnergyLedger::contact_loss, EnergyRole::lost, EnergyPart::contact, "contact_loss",
               "numerical loss in contact"},
    EnergyKind{&EnergyLedger::material_loss, EnergyRole::lost, EnergyPart::branches, "material_loss",
               "loss in Maxwell branches"},
    EnergyKind{&EnergyLedger::plastic_work, EnergyRole::lost, EnergyPart::laws, "plastic_work",
               "plastic work"},
    EnergyKind{&EnergyLedger::torque_work, EnergyRole::supplied, EnergyPart::contact, "torque_work",
               "work of the torque"},
    EnergyKind{&EnergyLedger::guide_work, EnergyRole::supplied, EnergyPart::contact, "guide_work",
               "work of the bore's guide"},
    EnergyKind{&EnergyLedger::hammer_work, EnergyRole::supplied, EnergyPart::hammer, "hammer_work",
               "work of the hammer"},
};
static_assert(sizeof(EnergyLedger) == (kEnergyKinds.size() + 1) * sizeof(double));  // and the residual

inline double EnergyLedger::total() const {
  double sum = 0;
  for (const EnergyKind& kind : kEnergyKinds)
    sum += kind.role == EnergyRole::supplied ? -(this->*kind.member) : this->*kind.member;
  return sum;
}

}  // namespace tread
