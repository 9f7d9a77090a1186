#pragma once
// Small scenes run at the ends of the program's range, and the outcome of a run.

#include <cstdint>
#include <functional>
#include <string>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"

namespace tread {

/// Sets one thread, on which small models run fastest. Restores the threads at its end.
class OneThread {
 public:
  OneThread() : before_(threads()) { set_threads(1); }
  ~OneThread() { set_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

/// A free steel bar, two by two square elements across, one end of which starts to move.
struct BarScene {
  double element_size = 5e-3;  ///< [m]
  double length = 0.2;         ///< [m]
  double poissons_ratio = 0.3;
  double duration = 1e-3;  ///< [s]
  std::string damping{};   ///< TOML value of material.steel.damping, or empty

  Scene scene() const;
};

/// A tyre of 0.86 m diameter on a short rail.
struct TyreScene {
  double element_size = 8e-3;     ///< [m]
  std::string rail = "box";       ///< "box", or CN60: two blocks, tied
  std::string support = "rigid";  ///< "rigid", or fastenings
  double speed = 10;              ///< [m/s]
  double duration = 5e-3;         ///< [s]
  std::string damping{};          ///< TOML value of material.steel.damping, or empty
  std::string contact{};          ///< further lines of [contact]
  std::string motion{};           ///< further lines of [motion]
  std::string more{};             ///< further tables

  Scene scene() const;
};

/// Outcome of a run.
struct SmallRun {
  bool stopped = false;      ///< true if the energies or the contact search stopped the run
  std::int64_t steps = 0;    ///< number of steps done
  std::string reason;        ///< reason of the stop
  double largest_share = 0;  ///< largest share of the energy that ends a run, EnergyWatch::share() [-]
};

/// Does `steps` steps of dt [s] from the scene's static state, which must belong to it. `see` receives every
/// sample, every 16 steps.
SmallRun run_small(const Scene& scene, const Preload& preload, double dt, std::int64_t steps,
                   const std::function<void(const Simulation&)>& see = {});

}  // namespace tread
