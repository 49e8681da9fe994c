#include "demos/frame_writer.h"

#include "demos/atomic_file.h"
#include "demos/content_hash.h"
#include "demos/progress.h"

namespace carom::demos {
namespace {

FrameRecord writeFrame(FrameToWrite frame) {
  const double started_s = steadySeconds();
  frame.record.pixel_hash = ContentHash().add(frame.image.rgb.data(), frame.image.rgb.size()).value();
  AtomicFile file(frame.path);
  file.write(renderer::encodePng(frame.image, frame.text));
  file.commit();
  frame.record.timings.encode_ms = 1000.0 * (steadySeconds() - started_s);
  return frame.record;
}

}  // namespace

FrameWriter::FrameWriter() : thread_([this] { work(); }) {}

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
      FrameRecord record = writeFrame(std::move(frame));
      lock.lock();
      written_.push_back(std::move(record));
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
