#include "io/scene/effects.hpp"

namespace tread {

const std::vector<EffectText>& effect_texts() {
  static const std::vector<EffectText> kTexts = {
      {Effect::text, "text", "the name of the scene in reports"},
      {Effect::fineness, "fineness", "the fineness of the same passage"},
      {Effect::mesh, "mesh", "nodes, elements and ties of the smooth bodies"},
      {Effect::preload, "preload", "the static state on the same mesh"},
      {Effect::motion, "motion", "the motion from the same static state"},
      {Effect::cost, "cost", "step, memory or disk space of the same mesh"},
      {Effect::surface, "surface", "the depth of the corrugation"},
      {Effect::room, "room", "the depth for which the searched surface has room"},
      {Effect::duration, "duration", "the simulated time, and the stretch of track for it"},
      {Effect::output, "output", "the results in the run's folder"},
      {Effect::process, "process", "progress lines and checkpoints"},
      {Effect::stop, "stop", "the end of the process before the duration"},
      {Effect::forks, "forks", "the state that is kept for other runs"},
      {Effect::wear, "wear", "the step of `tread develop` from a passage to the next"},
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
