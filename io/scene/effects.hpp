#pragma once
// Effects of a key's value. Each key of the schema states its effects; caches, forks, studies
// and the dial ask them.

#include <initializer_list>
#include <string>
#include <vector>

namespace tread {

/// An effect includes those that follow from it: another mesh is another static state, another static state
/// is another motion. A key states the first of them alone.
enum class Effect : unsigned {
  text,      ///< what reports call the scene
  fineness,  ///< how finely the same passage is computed
  mesh,      ///< nodes, elements and ties of the smooth bodies
  preload,   ///< static state on the same mesh
  motion,    ///< motion from the same static state
  cost,      ///< step, memory or disk of the same mesh
  surface,   ///< depth of the corrugation, by moved nodes or in the contact gap
  room,      ///< depth that the searched surface has room for
  duration,  ///< how long the motion is followed
  output,    ///< what the run's folder tells of the motion
  process,   ///< how the process shows progress and saves its state
  stop,      ///< what ends the process before the duration
  forks,     ///< the state that is kept for other runs
  wear       ///< how `tread develop` goes from a passage to the next
};

class Effects {
 public:
  constexpr Effects(std::initializer_list<Effect> effects) {
    for (const Effect effect : effects) bits_ |= bit(effect);
  }
  /// Effects of a key that stands for other keys: the base of a scene.
  static constexpr Effects all() {
    Effects effects({});
    effects.bits_ = ~0U;
    return effects;
  }

  constexpr bool has(Effect effect) const { return (bits_ & bit(effect)) != 0; }
  constexpr bool any_of(Effects others) const { return (bits_ & others.bits_) != 0; }
  constexpr bool only(Effects others) const { return (bits_ & ~others.bits_) == 0; }

  /// Returns true if the value enters the static state of a run over the same stretch of track. Many keys act
  /// on that stretch together: compare it by itself (run_span).
  constexpr bool on_preload() const { return any_of({Effect::mesh, Effect::preload}); }
  /// Returns true if the value enters the motion of a run over a smooth rail.
  constexpr bool on_smooth_motion() const { return any_of({Effect::mesh, Effect::preload, Effect::motion}); }
  /// Returns true if runs that differ in the value differ in their results.
  constexpr bool on_results() const {
    return on_smooth_motion() || any_of({Effect::surface, Effect::duration, Effect::output, Effect::wear});
  }

  /// The words of EffectText, "mesh, cost".
  std::string names() const;

  constexpr Effects operator|(Effects others) const {
    others.bits_ |= bits_;
    return others;
  }
  constexpr bool operator==(const Effects&) const = default;

 private:
  static constexpr unsigned bit(Effect effect) { return 1U << static_cast<unsigned>(effect); }
  unsigned bits_ = 0;
};

/// An effect as docs/reference/scene.md has it.
struct EffectText {
  Effect effect;
  const char* name;
  const char* meaning;
};
const std::vector<EffectText>& effect_texts();

}  // namespace tread
