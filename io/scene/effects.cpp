#include "io/scene/effects.hpp"

namespace tread {

const std::vector<EffectText>& effect_texts() {
  static const std::vector<EffectText> kTexts = {
      {Effect::text, "text", "what reports call the scene"},
      {Effect::fineness, "fineness", "how finely the same passage is computed"},
      {Effect::mesh, "mesh", "nodes, elements and ties of the smooth bodies"},
      {Effect::preload, "preload", "the static state on the same mesh"},
      {Effect::motion, "motion", "the motion from the same static state"},
      {Effect::cost, "cost", "step, memory or disk of the same mesh"},
      {Effect::surface, "surface", "the depth of the corrugation"},
      {Effect::room, "room", "the depth that the searched surface has room for"},
      {Effect::duration, "duration", "how long the motion is followed, and the stretch of track for that"},
      {Effect::output, "output", "what the run's folder tells of the motion"},
      {Effect::process, "process", "how the process shows progress and saves its state"},
      {Effect::stop, "stop", "what ends the process before the duration"},
      {Effect::forks, "forks", "the state that is kept for other runs"},
      {Effect::wear, "wear", "how `tread develop` goes from a passage to the next"},
  };
  return kTexts;
}

std::string Effects::names() const {
  std::string text;
  for (const EffectText& each : effect_texts())
    if (has(each.effect)) text += (text.empty() ? "" : ", ") + std::string(each.name);
  return text;
}

}  // namespace tread
