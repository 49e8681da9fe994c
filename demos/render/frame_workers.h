#pragma once
// Frames drawn by several processes: this one simulates and sends the bodies' states, each worker has a GL
// context of its own and draws every n-th frame, and what they made comes back in the order of the frames.
// Two contexts in one process wait for each other inside Mesa; two processes do not. Tested in
// tests/demos/render/frame_workers_test.cpp, and through the program in
// tests/demos/program/workers_program_test.cpp.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "demos/frames/manifest.h"
#include "demos/record/recording.h"
#include "demos/system/worker_process.h"

namespace carom::demos {

/// A frame to draw.
struct FrameJob {
  int frame = 0;
  FrameState state;
  double physics_ms = 0.0;                           ///< That it took to get there.
  std::vector<std::vector<BodyState>> moments = {};  ///< While the shutter is open; empty: it closes at once.
};

/// What became of it: its record and, where it has no files, its bytes for the stream.
struct DrawnFrame {
  FrameRecord record;
  std::vector<std::uint8_t> bytes;
};

/// How many workers a run of so many frames gets when nobody says: one for each processor, at most eight; one
/// for a few frames, which would be drawn before a second context is ready.
int usualWorkers(int frames);

class FrameWorkers {
 public:
  using Draw = std::function<DrawnFrame(const FrameJob&)>;
  /// Called in each worker: makes its renderer, says what it is and how it draws.
  using Start = std::function<Draw(renderer::ContextInfo&)>;
  using Collect = std::function<void(DrawnFrame)>;

  /// Forks `count` workers; this process must not have called GL, and has one thread. Throws CannotWrite.
  FrameWorkers(int count, const Start& start);
  /// Ends them; each finishes the frame it is at. No process and no part of a file stays behind.
  ~FrameWorkers();

  int count() const { return static_cast<int>(workers_.size()); }
  /// What the workers' GL is; waits for all of them. Throws as `submit`.
  const renderer::ContextInfo& gl();
  /// The same as far as it is known, without waiting.
  const renderer::ContextInfo& knownGl() const { return gl_; }

  /// Sends a frame; waits and collects while `kAhead` frames a worker are under way. Throws Interrupted, and
  /// ProcessFailure when a worker fails or is killed.
  void submit(const FrameJob& job, const Collect& collect);
  /// Collects all frames under way. Throws as `submit`.
  void finish(const Collect& collect);
  /// Ends the workers and collects those frames that they had begun, as far as they are whole; failures and
  /// interrupts are no news any more. Afterwards `gl` is known if a frame is.
  void giveUp(const Collect& collect);

  static constexpr int kAhead = 2;

 private:
  WorkerProcess& workerOf(int order) { return workers_[static_cast<std::size_t>(order % count())]; }
  Message receive(int order);
  void takeReady(const Message& message);
  void collectNext(const Collect& collect);
  [[noreturn]] void lost(int order);

  std::vector<WorkerProcess> workers_;
  renderer::ContextInfo gl_;
  int ready_ = 0;
  int submitted_ = 0;
  int collected_ = 0;
};

}  // namespace carom::demos
