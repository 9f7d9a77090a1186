#pragma once
// A device: memory of its own, and kernels that teams of threads run over it. One is a GPU, another the
// processor itself, which emulates teams and threads. [docs/records/device.md]

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernels/contact/friction/friction_law.hpp"
#include "kernels/device/contact_layout.hpp"
#include "kernels/device/field_kernels.hpp"
#include "kernels/device/section_cut.hpp"

namespace tread {

/// Copies and launches since a device was opened.
struct DeviceTraffic {
  std::int64_t to_device = 0;    ///< copied [B]
  std::int64_t from_device = 0;  ///< copied [B]
  std::int64_t launches = 0;     ///< of kernels
};

/// Queues of a device. Kernels and copies of one queue run in their order, those of several at once.
inline constexpr int kMainQueue = 0;
inline constexpr int kSearchQueue = 1;  ///< of the contact's search
inline constexpr int kCopyQueue = 2;    ///< of copies to the host
inline constexpr int kPatchQueue = 3;   ///< of the contact's tractions
inline constexpr int kRecordQueue = 4;  ///< of their outcome
inline constexpr int kNearQueue = 5;    ///< this one and the next: of marches about the patch
inline constexpr int kHostQueue = 7;    ///< this one and the next three: of other marches that await the host
inline constexpr int kFanQueue = 11;    ///< this one and all after it: of the rest
inline constexpr int kQueues = 17;

class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  /// "emulated", or the card's name.
  virtual std::string name() const = 0;
  virtual MarchCut cut() const { return {}; }
  /// Memory that the threads of a march's team can share [B]: smaller parts need less. [BlockMarch]
  virtual std::size_t team_bytes() const { return std::numeric_limits<std::size_t>::max(); }
  /// Memory that is left for allocate() [B].
  virtual std::int64_t free_bytes() const { return std::numeric_limits<std::int64_t>::max(); }
  /// True where the host's copies of what moves on the device are filled with NaN, so that whoever reads them
  /// is found out. For tests.
  virtual bool spoils_copies() const { return false; }

  /// Zeros. ResourceError where there is no room.
  virtual void* allocate(std::size_t bytes) = 0;
  virtual void release(void* memory) = 0;
  /// Keeps whole pages of the host in place until they are unlocked, so that copies pass through no other
  /// memory. Nothing where the host may not.
  virtual void lock(void* /*pages*/, std::size_t /*bytes*/) {}
  virtual void unlock(void* /*pages*/) {}
  /// Copies end before these return. ResourceError where the device is lost.
  void upload(void* to, const void* from, std::size_t bytes) {
    start_upload(to, from, bytes);
    finish(used_);
  }
  void download(void* to, const void* from, std::size_t bytes) {
    start_download(to, from, bytes);
    finish(used_);
  }
  /// Copies take their turn in the queue: the host leaves its values alone until they have ended.
  void start_upload(void* to, const void* from, std::size_t bytes) {
    traffic_.to_device += static_cast<std::int64_t>(bytes);
    copy_to(to, from, bytes);
  }
  void start_download(void* to, const void* from, std::size_t bytes) {
    traffic_.from_device += static_cast<std::int64_t>(bytes);
    copy_from(to, from, bytes);
  }
  const DeviceTraffic& traffic() const { return traffic_; }

  /// Kernels and copies go to this queue from now on; at first to the main one.
  void use(int queue) { used_ = queue; }
  /// Lets what follows in the queue in use begin after all that `queue` holds by now.
  void after(int queue) {
    if (queue != used_) let_wait(used_, queue);
  }
  /// Ends when all has ended that the queue holds.
  virtual void finish(int queue) = 0;

  /// Kernels over fields of these precisions.
  template <class Real, class U>
  FieldKernels<Real, U>& kernels() {
    return kernels_of(Precision<Real, U>{});
  }

  /// Finds the candidates of a step. [SearchPoints]
  virtual void search(const ContactTask& task) = 0;
  /// Makes the patch of them. [PatchFinder]
  virtual void find_patch(const ContactTask& task) = 0;
  /// Solves its tractions; `state`: of the law, by integration point. The law's arrays lie on the device.
  /// [PatchSolution]
  virtual void resolve(const ContactTask& task, const FrictionLaw& law, void* state) = 0;
  /// Adds its outcome to the record, and sums it up. [RecordPatch]
  virtual void record(const ContactTask& task) = 0;
  /// Copies its points to task.point.
  virtual void gather(const ContactTask& task, int points) = 0;

