#include "drivers/cli/version_command.hpp"

#include <fmt/core.h>

#include <string>
#include <string_view>

#include "drivers/engine/model.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json_writer.hpp"

namespace tread {

namespace {

std::string joined(const std::vector<const char*>& names) {
  std::string text;
  for (const char* name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace

void print_version(bool json) {
  const std::vector<const char*> sets = InternalForce::instruction_sets();
  if (!json) {
    fmt::print("tread {}\ncompiler          {}, {}\ninstruction sets  {}\npackages          {}\n",
               TREAD_VERSION, TREAD_COMPILER, TREAD_BUILD, joined(sets), TREAD_PACKAGES);
    return;
  }
  JsonWriter out;
  out.begin_object()
      .member("version", TREAD_VERSION)
      .member("compiler", TREAD_COMPILER)
      .member("build", TREAD_BUILD);
  out.key("instruction_sets").begin_array();
  for (const char* name : sets) out.value(name);
  out.end_array().key("packages").begin_object();
  std::string_view rest = TREAD_PACKAGES;
  while (!rest.empty()) {
    const std::string_view package = rest.substr(0, rest.find(", "));
    rest.remove_prefix(std::min(rest.size(), package.size() + 2));
    const auto blank = package.find(' ');
    out.member(package.substr(0, blank), package.substr(blank + 1));
  }
  fmt::print("{}", out.end_object().end_object().text());
}

void print_scene_reference(bool json) {
  if (!json) {
    fmt::print("{}", scene_reference());
    return;
  }
  JsonWriter out;
  fmt::print("{}",
             out.begin_object().member("markdown", std::string_view(scene_reference())).end_object().text());
}

}  // namespace tread
