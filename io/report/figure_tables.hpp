#pragma once
// The data that the figures of a report show, as CSV. Headers state units.

#include <string>

#include "io/report/chart.hpp"
#include "io/report/drawing.hpp"
#include "io/report/heatmap.hpp"
#include "io/report/patch_movie.hpp"
#include "io/report/scatter.hpp"

namespace tread {

/// All points of the curves. Successive curves over equal abscissae share the column of these; columns of
/// fewer points end with empty cells. A gap is an empty cell.
std::string curves_csv(const Figure& figure);

/// A row for each cell, dot and point of a line of the map. The column `source` is the label of the dot or of
/// the line, and empty for cells; a line has no values. The last column is 1 for the cells that the outline
/// encloses.
std::string heatmap_csv(const Heatmap& map);

/// A row for each dot.
std::string scatter_csv(const Scatter& scatter);

/// A row for each corner of each polygon that the drawing shows, horizontal and vertical, in metres.
std::string drawings_csv(const Drawings& drawings);

/// A row for each place in contact at each instant. State: 1 sticks, 2 slips.
std::string movie_csv(const PatchMovie& movie);

}  // namespace tread
