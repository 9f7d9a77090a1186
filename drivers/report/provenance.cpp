#include "drivers/report/provenance.hpp"

#include <fmt/chrono.h>

#include <ctime>

#include "drivers/process/host.hpp"
#include "drivers/process/machine.hpp"

namespace tread {

Chapter provenance_chapter(const ResolvedScene& resolved, const Provenance& provenance) {
  const std::string date = fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)));
  const std::string machine = fmt::format("{}, {}, {} cores", host_name(), processor_name(), machine_cores());
  return {"Provenance",
          {Table{"",
                 {{"Quantity"}, {"Value"}},
                 {{"Program", provenance.program},
                  {"Command", provenance.command},
                  {"Scene", resolved.name},
                  {"Finished", date},
                  {"Machine", machine}}}}};
}

}  // namespace tread
