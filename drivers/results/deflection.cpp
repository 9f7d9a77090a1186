#include "drivers/results/deflection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/math/interpolation.hpp"
#include "io/files/output_file.hpp"
#include "io/report/markup.hpp"

namespace tread {

namespace {

constexpr int kPlaces = 200;    ///< places on either side of the wheel
constexpr double kReach = 0.5;  ///< [m]
constexpr double kNear = 0.1;   ///< distance within which asymmetry is judged [m]

/// Value on the rail at x; beyond the rail, the value at its end.
double on_rail(const RailLine& line, const std::vector<double>& values, double x) {
  return value_at(line.x(), values, std::clamp(x, line.x().front(), line.x().back()));
}

std::string described(const char* name, const std::vector<double>& displacement) {
  return fmt::format("{}: lowest {} mm, asymmetry within 0.1 m {}.", name,
                     readable(1e3 * *std::min_element(displacement.begin(), displacement.end())),
                     readable(Deflection::asymmetry(displacement), 2));
}

Series series(std::string label, const Deflection& d, const std::vector<double>& displacement,
              Stroke stroke) {
  Series curve{std::move(label), d.x, displacement, stroke};
  for (double& value : curve.y) value *= 1e3;
  return curve;
}

}  // namespace

double Deflection::asymmetry(const std::vector<double>& displacement) {
  double odd = 0;
  double even = 0;
  const auto near = static_cast<std::size_t>(std::lround(kPlaces * kNear / kReach));
  const double far = 0.5 * (displacement[kPlaces - near] + displacement[kPlaces + near]);
  for (std::size_t i = 1; i <= near; ++i) {
    const double ahead = displacement[kPlaces + i];
    const double behind = displacement[kPlaces - i];
    odd += 0.25 * (ahead - behind) * (ahead - behind);
    const double mean = 0.5 * (ahead + behind) - far;
    even += mean * mean;
  }
  return even > 0 ? std::sqrt(odd / even) : 0;
}

Deflection deflection(const RailLine& line, double static_x) {
  Deflection d;
  d.static_x = static_x;
  d.wheel_x = line.wheel_x();
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    d.x.push_back(kReach * i / kPlaces);
    d.at_rest.push_back(on_rail(line, line.at_rest(), d.static_x + d.x.back()));
    d.rolling.push_back(on_rail(line, line.rolling(), d.wheel_x + d.x.back()));
  }
  return d;
}

void write_deflection(const std::filesystem::path& path, const Deflection& d) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "x_from_wheel [m],static [m],rolling [m]\n");
  for (std::size_t i = 0; i < d.x.size(); ++i)
    fmt::format_to(out, "{:.6g},{:.9g},{:.9g}\n", d.x[i], d.at_rest[i], d.rolling[i]);
  write_text_file(path, {text.data(), text.size()});
}

Figure deflection_figure(const Deflection& d) {
  Figure figure;
  figure.name = "deflection";
  figure.title = "Vertical displacement of the rail's running surface";
  figure.x_label = "From the wheel, ahead positive [m]";
  figure.panels.push_back(
      {"Upwards [mm]",
       {series(fmt::format("static, wheel at x = {:g}", d.static_x), d, d.at_rest, Stroke::dashed),
        series(fmt::format("rolling, wheel at x = {} m", readable(d.wheel_x)), d, d.rolling, Stroke::solid)},
       {},
       220,
       std::nullopt});
  figure.caption =
      described("Static", d.at_rest) + " " + described("Rolling", d.rolling) +
      " Asymmetry: root mean square of the part that is odd about the wheel over that of the even "
      "part, from its value at 0.1 m.";
  return figure;
}

}  // namespace tread
