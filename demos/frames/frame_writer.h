#pragma once
// Encodes frames and writes their files in a thread of its own, so that the next frame is simulated and drawn
// meanwhile. Frames are written in the order they are handed in. Tested in
// tests/demos/frames/frame_writer_test.cpp.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "demos/frames/frame_identity.h"
#include "demos/frames/manifest.h"
#include "renderer/image/image.h"
#include "renderer/image/png.h"

namespace carom::demos {

/// Another output of a frame, with a file of its own.
struct OutputToWrite {
  renderer::Raster raster;
  std::filesystem::path path;
  renderer::PngText text;
  OutputRecord record;
};

struct FrameToWrite {
  renderer::Image image;
  std::filesystem::path path;
  FrameRecord record;
  renderer::PngText text;
  std::vector<OutputToWrite> outputs;
};

/// Writes the files of the frame's outputs and then its own; its record, completed. Throws CannotWrite.
std::optional<FrameRecord> writeFrameFile(FrameToWrite frame, FrameEncoder& encoder);
std::optional<FrameRecord> writeFrameFile(FrameToWrite frame);

class FrameWriter {
 public:
  /// What is done with a frame in the thread; a record it returns is kept for `finish`.
  using Write = std::function<std::optional<FrameRecord>(FrameToWrite)>;
  explicit FrameWriter(Write write = [](FrameToWrite frame) { return writeFrameFile(std::move(frame)); });
  /// Writes what was handed in, then ends; use `finish` to learn of failures.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Waits while `kMostWaiting` frames are queued. Throws what writing an earlier frame threw.
  void submit(FrameToWrite frame);
  /// Waits for all frames. Throws what writing one threw; else the records, completed, of all that were
  /// written.
  std::vector<FrameRecord> finish();
  /// The records of the frames written so far.
  std::vector<FrameRecord> written() const;

  static constexpr std::size_t kMostWaiting = 2;

 private:
  void work();
  void end();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FrameToWrite> waiting_;
  std::vector<FrameRecord> written_;
  std::exception_ptr failure_;
  bool ending_ = false;
  Write write_;
  std::thread thread_;  // last: it starts once everything above exists
};

}  // namespace carom::demos