  /// Ends when all kernels have ended.
  virtual void wait() = 0;
  /// The same where a failure has been reported, or is no matter any more.
  void let_end() noexcept {
    try {
      wait();
    } catch (const std::exception&) {
    }
  }
  /// a = b + 3 c of n values: the bandwidth of the device's memory. [STREAM]
  virtual void triad(std::int64_t n, double* a, const double* b, const double* c) = 0;

 protected:
  template <class Real, class U>
  struct Precision {};

  virtual void copy_to(void* to, const void* from, std::size_t bytes) = 0;
  virtual void copy_from(void* to, const void* from, std::size_t bytes) = 0;
  virtual FieldKernels<double, double>& kernels_of(Precision<double, double> of) = 0;
  virtual FieldKernels<float, double>& kernels_of(Precision<float, double> of) = 0;
  virtual FieldKernels<float, float>& kernels_of(Precision<float, float> of) = 0;
  virtual void let_wait(int waiting, int queue) = 0;
  void count_launch() { ++traffic_.launches; }
  int used() const { return used_; }

 private:
  DeviceTraffic traffic_;
  int used_ = kMainQueue;
};

/// Sends kernels and copies to another queue while it lives. They begin after what the main one holds.
class Beside {
 public:
  Beside(Device& device, int queue) : device_(&device) {
    device.use(queue);
    device.after(kMainQueue);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  ~Beside() { device_->use(kMainQueue); }

 private:
  Device* device_;
};

/// An array on a device.
template <class T>
class DeviceArray {
 public:
  DeviceArray() = default;
  DeviceArray(Device& device, std::size_t size) : device_(&device), size_(size) {
    if (size > 0) data_ = static_cast<T*>(device.allocate(size * sizeof(T)));
  }
  DeviceArray(Device& device, std::span<const T> values) : DeviceArray(device, values.size()) {
    upload(values.data());
  }
  DeviceArray(DeviceArray&& other) noexcept { swap(other); }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~DeviceArray() {
    if (data_ != nullptr) device_->release(data_);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  /// From and to arrays of as many values.
  void upload(const T* from) { upload(from, size_); }
  void download(T* to) const { download(to, size_); }
  /// The first `count` values.
  void upload(const T* from, std::size_t count) {
    if (count > 0) device_->upload(data_, from, count * sizeof(T));
  }
  void download(T* to, std::size_t count) const {
    if (count > 0) device_->download(to, data_, count * sizeof(T));
  }
  void swap(DeviceArray& other) {
    std::swap(device_, other.device_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

 private:
  Device* device_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Emulation of a device by the processor's threads.
struct Emulation {
  MarchCut cut = {};
  /// Seed of the order of teams and of their threads; 0: ascending. With another all queues are late, but
  /// with an even one marches begin at once, before the tractions beside them.
  std::uint64_t order = 0;
  bool spoils_copies = false;      ///< Device::spoils_copies
  int teams = 4;                   ///< of a patch, kMostTeams at most
  std::size_t shared = 200 << 10;  ///< memory of each of them, a multiple of 64 [B]
  std::size_t team_bytes = std::numeric_limits<std::size_t>::max();    ///< Device::team_bytes
  std::int64_t free_bytes = std::numeric_limits<std::int64_t>::max();  ///< Device::free_bytes at first
  std::int64_t copies = std::numeric_limits<std::int64_t>::max();      ///< after which the device is lost
};
std::unique_ptr<Device> emulated_device(const Emulation& emulation = {});

/// Numbers that CUDA gives the cards that this program has code for, ascending; empty where it is built
/// without, or the machine has none.
std::vector<int> gpu_numbers();
/// These cards as `--device` calls them, with their names, such as "gpu:1 NVIDIA H200".
std::vector<std::string> gpus();
/// Why gpus() is empty.
std::string why_no_gpu();
/// ResourceError where there is no card of this number, or the program has no code for it.
std::unique_ptr<Device> open_gpu(int number);

/// Sentence on a card that this machine lacks for a device of this name; "" where it has one, or none is
/// needed. InputError for a name that is no device.
std::string missing_device(std::string_view name);

/// Chooses the device of the steps to come: cpu or no name (none), gpu, gpu:N, emulated, or auto (a card
/// where there is one). InputError for another name, ResourceError where the device is not there. `place`:
/// number of this process among those that share the machine's cards; gpu and auto give each the next one.
void choose_device(std::string_view name, int place = 0);
/// Chooses one that a test makes; null: none.
void choose_device(std::shared_ptr<Device> device);
/// "cpu", or the name of the chosen device.
std::string device_name();
/// Null: the processor takes the steps, without a device.
std::shared_ptr<Device> chosen_device();

}  // namespace tread
