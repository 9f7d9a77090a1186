// In place of cuda.cu where tread is built without CUDA.

#include <fmt/core.h>

#include "core/error.hpp"
#include "kernels/device/device.hpp"

namespace tread {

std::vector<int> gpu_numbers() {
  return {};
}

std::vector<std::string> gpus() {
  return {};
}

std::string why_no_gpu() {
  return "this tread is built without CUDA (configure it with -D TREAD_CUDA=ON where there is nvcc)";
}

std::unique_ptr<Device> open_gpu(int number) {
  throw ResourceError(fmt::format("--device gpu:{}: {}; --device cpu runs everywhere", number, why_no_gpu()));
}

}  // namespace tread
