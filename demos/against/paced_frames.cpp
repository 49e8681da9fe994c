#include "demos/against/paced_frames.h"

#include <iostream>
#include <sstream>

#include "demos/content_hash.h"
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
  for (const std::int64_t count : cost.work) line << ' ' << count;
  return line.str();
}

FrameCost readPacedLine(const std::string& line, const std::string& program) {
  std::istringstream in(line);
  FrameCost cost;
  in >> std::hex >> cost.state_hash >> std::dec >> cost.total_ms;
  for (double& phase_ms : cost.phase_ms) in >> phase_ms;
  for (std::int64_t& count : cost.work) in >> count;
  if (!in)
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
