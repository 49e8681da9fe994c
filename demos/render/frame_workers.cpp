#include "demos/render/frame_workers.h"

#include <algorithm>
#include <string>

#include "demos/format/byte_message.h"
#include "demos/system/exit_code.h"
#include "demos/system/machine_load.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

/// How an answer begins.
enum class Answer : std::uint8_t { kReady, kFrame, kFailure };

void put(MessageWriter& to, const BodyState& body) {
  const Quat& q = body.X_WB.rotation;
  for (const double c : {q.w(), q.x(), q.y(), q.z()}) to.put(c);
  for (const Vec3& v : {body.X_WB.position, body.linear_velocity, body.angular_velocity})
    to.put(v.x()).put(v.y()).put(v.z());
  to.put(body.mode);
}

Vec3 takeVector(MessageReader& from) {
  const double x = from.take<double>(), y = from.take<double>(), z = from.take<double>();
  return {x, y, z};
}

BodyState takeBody(MessageReader& from) {
  BodyState body;
  Quat& q = body.X_WB.rotation;
  for (double* c : {&q.w(), &q.x(), &q.y(), &q.z()}) *c = from.take<double>();
  body.X_WB.position = takeVector(from);
  body.linear_velocity = takeVector(from);
  body.angular_velocity = takeVector(from);
  body.mode = from.take<Mode>();
  return body;
}

MessageWriter jobMessage(const FrameJob& job) {
  MessageWriter message;
  message.put(job.frame).put(job.physics_ms).put(job.state.step).put(job.state.state_hash);
  message.put(job.state.bodies.size());
  for (const BodyState& body : job.state.bodies) put(message, body);
  message.put(job.moments.size());
  for (const std::vector<BodyState>& moment : job.moments)
    for (const BodyState& body : moment) put(message, body);
  return message;
}

/// The job, whose bodies live in `bodies`.
FrameJob takeJob(MessageReader from, std::vector<BodyState>& bodies) {
  FrameJob job;
  job.frame = from.take<int>();
  job.physics_ms = from.take<double>();
  job.state.step = from.take<int>();
  job.state.state_hash = from.take<std::uint64_t>();
  bodies.resize(from.take<std::size_t>());
  for (BodyState& body : bodies) body = takeBody(from);
  job.state.bodies = bodies;
  job.moments.assign(from.take<std::size_t>(), bodies);
  for (std::vector<BodyState>& moment : job.moments)
    for (BodyState& body : moment) body = takeBody(from);
  return job;
}

MessageWriter drawnMessage(const DrawnFrame& drawn) {
  const FrameRecord& r = drawn.record;
  MessageWriter message;
  message.put(Answer::kFrame).put(r.frame).put(r.file).put(r.time_s).put(r.step).put(r.state_hash);
  message.put(r.pixel_hash).put(r.kept);
  message.put(r.timings.physics_ms).put(r.timings.draw_ms).put(r.timings.encode_ms);
  message.put(r.outputs.size());
  for (const OutputRecord& output : r.outputs)
    message.put(output.name).put(output.file).put(output.pixel_hash);
  message.put(std::span<const std::uint8_t>(drawn.bytes));
  return message;
}

DrawnFrame takeDrawn(MessageReader& from) {
  DrawnFrame drawn;
  FrameRecord& r = drawn.record;
  r.frame = from.take<int>();
  r.file = from.takeText();
  r.time_s = from.take<double>();
  r.step = from.take<int>();
  r.state_hash = from.take<std::uint64_t>();
  r.pixel_hash = from.take<std::uint64_t>();
  r.kept = from.take<bool>();
  r.timings.physics_ms = from.take<double>();
  r.timings.draw_ms = from.take<double>();
  r.timings.encode_ms = from.take<double>();
  r.outputs.resize(from.take<std::size_t>());
  for (OutputRecord& output : r.outputs) {
    output.name = from.takeText();
    output.file = from.takeText();
    output.pixel_hash = from.take<std::uint64_t>();
  }
  drawn.bytes = from.takeBytes();
  return drawn;
}

void tellFailure(const ParentLine& parent) {
  const Failure failure = failureOf(std::current_exception());
  MessageWriter message;
  message.put(Answer::kFailure).put(failure.code).put(failure.line).put(failure.is_bug);
  parent.send(message.bytes());
}

