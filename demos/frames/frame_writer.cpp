#include "demos/frames/frame_writer.h"

#include "demos/format/progress.h"
#include "demos/system/atomic_file.h"

namespace carom::demos {

namespace {

/// The hash of the pixels.
std::uint64_t writeEncoded(const EncodedFrame& encoded, const std::filesystem::path& path) {
  AtomicFile file(path);
  file.write(encoded.bytes);
  file.commit();
  return encoded.pixel_hash;
}

}  // namespace

std::optional<FrameRecord> writeFrameFile(FrameToWrite frame) {
  FrameEncoder encoder;
  return writeFrameFile(std::move(frame), encoder);
}

std::optional<FrameRecord> writeFrameFile(FrameToWrite frame, FrameEncoder& encoder) {
  const double started_s = steadySeconds();
  for (OutputToWrite& output : frame.outputs) {
    output.record.pixel_hash = writeEncoded(encodedOutput(output.raster, output.text), output.path);
    frame.record.outputs.push_back(output.record);
  }
  frame.record.pixel_hash = writeEncoded(encoder.encode(frame.image, frame.text), frame.path);
  frame.record.timings.encode_ms = 1000.0 * (steadySeconds() - started_s);
  return frame.record;
}

FrameWriter::FrameWriter(Write write) : write_(std::move(write)), thread_([this] { work(); }) {}

FrameWriter::~FrameWriter() {
  end();
}

void FrameWriter::submit(FrameToWrite frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_.push_back(std::move(frame));
  changed_.notify_all();
}

std::vector<FrameRecord> FrameWriter::finish() {
  end();
  if (failure_) std::rethrow_exception(failure_);
  return written_;
}

std::vector<FrameRecord> FrameWriter::written() const {
  const std::lock_guard lock(mutex_);
  return written_;
}

void FrameWriter::end() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !waiting_.empty() || ending_; });
    if (waiting_.empty()) return;
    FrameToWrite frame = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    lock.unlock();
    try {
      std::optional<FrameRecord> record = write_(std::move(frame));
      lock.lock();
      if (record) written_.push_back(std::move(*record));
    } catch (...) {
      lock.lock();
      failure_ = std::current_exception();
      waiting_.clear();
      changed_.notify_all();
      return;
    }
  }
}

}  // namespace carom::demos
