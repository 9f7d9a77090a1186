#include "drivers/engine/fields/node_fields.hpp"

namespace tread {

ValueBytes value_bytes(const Scene& scene) {
  const auto bytes = [](bool single) { return static_cast<int>(single ? sizeof(float) : sizeof(double)); };
  return {bytes(scene.precision == "single"), bytes(scene.precision != "double")};
}

}  // namespace tread
