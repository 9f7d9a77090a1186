#pragma once
// Fastenings, bed of the sleepers and elastic foot holds as discrete elements between nodes.

#include <cstdint>
#include <vector>

#include "drivers/studies/export/deck_model.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// A spring and a damper side by side.
struct DeckSpring {
  static constexpr int kOwnDirection = -1;  ///< from one end to the other, wherever they move

  int component = 2;     ///< direction: 0 along, 1 across, 2 vertical, or kOwnDirection
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]

  /// Number of its discrete elements.
  int elements() const { return (stiffness > 0) + (damping > 0); }
  /// Mass of each end with which both are stable at this step [s]. [kg]
  double end_mass(double step) const { return step * (1.1 * damping + 0.5 * step * stiffness); }
};

/// Parts and elements of spring-dampers: two nodes each; equal values share a part.
class DiscreteParts {
 public:
  DiscreteParts(DeckModel& deck, KeywordDeck& out) : deck_(&deck), out_(&out) {}

  /// Adds a spring and a damper, as far as they are not zero.
  void add(std::int64_t first, std::int64_t second, const DeckSpring& spring);
  /// Writes orientations, parts and elements, and returns the number of elements.
  std::int64_t write();

 private:
  struct Element {
    std::int64_t part, first, second;
    int component;
  };
  struct Part {
    std::int64_t number;
    double value;  ///< in the deck's units
    bool damper;
  };
  std::int64_t part_of(double value, bool damper);

  DeckModel* deck_;
  KeywordDeck* out_;
  std::vector<Part> parts_;
  std::vector<Element> elements_;
};

/// Adds the model's spring-dampers, and writes the nodes at their ends: on the ground, or tied to the faces
/// of the bodies.
void add_springs(DeckModel& deck, DiscreteParts& parts, KeywordDeck& out);

}  // namespace tread
