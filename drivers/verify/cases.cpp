#include "drivers/verify/cases.hpp"

namespace tread {

const std::vector<VerifyCase>& verify_cases() {
  static const std::vector<VerifyCase> cases = {hertz_sphere_case(),
                                                hertz_ellipse_case(),
                                                surface_depths_case(),
                                                profiles_in_contact_case(),
                                                contact_filter_case(),
                                                cattaneo_mindlin_case(),
                                                carter_case(),
                                                steady_rolling_case(),
                                                transient_rolling_case(),
                                                von_mises_case(),
                                                sliding_case(),
                                                rail_on_fastenings_case(),
                                                rail_waves_case(),
                                                fastening_passing_case(),
                                                wheelset_settling_case(),
                                                wheelset_modes_case(),
                                                wheel_receptance_case(),
                                                ring_modes_case(),
                                                moving_frames_case(),
                                                extremes_step_case(),
                                                extremes_damping_case(),
                                                extremes_elements_case(),
                                                extremes_penalty_case(),
                                                extremes_traction_case(),
                                                extremes_speed_case(),
                                                extremes_corrugation_case(),
                                                extremes_endurance_case()};
  return cases;
}

}  // namespace tread
