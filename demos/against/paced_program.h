#pragma once
// A program that draws a frame when it is asked to (paced_frames.h), as its parent sees it. It starts with
// its address space laid out the same way every time, so that two equal programs run on equal addresses.

#include <string>
#include <vector>

#include <sys/types.h>

#include "demos/motion/frame_cost.h"

namespace carom::demos {

class PacedProgram {
 public:
  /// Starts `words`; says `name` in messages. Throws CannotWrite where the system allows no more processes.
  PacedProgram(std::vector<std::string> words, std::string name);
  ~PacedProgram();  ///< Ends it.
  PacedProgram(const PacedProgram&) = delete;
  PacedProgram& operator=(const PacedProgram&) = delete;

  /// Waits until it is ready; how many frames it has. Throws InputError where it does not start as a paced
  /// carom does.
  int awaitReady();
  /// Its next frame. Throws InputError, Interrupted.
  FrameCost next();

 private:
  std::string readLine();

  std::string name_;
  pid_t id_ = -1;
  int socket_ = -1;
  std::string arrived_;
};

}  // namespace carom::demos
