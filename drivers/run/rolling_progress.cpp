#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "core/parallel/parallel.hpp"
#include "drivers/run/rolling.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

constexpr double kNoticeAfter = 5;  ///< time after which busy cores are noticed [s]

}  // namespace

void Rolling::notice_busy_cores() {
  const double passed = session_->progress.seconds() - started_;
  const bool waits = !followers_.absent() || chosen_device() != nullptr;  // for other ranks, for a device
  if (noticed_busy_cores_ || passed < kNoticeAfter || waits) return;
  const std::string busy = busy_cores_text(cores_.share());
  if (busy.empty()) return;
  noticed_busy_cores_ = true;
  const char* const too_many =
      threads() == 1 ? "" : ", or the scene is too small for so many; fewer threads (-t) may be faster";
  session_->progress.say("[roll] " + busy + too_many);
}

double Rolling::seconds() const {
  return seconds_before_ + session_->progress.seconds() - started_;
}

double Rolling::step_seconds() const {
  return stepping_ / static_cast<double>(simulation_->steps() - started_steps_);
}

double Rolling::seconds_left() const {
  return step_seconds() * static_cast<double>(end_ - simulation_->steps());
}

std::string Rolling::progress_line() const {
  const Sample& sample = simulation_->sample();
  const double end = model_->scene.motion->duration;
  std::string line =
      fmt::format("[roll] t {:.3f}/{:.3f} ms  {:4.1f} %  dt {:.3e} s", 1e3 * simulation_->time(), 1e3 * end,
                  100 * simulation_->time() / end, simulation_->dt());
  if (model_->contact)
    line += fmt::format("  x {:.3f} m  FN {:.2f} kN  FL/FN {:.3f}", sample.wheel_x,
                        1e-3 * sample.vertical_force, sample.traction());
  line += fmt::format("  energy residual {:.2e} J  {:.1f} ns/el  ETA {}", sample.energy.residual,
                      1e9 * step_seconds() / static_cast<double>(model_->elements()),
                      duration_text(seconds_left()));
  return line;
}

std::string Rolling::status() const {
  const Sample& sample = simulation_->sample();
  Json json = session_->status("rolling");
  json["time_s"] = simulation_->time();
  json["duration_s"] = model_->scene.motion->duration;
  json["step"] = simulation_->steps();
  json["steps"] = end_;
  json["dt_s"] = simulation_->dt();
  if (model_->contact) {
    json["wheel_x_m"] = sample.wheel_x;
    json["vertical_force_N"] = sample.vertical_force;
    json["longitudinal_force_N"] = sample.longitudinal_force;
  }
  json["energy_residual_J"] = sample.energy.residual;
  json["rolling_s"] = seconds();
  json["left_s"] = seconds_left();
  json["frames"] = frames_->count();
  json["folder_bytes"] = folder_bytes(session_->folder.path());
  json["checkpoint_time_s"] = written_ ? Json(written_->time) : Json();
  return json_text(json);
}

}  // namespace tread
