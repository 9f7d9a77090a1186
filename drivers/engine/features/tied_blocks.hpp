#pragma once
// Ties between blocks: forces go to the primary nodes, motions come back. [theory.md, Ties]

#include "drivers/engine/features/feature.hpp"
#include "kernels/ties/tie.hpp"

namespace tread {

class TiedBlocks final : public Feature {
 public:
  /// Keeps a reference.
  explicit TiedBlocks(const Ties& ties) : ties_(&ties) {}

  const char* name() const override { return "ties"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override { return {{RunField::tie_links, ties_->bytes()}}; }
  void apply(StepPhase phase, StepState& step) override;

 private:
  const Ties* ties_;
};

}  // namespace tread
