#pragma once
// Sections of the rail: head cap and base, tied along a straight line across the head.

#include "core/geometry/profiles.hpp"
#include "core/mesh/section.hpp"
#include "core/mesh/structured.hpp"

namespace tread {

/// Head cap and base in global (y, z): the crown centre line at y = 0, the crown top at z = 0, the section
/// turned about it by the inclination, head towards -y. Nodes of cap.paths["tie"] lie on the straight edges
/// of base.paths["tie"], and every node of base.paths["tie"] is one of them. Paths run along +y;
/// base.paths["foot"] is the foot's bottom.
struct RailSections {
  Section cap;
  Section base;
};

/// Sections of a rail, turned by `inclination`. size.coarse: elements of the base, 6 ... 10 mm; at least two
/// elements through the web and the foot's edge. Throws InputError for sizes or inclinations that do not fit.
RailSections make_rail_sections(const RailProfile& profile, double inclination, const SectionSize& size);

/// Section of a bar [m]. Its top is a crown of radius `crown_radius` (0: flat) with its highest line at y =
/// 0, z = 0. Path "foot" is its bottom at z = -height.
Section make_box_rail_section(double width, double height, double crown_radius, const SectionSize& size);

}  // namespace tread
