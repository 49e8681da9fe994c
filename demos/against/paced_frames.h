#pragma once
// `carom budget --paced`: a replay that draws a frame for each line on standard input and answers with a line
// of its times and work, so that another program can take turns with it (--against). Tested through the
// program in tests/demos/program/against_program_test.cpp.
//   first line    carom-paced 1 FRAMES
//   each answer   state hash, frame time, phases' times (ms), with spaces between; work as "queries=12,..."

#include <string>

#include "demos/budget/budget_run.h"

namespace carom::demos {

/// Answers until there are no more frames or no more lines.
void servePacedFrames(const ReplayPlan& plan, renderer::FrameRenderer& pictures);

/// The first line.
std::string pacedGreeting(int frames);
std::string pacedLine(const FrameCost& cost);
/// A kind of work that the line does not name, as that of an older program, is kNotCounted. Throws
/// InputError, naming `program`, where it is no such line.
FrameCost readPacedLine(const std::string& line, const std::string& program);

}  // namespace carom::demos
