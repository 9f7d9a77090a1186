#include "kernels/device/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"

namespace tread {

namespace {

std::shared_ptr<Device>& chosen() {
  static std::shared_ptr<Device> device;
  return device;
}

/// N of gpu:N, -1 for other names.
int card_of(std::string_view name) {
  constexpr std::string_view kPrefix = "gpu:";
  if (!name.starts_with(kPrefix)) return -1;
  int number = -1;
  const char* const end = name.data() + name.size();
  const auto [stop, failure] = std::from_chars(name.data() + kPrefix.size(), end, number);
  return failure == std::errc() && stop == end ? number : -1;
}

/// A card for this place, where there is one.
int card_at(int place) {
  const std::vector<int> cards = gpu_numbers();
  return cards[index(place) % cards.size()];
}

}  // namespace

std::string missing_device(std::string_view name) {
  const int card = card_of(name);
  if (name.empty() || name == "cpu" || name == "auto" || name == "emulated") return "";
  if (name != "gpu" && card < 0)
    throw InputError(
        fmt::format("--device {}: it is cpu, gpu, gpu:N with the number of a card, auto or emulated", name));
  const std::vector<int> cards = gpu_numbers();
  if (cards.empty()) return fmt::format("--device {}: {}; --device cpu runs everywhere", name, why_no_gpu());
  if (card < 0 || std::find(cards.begin(), cards.end(), card) != cards.end()) return "";
  return fmt::format("--device {}: this tread can use {}", name, fmt::join(gpus(), ", "));
}

void choose_device(std::string_view name, int place) {
  const int card = card_of(name);
  const std::string missing = missing_device(name);
  if (card < 0 && !missing.empty()) throw ResourceError(missing);  // open_gpu() knows why this one is not
  if (name.empty() || name == "cpu" || (name == "auto" && gpu_numbers().empty()))
    choose_device(std::shared_ptr<Device>());
  else if (name == "emulated")
    choose_device(emulated_device());
  else
    choose_device(open_gpu(card >= 0 ? card : card_at(place)));
}

void choose_device(std::shared_ptr<Device> device) {
  chosen() = std::move(device);
}

std::string device_name() {
  return chosen() ? chosen()->name() : "cpu";
}

std::shared_ptr<Device> chosen_device() {
  return chosen();
}

}  // namespace tread
