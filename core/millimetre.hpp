#pragma once
// The unit in which profiles, sections and their files are stated.

namespace tread {

inline constexpr double mm = 1e-3;  ///< [m]

}  // namespace tread
