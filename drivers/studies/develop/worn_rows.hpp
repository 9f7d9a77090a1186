#pragma once
// Work and wear of the rows of nodes across the rail. [theory.md, eqs. (W2) and (W6)]

#include <cstddef>
#include <vector>

#include "drivers/studies/develop/wear.hpp"

namespace tread {

/// Frictional work along a row of nodes.
struct WorkRow {
  double y = 0;              ///< [m]
  double width = 0;          ///< width of the rail that the row stands for [m]
  double share = 0;          ///< share in the work of the stretch, q_r [-]
  std::vector<double> work;  ///< work at the stations [J/m2]
};

/// Frictional work of a passage over the running surface.
struct SurfaceWork {
  PassageWork mean;           ///< averaged across the rail by the shares
  std::vector<WorkRow> rows;  ///< by rising y; empty where they are not kept

  /// Sets the shares and the average from the rows' work at the stations of `mean`.
  void average();
  /// Sets the average from the rows' work and shares.
  void weigh();
  /// Work of a row at the stations.
  PassageWork along(std::size_t row) const;
};

/// Depths by row at the places of a profile, positive downwards.
struct WornRows {
  std::vector<double> y;                   ///< [m]
  std::vector<double> share;               ///< weight of each row in the mean profile [-]
  std::vector<std::vector<double>> depth;  ///< [row][place] [m]

  /// Adds `factor` times the values [row][place].
  void add(double factor, const std::vector<std::vector<double>>& values);
  /// Mean of the rows by their shares, at the places of `profile`.
  WornProfile mean(WornProfile profile) const;
};

/// Difference of the largest and the smallest value of all rows.
double range_of_rows(const std::vector<std::vector<double>>& rows);

/// The work without differences across the rail within `reach` [m], averaged by its shares. [theory.md, eq.
/// (W6)]
SurfaceWork smoothed_across(SurfaceWork work, double reach);

/// Work by row beyond `smooth`, averaged by the shares of `smooth`. Throws InputError if the passages are of
/// different meshes.
SurfaceWork work_beyond(SurfaceWork work, const SurfaceWork& smooth);

/// Uneven part of each row's work at the places of `profile`, as uneven_work(): [row][place] [J/m2].
std::vector<std::vector<double>> uneven_rows(const SurfaceWork& work, const WornProfile& profile,
                                             const WearBand& band);

}  // namespace tread
