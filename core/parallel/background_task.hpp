#pragma once
// One piece of work beside the calling thread.

#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace tread {

class BackgroundTask {
 public:
  BackgroundTask() = default;
  ~BackgroundTask() {
    if (thread_.joinable()) thread_.join();
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Waits for the task under way, then begins `work`. Throws the error of the finished task.
  void start(std::function<void()> work) {
    wait();
    done_ = false;
    thread_ = std::thread([this, work = std::move(work)] {
      try {
        work();
      } catch (...) {
        error_ = std::current_exception();
      }
      done_ = true;
    });
  }

  bool running() const { return !done_; }

  /// Waits until the task is done. Throws its error, once.
  void wait() {
    if (thread_.joinable()) thread_.join();
    if (const std::exception_ptr error = std::exchange(error_, nullptr)) std::rethrow_exception(error);
  }

 private:
  std::thread thread_;
  std::atomic<bool> done_ = true;
  std::exception_ptr error_;
};

}  // namespace tread
