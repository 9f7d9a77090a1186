#include "io/deck/radioss_file.hpp"

#include <fmt/format.h>

namespace tread {

std::string radioss_run(const RadiossRun& run) {
  std::string text =
      fmt::format("/RUN/{}/1/\n{:.12g}\n/TFILE/4\n{:.12g}\n", run.name, run.end, run.histories);
  if (run.frames > 0)
    text += fmt::format("/ANIM/DT\n0 {:.12g}\n/ANIM/VECT/DISP\n/ANIM/VECT/VEL\n", run.frames);
  // The step of the nodes; no mass is scaled, as no step is so short.
  text += fmt::format("/DT/NODA/CST/0\n{:.12g} {:.6g}\n", run.factor, 1e-6 * run.step);
  text += fmt::format("/DTIX\n{0:.12g} {0:.12g}\n/PARITH/OFF\n/TH/TITLE\n", run.step);
  return text;
}

void RadiossFile::begin(std::string_view name, std::string_view deck) {
  constexpr int kFormat = 2026;  // of the cards
  sink_("#RADIOSS STARTER\n/BEGIN\n");
  sink_(fmt::format("{}\n{:>10}{:>10}\n", name, kFormat, 0));
  // Units of the file and of the computation.
  for (int i = 0; i < 2; ++i) sink_(fmt::format("{:>20}{:>20}{:>20}\n", "kg", "mm", "ms"));
  sink_(fmt::format("/INCLUDE_LS-DYNA/\n{}\n", deck));
}

void RadiossFile::tie(const RadiossTie& tie) {
  constexpr int kNoMass = 5, kNearest = 2;
  sink_(fmt::format("/INTER/TYPE2/{}\n{}\n", ++next_, tie.title));
  sink_("# grnd_IDs surf_IDm Ignore Spotflag Level Isearch Idel2 surf_IDs dsearch\n");
  sink_(fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>20.12g}\n", tie.nodes, tie.faces, 2,
                    kNoMass, 0, kNearest, 1, 0, tie.reach));
}

void RadiossFile::contact(const RadiossContact& contact) {
  constexpr int kOverlapPushes = -1;   // Inacti
  constexpr double kPressedIn = 1e-6;  // Tpressfit: the overlap pushes in full from there on [ms]
  constexpr int kByMeanStiffness = 2;  // Istf
  constexpr int kGapByNode = 2;        // Igap: none on solids
  constexpr int kStiffness = 4;        // Stfac; 10 made nodes chatter
  constexpr double kDamping = 0.05;    // VISs
  const int law = contact.more_friction > 0 ? 2 : 0;  // Ifric: C5 exp(C6 v) beyond Fric
  sink_(fmt::format("/INTER/TYPE25/{}\n{}\n", ++next_, contact.title));
  sink_("# surf_ID1 surf_ID2 Istf Ithe Igap Irem_i2 Idel Iedge IPSTIF\n");
  sink_(fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>20}{:>10}{:>10}\n", contact.secondary,
                    contact.primary, kByMeanStiffness, 0, kGapByNode, 0, 1, 0, 0));
  sink_("# grnd_IDs Gap_scale %mesh_size Gap_max_s Gap_max_m\n");
  sink_(fmt::format("{:>10}{:>30}{:>20}{:>20}{:>20}\n", 0, 1, 0, 0, 0));
  sink_("# Stmin Stmax Igap0 Ishape Edge_angle STFAC_MDT\n");
  sink_(fmt::format("{:>20}{:>20}{:>10}{:>10}{:>20}{:>20}\n", 0, 0, 0, 0, 0, 0));
  sink_("# Stfac Fric Tpressfit Tstart Tstop\n");
  sink_(fmt::format("{:>20}{:>20.12g}{:>20}{:>20}{:>20}\n", kStiffness, contact.friction, kPressedIn, 0, 0));
  sink_("# IBC IVIS2 Inacti VISs Ithick Pmax\n");
  sink_(fmt::format("{:>10}{:>20}{:>10}{:>20}{:>10}{:>30}\n", "000", 0, kOverlapPushes, kDamping, 0, 0));
  sink_("# Ifric Ifiltr Xfreq sens_ID fric_ID\n");
  sink_(fmt::format("{:>10}{:>10}{:>20}{:>20}{:>40}\n", law, 0, 0, 0, 0));
  if (law > 0) {
    sink_("# C1 C2 C3 C4 C5\n");
    sink_(fmt::format("{:>20}{:>20}{:>20}{:>20}{:>20.12g}\n", 0, 0, 0, 0, contact.more_friction));
    sink_("# C6\n");
    sink_(fmt::format("{:>20.12g}\n", -contact.decay));
  }
  const std::int64_t watched = next_;
  sink_(fmt::format("/TH/INTER/{}\nforces of {}\n{:<10}\n{:>10}\n", ++next_, contact.title, "DEF", watched));
}

void RadiossFile::reference(const RadiossReference& reference) {
  sink_(fmt::format("/XREF/{}\nfree of stress\n#    Nitrs\n{:>10}\n", reference.part, 1));
  sink_("# node_ID X Y Z\n");
  for (const auto& [node, at] : reference.nodes)
    sink_(fmt::format("{:>10}{:>20.14g}{:>20.14g}{:>20.14g}\n", node, at.x, at.y, at.z));
}

void RadiossFile::velocities(std::span<const std::pair<std::int64_t, Vec3>> nodes) {
  sink_(fmt::format("/INIVEL/NODE/{}\nvelocities at t = 0\n", ++next_));
  sink_("# node_ID skew_ID Vxt Vyt Vzt\n");
  for (const auto& [node, v] : nodes)
    sink_(fmt::format("{:>10}{:>10}{:>20.12g}{:>20.12g}{:>20.12g}\n{:>40}{:>20}{:>20}\n", node, 0, v.x, v.y,
                      v.z, 0, 0, 0));
}

void RadiossFile::end() {
  sink_("/END\n");
}

}  // namespace tread
