#include "drivers/engine/start/static_system.hpp"

#include <cstddef>

#include "core/parallel/chunks.hpp"

namespace tread {

AlignedVector<double> StaticSystem::diagonal() const {
  AlignedVector<double> diagonal(static_cast<std::size_t>(3 * model_->mesh.slots), 0.0);
  model_->internal->diagonal(diagonal.data());
  for (const auto& body : model_->body_forces) body->add_diagonal(diagonal.data());
  if (model_->ties) model_->ties->gather_diagonal(diagonal.data());
  for (const std::int64_t unknown : model_->restrained) diagonal[static_cast<std::size_t>(unknown)] = 0;
  if (model_->guide)
    for (const std::int64_t unknown : model_->guide->unknowns())
      diagonal[static_cast<std::size_t>(unknown)] = 0;
  return diagonal;
}

void StaticSystem::apply(double* x, double* y, std::span<const double> factors) const {
  const double rise = model_->guide ? x[model_->guide->unknown()] : 0;
  expand(x);
  model_->apply_stiffness(x, y);
  for (std::size_t part = 0; part < factors.size(); ++part) scale(static_cast<int>(part), factors[part], y);
  if (model_->ties) model_->ties->clear(x);
  if (model_->guide) {
    for (const std::int64_t unknown : model_->guide->unknowns()) x[unknown] = 0;
    x[model_->guide->unknown()] = rise;
  }
  reduce(y);
}

/// Multiplies a vector field at the nodes of a block or body.
void StaticSystem::scale(int part, double factor, double* field) const {
  const HexBody* body = model_->mesh.body_of(part);
  const SweptBlock* block = body ? nullptr : &model_->mesh.blocks[static_cast<std::size_t>(part)];
  double* const first = field + 3 * (body ? body->base : block->base);
  for_chunks(3 * (body ? body->slots() : block->slots()), [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t i = from; i < to; ++i) first[i] *= factor;
  });
}

void StaticSystem::reduce(double* force) const {
  if (model_->ties) model_->ties->gather(force);
  if (model_->guide) model_->guide->reduce(force);
  for (const std::int64_t unknown : model_->restrained) force[unknown] = 0;
}

void StaticSystem::expand(double* field) const {
  if (model_->guide) model_->guide->expand(field);
  if (model_->ties) model_->ties->follow({field});
}

}  // namespace tread
