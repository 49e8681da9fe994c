#include "demos/against/paced_frames.h"

#include <cstdlib>
#include <iostream>
#include <sstream>

#include "demos/format/content_hash.h"
#include "engine/foundation/contract.h"

namespace carom::demos {

std::string pacedGreeting(int frames) {
  return "carom-paced 1 " + std::to_string(frames);
}

std::string pacedLine(const FrameCost& cost) {
  std::ostringstream line;
  line.precision(9);
  line << hexText(cost.state_hash) << ' ' << cost.total_ms;
  for (const double phase_ms : cost.phase_ms) line << ' ' << phase_ms;
  for (std::size_t w = 0; w < kWorkKinds; ++w)
    line << (w == 0 ? ' ' : ',') << kWork[w].name << '=' << cost.work[w];
  return line.str();
}

FrameCost readPacedLine(const std::string& line, const std::string& program) {
  std::istringstream in(line);
  FrameCost cost;
  in >> std::hex >> cost.state_hash >> std::dec >> cost.total_ms;
  for (double& phase_ms : cost.phase_ms) in >> phase_ms;
  cost.work.fill(kNotCounted);
  for (std::string kind; std::getline(in >> std::ws, kind, ',');) {
    const std::size_t equals = kind.find('=');
    const std::string name = kind.substr(0, equals);
    for (std::size_t w = 0; w < kWorkKinds && equals != std::string::npos; ++w)
      if (name == kWork[w].name) cost.work[w] = std::atoll(kind.c_str() + equals + 1);
  }
  if (cost.work[0] == kNotCounted)
    throw InputError("--against: " + program + " answers \"" + line +
                     "\"; accepted: a carom that knows --paced");
  return cost;
}

void servePacedFrames(const ReplayPlan& plan, renderer::FrameRenderer& pictures) {
  FrameLoop loop(plan, pictures);
  std::cout << pacedGreeting(plan.frames) << std::endl;
  std::string line;
  for (int frame = 0; frame < plan.frames && std::getline(std::cin, line); ++frame)
    std::cout << pacedLine(loop.next()) << std::endl;
}

}  // namespace carom::demos
