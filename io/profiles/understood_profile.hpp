#pragma once
// A profile's points brought into the program's axes, cleaned and smoothed.

#include <cstddef>
#include <string>
#include <vector>

#include "io/profiles/profile_points.hpp"

namespace tread {

/// Points below which a shape tells no axes, and gives radii only roughly.
inline constexpr std::size_t kFewestProfilePoints = 10;

/// Statements of the user beside the file.
struct ProfileWish {
  bool wheel = false;
  bool mirrored = false;  ///< a rail's y counts to the gauge side
  double shift = 0;       ///< added to y [m]
  double smoothing = 0;   ///< largest deviation; 0: none [m]
};

/// Points by growing y, to the field side; z upwards (rail) or towards the flange tip (wheel).
struct UnderstoodProfile {
  std::vector<double> y, z;       ///< [m]
  std::vector<double> raw_z;      ///< z before smoothing, at raw_y [m]
  std::vector<double> raw_y;      ///< [m]
  std::vector<double> deviation;  ///< distance of each point from its place before smoothing [m]
  std::string format, units, side;
  std::vector<std::string> notes;
  bool reversed = false;  ///< the file's y falls
  bool mirrored = false;  ///< y has changed its sign
  bool z_turned = false;  ///< z has changed its sign
  double from_back = 0;   ///< subtracted from y that counts from the flange's back [m]
  int points = 0;         ///< rows of the file
  int duplicates = 0;     ///< points on the one before
  int spikes = 0;         ///< single points off the line of their neighbours
  int folded = 0;         ///< points under the outline, where y folds back
  int cut = 0;            ///< points beyond the surface: sides, flange's back, chamfer

  double largest_deviation() const;
};

/// Finds order, side, sign of z and origin from the shape, removes what is no surface and smooths the rest.
/// Throws InputError for points that are no wheel or rail.
UnderstoodProfile understand(FilePoints points, const ProfileWish& wish);

/// Throws InputError, which names the points as `points` and asks `doubt`, unless y [m] is as wide as a
/// profile.
void require_width(const std::vector<double>& y, bool wheel, const std::string& points,
                   const std::string& doubt);

/// Throws InputError where a wheel's y [m], with `shift` [m] added already, counts from the flange's back.
void require_circle(const std::vector<double>& y, double shift);

/// Shifts and smooths a profile whose axes are known. Throws InputError.
void finish(UnderstoodProfile& profile, const ProfileWish& wish);

/// "MiniProf, mm, 646 points; 70 mm subtracted from y": format and changes.
std::string reading_of(const UnderstoodProfile& profile);

}  // namespace tread
