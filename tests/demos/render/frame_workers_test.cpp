#include "demos/render/frame_workers.h"

#include <csignal>

#include <gtest/gtest.h>
#include <unistd.h>

#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

std::vector<BodyState> bodiesOf(int frame) {
  std::vector<BodyState> bodies(3);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double v = frame + 0.125 * static_cast<double>(i);
    bodies[i].X_WB.rotation = Quat(0.5, -0.5, 0.5 * v, 0.25);
    bodies[i].X_WB.position = Vec3(v, 2.0 * v, -v);
    bodies[i].linear_velocity = Vec3(0.1, v, 0.2);
    bodies[i].angular_velocity = Vec3(v, 0.3, 0.4);
    bodies[i].mode = i == 1 ? Mode::kResting : Mode::kFree;
  }
  return bodies;
}

/// What depends on every number of the job.
std::uint64_t digest(const FrameJob& job) {
  double sum = job.frame + 3.0 * job.state.step + 0.5 * job.physics_ms;
  double weight = 1.0;
  for (const BodyState& body : job.state.bodies)
    for (const double c :
         {body.X_WB.rotation.w(), body.X_WB.rotation.x(), body.X_WB.rotation.y(), body.X_WB.rotation.z(),
          body.X_WB.position.x(), body.X_WB.position.y(), body.X_WB.position.z(), body.linear_velocity.x(),
          body.linear_velocity.y(), body.linear_velocity.z(), body.angular_velocity.x(),
          body.angular_velocity.y(), body.angular_velocity.z(), static_cast<double>(body.mode)})
      sum += (weight += 0.75) * c;
  return static_cast<std::uint64_t>(1024.0 * sum) ^ job.state.state_hash;
}

FrameJob jobOf(int frame, const std::vector<BodyState>& bodies) {
  return {frame, {bodies, 10 * frame, 0x123456789abcdef0u + static_cast<unsigned>(frame)}, 0.25 * frame};
}

/// "Draws" the job's digest; the earlier frames of a round take longest.
FrameWorkers::Draw drawDigest(renderer::ContextInfo& gl) {
  gl = {"a renderer", "a version", 4};
  return [](const FrameJob& job) {
    ::usleep(static_cast<useconds_t>(3000 * (3 - job.frame % 3)));
    DrawnFrame drawn;
    drawn.record.frame = job.frame;
    drawn.record.file = std::string("f").append(std::to_string(job.frame));
    drawn.record.pixel_hash = digest(job);
    drawn.record.timings.physics_ms = job.physics_ms;
    drawn.record.outputs = {{"depth", "d", 5}, {"id", "", 6}};
    drawn.bytes.assign(1000, static_cast<std::uint8_t>(job.frame));
    return drawn;
  };
}

TEST(FrameWorkers, FramesComeBackInOrderWithWhatTheirJobsHeldForAnyNumber) {
  for (const int count : {1, 2, 3, 5}) {
    FrameWorkers workers(count, drawDigest);
    std::vector<DrawnFrame> drawn;
    const auto collect = [&](DrawnFrame frame) { drawn.push_back(std::move(frame)); };
    for (int k = 0; k < 20; ++k) workers.submit(jobOf(k, bodiesOf(k)), collect);
    workers.finish(collect);
    EXPECT_EQ(workers.gl().renderer, "a renderer");
    ASSERT_EQ(drawn.size(), 20u);
    for (int k = 0; k < 20; ++k) {
      const DrawnFrame& frame = drawn[static_cast<std::size_t>(k)];
      EXPECT_EQ(frame.record.frame, k);
      EXPECT_EQ(frame.record.file, std::string("f").append(std::to_string(k)));
      const std::vector<BodyState> bodies = bodiesOf(k);
      EXPECT_EQ(frame.record.pixel_hash, digest(jobOf(k, bodies)));
      EXPECT_EQ(frame.record.timings.physics_ms, 0.25 * k);
      ASSERT_EQ(frame.record.outputs.size(), 2u);
      EXPECT_EQ(frame.record.outputs[0].file + frame.record.outputs[1].name, "did");
      EXPECT_EQ(frame.bytes, std::vector<std::uint8_t>(1000, static_cast<std::uint8_t>(k)));
    }
  }
}

/// How a run of `frames` over `start` ends.
Failure failureWith(const FrameWorkers::Start& start, int frames) {
  try {
    FrameWorkers workers(2, start);
    const auto ignore = [](const DrawnFrame&) {};
    for (int k = 0; k < frames; ++k) workers.submit(jobOf(k, bodiesOf(k)), ignore);
    workers.finish(ignore);
  } catch (const ProcessFailure& error) {
    return error.failure;
  }
  return {};
}

TEST(FrameWorkers, AFailureInAWorkerIsTheRunsWithItsCodeAndLine) {
  const auto cannotWrite = [](renderer::ContextInfo&) -> FrameWorkers::Draw {
    return [](const FrameJob& job) -> DrawnFrame {
      if (job.frame == 5) throw CannotWrite("cannot write f5: no space");
      return {};
    };
  };
  const Failure write = failureWith(cannotWrite, 9);
  EXPECT_EQ(write.code, 4);
  EXPECT_EQ(write.line, "cannot write f5: no space");

  const auto noRenderer = [](renderer::ContextInfo&) -> FrameWorkers::Draw {
    throw renderer::NoRenderer("no GL");
  };
  for (const int frames : {1, 20}) {
    const Failure start = failureWith(noRenderer, frames);
    EXPECT_EQ(start.code, 6);
    EXPECT_EQ(start.line, "no GL");
  }
}

TEST(FrameWorkers, AWorkerThatIsKilledEndsTheRunWithItsSignal) {
  const auto killed = [](renderer::ContextInfo&) -> FrameWorkers::Draw {
    return [](const FrameJob& job) -> DrawnFrame {
      if (job.frame == 3) ::raise(SIGKILL);
      return {};
    };
  };
  const Failure failure = failureWith(killed, 12);
  EXPECT_EQ(failure.code, 128 + SIGKILL);
  EXPECT_NE(failure.line.find("killed by signal 9"), std::string::npos) << failure.line;
}

TEST(FrameWorkers, AFewFramesAreNotWorthASecondContext) {
  EXPECT_EQ(usualWorkers(1), 1);
  EXPECT_GE(usualWorkers(1000), 1);
  EXPECT_LE(usualWorkers(1000), 8);
}

}  // namespace
}  // namespace carom::demos
