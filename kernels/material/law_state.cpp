#include "kernels/material/law_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

namespace {

int law_of(const SweptBlock& block, const Material& material) {
  const int law = Laws::find(material.law);
  if (law < 0)
    throw InputError(fmt::format("block '{}': the material '{}' has the law '{}'; known laws: {}", block.name,
                                 material.name, material.law, fmt::join(Laws::names(), ", ")));
  const char* refusal =
      Laws::with(law, [&]<template <class> class Law>() { return Law<double>::refusal(material); });
  if (refusal != nullptr)
    throw InputError(fmt::format("block '{}': the material '{}' of the law '{}' cannot be: {}", block.name,
                                 material.name, material.law, refusal));
  return law;
}

std::int64_t state_values_of(const SweptBlock& block) {
  const std::int64_t values = state_values(tread::law_of(block));
  return static_cast<std::int64_t>(block.tiles.size() * block.section.quads.size()) * values * kLanes;
}

}  // namespace

int law_of(const SweptBlock& block) {
  const int law = law_of(block, block.materials.front());
  for (const Material& material : block.materials) {
    const int other = law_of(block, material);
    if (block.vertical_only && !is_linear(other))
      throw InputError(fmt::format(
          "block '{}': its nodes move vertically only, which is a model of linear elasticity, but "
          "its material '{}' has "
          "the law '{}'; state law = \"elastic\"",
          block.name, material.name, material.law));
    if (other != law)
      throw InputError(
          fmt::format("block '{}': the materials '{}' and '{}' have the laws '{}' and '{}', but a block's "
                      "elements are computed "
                      "by one; state the same law for both",
                      block.name, block.materials.front().name, material.name, block.materials.front().law,
                      material.law));
  }
  return law;
}

bool has_laws(const Mesh& mesh) {
  return std::any_of(mesh.blocks.begin(), mesh.blocks.end(),
                     [](const SweptBlock& block) { return !is_linear(law_of(block)); });
}

std::int64_t law_state_values(const Mesh& mesh) {
  std::int64_t sum = 0;
  for (const SweptBlock& block : mesh.blocks) sum += state_values_of(block);
  return sum;
}

template <class Real>
LawState<Real>::LawState(const Mesh& mesh) : mesh_(&mesh) {
  for (const SweptBlock& block : mesh.blocks)
    values_.emplace_back(static_cast<std::size_t>(state_values_of(block)));
}

template <class Real>
void LawState<Real>::copy(const ConstLawState& from) {
  for (std::size_t block = 0; block < values_.size(); ++block)
    for (std::size_t i = 0; i < values_[block].size(); ++i)
      values_[block][i] =
          static_cast<Real>(from.value(static_cast<int>(block), static_cast<std::int64_t>(i)));
}

template class LawState<double>;
template class LawState<float>;

}  // namespace tread
