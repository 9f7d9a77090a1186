#pragma once
// The state of material laws in the elements of a run.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/page_vector.hpp"
#include "core/state_list.hpp"

namespace tread {

/// Number of the law of a block's materials in Laws. InputError where they differ, or where the block cannot
/// have their law.
int law_of(const SweptBlock& block);

/// Returns true if a block of the mesh has a law that is not linear.
bool has_laws(const Mesh& mesh);

class ConstLawState;

/// Values by block: [tile][place of the quad in the front plan][value][lane]; none in blocks whose law has no
/// state. Zero in undeformed bodies and in unused lanes.
template <class Real>
class LawState {
 public:
  /// Keeps a reference to the mesh.
  explicit LawState(const Mesh& mesh);

  Real* values(int block) { return values_[static_cast<std::size_t>(block)].data(); }
  const Real* values(int block) const { return values_[static_cast<std::size_t>(block)].data(); }

  /// Copies the values of a state of the same mesh.
  void copy(const ConstLawState& from);

  void list_state(StateList& list) {
    for (std::size_t block = 0; block < values_.size(); ++block)
      if (!values_[block].empty()) list.add(mesh_->blocks[block].name, std::span(values_[block]));
  }

 private:
  const Mesh* mesh_;
  std::vector<PageVector<Real>> values_;
};

/// Number of values of a mesh's LawState.
std::int64_t law_state_values(const Mesh& mesh);

/// A view to read, in double whatever the state is stored in. False: there is no state, bodies are as the
/// linear law has them.
class ConstLawState {
 public:
  ConstLawState(std::nullptr_t = nullptr) {}
  ConstLawState(const LawState<double>& state) : double_(&state) {}
  ConstLawState(const LawState<float>& state) : single_(&state) {}

  explicit operator bool() const { return double_ != nullptr || single_ != nullptr; }

  double value(int block, std::int64_t i) const {
    return single_ != nullptr ? single_->values(block)[i] : double_->values(block)[i];
  }

 private:
  const LawState<double>* double_ = nullptr;
  const LawState<float>* single_ = nullptr;
};

extern template class LawState<double>;
extern template class LawState<float>;

}  // namespace tread
