#pragma once
// The fields of a run whose steps several processes share. [docs/records/ranks.md]
//
// Each rank computes the elements of a stretch of tiles and moves the nodes on which they alone act. Nodes
// that features touch are everyone's: each rank gets their forces and moves them in the same way. The views
// of NodeFields hold them, the rank's own nodes and, after fetch(), all.

#include <memory>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "drivers/engine/precise_fields.hpp"

namespace tread {

template <class Real, class U>
class RankFields final : public PreciseFields<Real, U> {
 public:
  RankFields(const Model& model, std::shared_ptr<Ranks> ranks);

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override;
  void fetch() override;
  void changed() override { whole_ = true; }

  /// All ranks compute all elements, so that all fields stay whole until the next step.
  void internal_force() override;
  void internal_force_and_move(const StepLoads& loads) override;
  void advance_lag(double dt) override;
  void list_state(StateList& list) override;

 private:
  using Base = PreciseFields<Real, U>;
  /// The first station of a tile, which another rank's last element reads.
  struct Halo {
    int block = 0;
    std::int64_t slot = 0;  ///< of section node 0
    AlignedVector<U> u;     ///< displacement, by section node and component [m]
    AlignedVector<Real> d;  ///< values that damp, or empty: lag [m] or velocity [m/s]
  };

  void cut(const Mesh& mesh);
  void choose_groups(const Model& model);
  void join_tiles();
  int rank_of(std::size_t tile) const;
  Halo halo_of(int block, int tile);
  Real* damping(int block);
  /// copy(value in a field, value in the halo)
  template <class Copy>
  void for_halo(Halo& halo, const Copy& copy);
  void exchange_halos();
  void share_forces();
  void spoil();

  std::shared_ptr<Ranks> ranks_;
  std::size_t own_ = 0;                                 ///< this rank
  std::vector<TileStretch> stretches_;                  ///< by rank
  std::vector<std::int64_t> first_value_;               ///< by rank, and the end, in vector fields
  std::vector<std::vector<std::int64_t>> first_state_;  ///< by block the same in the state of its law

  std::vector<std::int64_t> groups_;        ///< groups of featured nodes, ascending
  std::vector<std::int64_t> first_group_;   ///< by rank, and the end, in groups_
  std::vector<std::int64_t> first_packed_;  ///< the same in packed_f_
  AlignedVector<Real> packed_f_;            ///< [group][component][lane]

  std::vector<Halo> sent_halos_, received_halos_;
  std::vector<RankMessage> halos_sent_, halos_received_, carries_sent_, carries_received_;
  bool whole_ = true;  ///< the views hold all values of the present, the same on all ranks
};

extern template class RankFields<double, double>;
extern template class RankFields<float, double>;
extern template class RankFields<float, float>;

}  // namespace tread
