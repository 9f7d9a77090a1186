#pragma once
// The division of lines into elements: sizes of a section, graded points, layers below a surface.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace tread {

/// Elements too large for a body.
struct MeshSizeError : InputError {
  explicit MeshSizeError(const std::string& text, double size = 0) : InputError(text), fits(size) {}

  double fits;  ///< largest element size that the part takes; 0: not known [m]
};

/// Element sizes of a section with a running surface.
struct SectionSize {
  double surface = 2.2e-3;         ///< contact elements: columns in the running band, top layers' rows [m]
  double coarse = 9e-3;            ///< size of elements away from the contact [m]
  double band_centre = -3e-3;      ///< middle of the running band, coordinate p [m]
  double band_half_width = 20e-3;  ///< [m]
  int fine_layers = 2;             ///< rows of thickness `surface`

  /// Wanted column width at p: `surface` in the running band, growing outside to `largest` [m].
  double column(double p, double largest) const;

  /// Fraction of the fine layers' thickness that the rows at p keep [-]: 1 in the running band, falling to 0
  /// at the ends of the surface, `left` and `right`, over at least 10 mm.
  double layer_weight(double p, double left, double right) const;
};

/// Least ratio of coarse to surface size: several fine edges on a coarse one.
constexpr double kCoarseRatio = 1.6;

/// Throws InputError if a size is not positive, MeshSizeError if the layers do not fit into `depth` [m];
/// `name` is the body; `way_out` follows in the message on the layers.
void check(const SectionSize& size, double depth, const std::string& name, const std::string& way_out = "");

/// Increasing parameters that contain every break and whose spacing follows size(parameter).
std::vector<double> graded(std::span<const double> breaks, const std::function<double(double)>& size);

/// Number of elements of about `size` on `length` [m], at least `least`.
int element_count(double length, double size, int least);

/// Returns count + 1 evenly spaced values from first to last, both exact.
std::vector<double> evenly(double first, double last, int count);

/// Depths below a surface, from 0 to `depth`: fine layers of equal thickness, then rows that grow up to
/// size.coarse.
std::vector<double> layer_depths(const SectionSize& size, double depth);

/// Appends all values but the first, which is the last of `line`.
void append(std::vector<double>& line, std::span<const double> more);

/// Converts depths to fractions of the height above the deepest, from 0 to 1.
std::vector<double> from_below(std::span<const double> depths);

/// Fine interface nodes that nest in coarse ones: fine.size() abscissae close to the wanted `fine`. Every
/// value of `coarse` occurs exactly, and the fine nodes divide each coarse edge evenly. Both lists increase
/// and share their ends. Throws MeshSizeError if there are fewer fine than coarse edges.
std::vector<double> nested(std::span<const double> fine, std::span<const double> coarse,
                           const std::string& name);

}  // namespace tread
