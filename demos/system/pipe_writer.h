#pragma once
// Bytes into standard output or another program's input. Never leaves the program deaf: a reader that does
// not read is waited for in short turns, in which an interrupt is heard. Tested in
// tests/demos/system/pipe_writer_test.cpp.

#include <cstdint>
#include <span>
#include <string>

namespace carom::demos {

class PipeWriter {
 public:
  /// `target` names it in messages ("standard output"). The descriptor stays the caller's. From now on a
  /// closed pipe is an error of `write` and no signal.
  PipeWriter(int descriptor, std::string target);

  /// Writes everything. Throws PipeClosed when the reader has gone, CannotWrite for other errors, and
  /// Interrupted when a signal arrives while the reader does not read.
  void write(std::span<const std::uint8_t> bytes);

 private:
  void waitUntilReady() const;

  int descriptor_;
  std::string target_;
};

}  // namespace carom::demos
