#include "drivers/report/provenance.hpp"

#include <fmt/chrono.h>

#include <ctime>

#include "drivers/process/host.hpp"
#include "drivers/process/machine.hpp"

namespace tread {

void state_provenance(Report& report, const std::string& scene, const Provenance& provenance) {
  report.footer = provenance.command;
  const std::string date = fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)));
  const std::string machine = fmt::format("{}, {}, {} cores", host_name(), processor_name(), machine_cores());
  report.chapters.push_back({"Provenance",
                             {Table{"",
                                    {{"Quantity"}, {.title = "Value", .plain = true}},
                                    {{"Program", provenance.program},
                                     {"Command", provenance.command},
                                     {"Scene", scene},
                                     {"Finished", date},
                                     {"Machine", machine}}}}});
}

}  // namespace tread