void work(const ParentLine& parent, const FrameWorkers::Start& start) {
  try {
    renderer::ContextInfo gl;
    const FrameWorkers::Draw draw = start(gl);
    MessageWriter ready;
    ready.put(Answer::kReady).put(gl.renderer).put(gl.version).put(gl.max_samples);
    ready.put(gl.backend).put(gl.reason);
    if (!parent.send(ready.bytes())) return;
    std::vector<BodyState> bodies;
    while (const std::optional<Message> message = parent.receive())
      if (!parent.send(drawnMessage(draw(takeJob(MessageReader(*message), bodies))).bytes())) return;
  } catch (...) {
    tellFailure(parent);
  }
}

Answer answerOf(MessageReader& from) {
  const auto answer = from.take<Answer>();
  if (answer != Answer::kFailure) return answer;
  Failure failure;
  failure.code = from.take<int>();
  failure.line = from.takeText();
  failure.is_bug = from.take<bool>();
  throw ProcessFailure(failure);
}

}  // namespace

int usualWorkers(int frames) {
  constexpr int kFewFrames = 24, kMost = 8;
  return frames < kFewFrames ? 1 : std::min(processors(), kMost);
}

FrameWorkers::FrameWorkers(int count, const Start& start) {
  workers_.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    workers_.emplace_back([&start](const ParentLine& parent) { work(parent, start); }, workers_);
}

FrameWorkers::~FrameWorkers() {
  for (WorkerProcess& worker : workers_) {
    // One that has no frame yet is at nothing but its start, which nobody waits for.
    if (submitted_ == 0) worker.kill();
    worker.endInput();
  }
}

void FrameWorkers::lost(int order) {
  const WorkerProcess::End end = workerOf(order).end();
  const int code = end.signal != 0 ? static_cast<int>(ExitCode::kSignal) + end.signal : end.code;
  const std::string how = end.signal != 0 ? "was killed by signal " + std::to_string(end.signal)
                                          : "ended with code " + std::to_string(end.code);
  throw ProcessFailure({code == 0 ? static_cast<int>(ExitCode::kCannotWrite) : code,
                        "a worker process that draws frames " + how + "; what has been written is whole",
                        false});
}

Message FrameWorkers::receive(int order) {
  std::optional<Message> message = workerOf(order).receive(WorkerProcess::Interrupts::kHeeding);
  if (!message) lost(order);
  return std::move(*message);
}

void FrameWorkers::takeReady(const Message& message) {
  MessageReader from(message);
  REQUIRE(answerOf(from) == Answer::kReady);
  gl_.renderer = from.takeText();
  gl_.version = from.takeText();
  gl_.max_samples = from.take<int>();
  gl_.backend = from.take<renderer::GlBackend>();
  gl_.reason = from.takeText();
  ++ready_;
}

const renderer::ContextInfo& FrameWorkers::gl() {
  while (ready_ < count()) takeReady(receive(ready_));
  return gl_;
}

void FrameWorkers::collectNext(const Collect& collect) {
  gl();
  const Message message = receive(collected_);
  MessageReader from(message);
  const Answer answer = answerOf(from);
  REQUIRE(answer == Answer::kFrame);
  ++collected_;
  collect(takeDrawn(from));
}

void FrameWorkers::submit(const FrameJob& job, const Collect& collect) {
  while (submitted_ - collected_ >= kAhead * count()) collectNext(collect);
  if (!workerOf(submitted_).send(jobMessage(job).bytes())) {
    finish(collect);
    gl();
    const Message last_words = receive(submitted_);
    MessageReader from(last_words);
    answerOf(from);
    lost(submitted_);
  }
  ++submitted_;
}

void FrameWorkers::finish(const Collect& collect) {
  while (collected_ < submitted_) collectNext(collect);
}

void FrameWorkers::giveUp(const Collect& collect) {
  constexpr auto kIgnoring = WorkerProcess::Interrupts::kIgnoring;
  for (WorkerProcess& worker : workers_) worker.endInput();
  try {
    while (ready_ < std::min(count(), submitted_)) {
      const std::optional<Message> message = workerOf(ready_).receive(kIgnoring);
      if (!message) return;
      takeReady(*message);
    }
    for (; collected_ < submitted_; ++collected_) {
      const std::optional<Message> message = workerOf(collected_).receive(kIgnoring);
      if (!message) continue;
      MessageReader from(*message);
      if (answerOf(from) == Answer::kFrame) collect(takeDrawn(from));
    }
  } catch (const ProcessFailure&) {
    // What ended the run came before it.
  }
  for (WorkerProcess& worker : workers_) worker.end();
}

}  // namespace carom::demos
