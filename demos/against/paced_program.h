#pragma once
// A program that draws a frame when it is asked to (paced_frames.h), as its parent sees it. Each starts with
// its memory laid out anew by chance, so that luck of addresses is noise among rounds and not a difference of
// programs (Curtsinger and Berger, Stabilizer, 2013). Tested through the program in
// tests/demos/program/against_program_test.cpp.

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "demos/motion/frame_cost.h"

namespace carom::demos {

/// Numbers of the processors that this process may run on; none where the system does not tell.
std::vector<int> usableProcessors();

class PacedProgram {
 public:
  /// Starts `words`, all threads of it on that one processor where one is given; says `name` in messages.
  /// Throws CannotWrite where the system allows no more processes.
  PacedProgram(std::vector<std::string> words, std::string name, std::optional<int> processor = {});
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
