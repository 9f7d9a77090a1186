#pragma once
// Small scenes that are run at the ends of the program's range, and what becomes of a run there.

#include <cstdint>
#include <functional>
#include <string>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/preload.hpp"
#include "drivers/engine/simulation.hpp"

namespace tread {

/// Small models run fastest on one thread; gives the threads back at its end.
class OneThread {
 public:
  OneThread() : before_(threads()) { set_threads(1); }
  ~OneThread() { set_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

/// A free steel bar, a square of two elements by two across, one end of which starts to move.
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
  std::string rail = "box";       ///< or CN60: two blocks, tied
  std::string support = "rigid";  ///< or fastenings
  double speed = 10;              ///< [m/s]
  double duration = 5e-3;         ///< [s]
  std::string damping{};          ///< TOML value of material.steel.damping, or empty
  std::string contact{};          ///< further lines of [contact]
  std::string motion{};           ///< further lines of [motion]
  std::string more{};             ///< further tables

  Scene scene() const;
};

/// How a run went.
struct SmallRun {
  bool stopped = false;      ///< by the energies, or by the contact search
  std::int64_t steps = 0;    ///< done
  std::string reason;        ///< of the stop
  double largest_share = 0;  ///< of the energy that ends a run, EnergyWatch::share() [-]
};

/// `steps` steps of dt [s] from the scene's static state, which must belong to it; sees every sample, every
/// 16 steps.
SmallRun run_small(const Scene& scene, const Preload& preload, double dt, std::int64_t steps,
                   const std::function<void(const Simulation&)>& see = {});

}  // namespace tread
