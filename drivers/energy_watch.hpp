#pragma once
// Judges the energies of a run: what appears or vanishes cannot exceed what was supplied. [theory.md, Energy stop]

namespace tread {

struct EnergyLedger;

/// Energy that was supplied to the elastic bodies and the energy that the balance misses, sample by sample.
/// A sound run misses a small part of what was supplied, whatever happens in it; a motion that blows up misses
/// more within a few steps. The kinetic energy here is the mean of both half steps', which cannot be negative:
/// the product of both half steps' velocities conserves energy in a blow-up too.
class EnergyWatch {
 public:
  /// The first sample. `kinetic`: mean of both half steps; `elastic_kinetic`: its part in bodies that do not
  /// travel. [J]
  void start(const EnergyLedger& energy, double kinetic, double elastic_kinetic);

  /// A later sample; false where more appeared or vanished than was supplied, or a value is not finite.
  bool sound(const EnergyLedger& energy, double kinetic);

  double missed() const { return missed_; }      ///< appeared (> 0) or vanished (< 0) since the start [J]
  double supplied() const { return supplied_; }  ///< [J]

 private:
  double total_ = 0;             ///< of the start [J]
  double kinetic_ = 0;           ///< of the start [J]
  double gravity_ = 0;           ///< of the start [J]
  double stored_ = 0;            ///< in springs and elastic motion at the start [J]
  double slowed_ = 0;            ///< largest loss of kinetic energy so far [J]
  double fallen_ = 0;            ///< largest loss of potential energy so far [J]
  double driven_ = 0;            ///< largest work of the torque so far [J]
  double missed_ = 0, supplied_ = 0;
};

}  // namespace tread
