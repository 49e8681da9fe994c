// Poses, velocities and modes come back within the bounds that page_motion.h states: 1e-4 of the smallest
// moving body's radius, 6.2e-5 rad.
#include "demos/page/page_motion.h"

#include <gtest/gtest.h>

#include "demos/language/scene_choice.h"
#include "demos/motion/frame_source.h"
#include "tests/demos/support/whole_reader.h"

namespace carom::demos {
namespace {

constexpr int kFrames = 40;

SceneChoice choiceOf(const std::string& name) {
  SceneChoice choice;
  choice.scene = name;
  return choice;
}

struct Simulated {
  explicit Simulated(const std::string& name)
      : scene(chosenScene(choiceOf(name))),
        made(makeSceneWorld(scene, std::nullopt)),
        clock({30.0, scene.rate_hz}) {
    RunFacts facts;
    FrameSource source(made, clock, facts);
    for (int frame = 0; frame < kFrames; ++frame) {
      const FrameState state = source.at(frame);
      frames.emplace_back(state.bodies.begin(), state.bodies.end());
    }
  }
  Scene scene;
  SceneWorld made;
  FrameClock clock;
  std::vector<std::vector<BodyState>> frames;
};

Eigen::Vector4d numbersOf(const Quat& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

struct ReadTrack {
  bool moves = false;
  std::vector<std::vector<std::int64_t>> columns;
  double number(std::size_t column, std::size_t frame, double quantum) const {
    return quantum * static_cast<double>(columns[column][moves ? frame : 0]);
  }
  Vec3 vector(std::size_t column, std::size_t frame, double quantum) const {
    return {number(column, frame, quantum), number(column + 1, frame, quantum),
            number(column + 2, frame, quantum)};
  }
};

ReadTrack readTrack(WholeReader& reader) {
  ReadTrack track;
  track.moves = reader.whole() == 1;
  for (int c = 0; c < (track.moves ? 13 : 7); ++c)
    track.columns.push_back(reader.column(track.moves ? kFrames : 1));
  return track;
}

void expectNear(const Simulated& run, const PageQuanta& q, WholeReader& reader) {
  double smallest = 1.0;
  for (const BodyDescription& body : run.made.world.bodies())
    if (!body.is_static)
      smallest = std::min(smallest, run.made.world.solids()[static_cast<std::size_t>(body.solid)].radius());
  double farthest = 0.0, most_turn = 0.0;
  for (std::size_t i = 0; i < run.made.names.size(); ++i) {
    const ReadTrack track = readTrack(reader);
    for (std::size_t f = 0; f < kFrames; ++f) {
      const BodyState& state = run.frames[f][i];
      farthest = std::max(farthest, (track.vector(0, f, q.length_m) - state.X_WB.position).norm());
      Eigen::Vector4d read(track.number(3, f, q.quaternion), track.number(4, f, q.quaternion),
                           track.number(5, f, q.quaternion), track.number(6, f, q.quaternion));
      read.normalize();
      const Eigen::Vector4d was = numbersOf(state.X_WB.rotation);
      if (read.dot(was) < 0.0) read = -read;
      most_turn = std::max(most_turn, 2.0 * (read - was).norm());
      if (!track.moves) continue;
      EXPECT_LE((track.vector(7, f, q.speed_mps) - state.linear_velocity).norm(), 0.9 * q.speed_mps);
      EXPECT_LE((track.vector(10, f, q.spin_radps) - state.angular_velocity).norm(), 0.9 * q.spin_radps);
      if (f > 0) {  // neighbours have quaternions of one sign
        Eigen::Vector4d last(track.number(3, f - 1, 1.0), track.number(4, f - 1, 1.0),
                             track.number(5, f - 1, 1.0), track.number(6, f - 1, 1.0));
        EXPECT_GT(last.dot(read), 0.0) << run.made.names[i] << " frame " << f;
      }
    }
  }
  EXPECT_LE(farthest, 1e-4 * smallest);
  EXPECT_LE(most_turn, 6.2e-5);
  EXPECT_GT(farthest, 0.0) << "rounded to nothing?";
}

TEST(PageMotion, IsWithinItsBoundsOfTheSimulation) {
  for (const char* name : {"fifty-bodies", "spinning-coin", "sliding"}) {
    const Simulated run(name);
    const PageQuanta quanta = pageQuanta(run.made.world);
    PageMotion motion(run.made.world, quanta);
    for (const std::vector<BodyState>& states : run.frames) motion.add(states);
    ByteStream out;
    motion.write(out);
    WholeReader reader(out.bytes());
    expectNear(run, quanta, reader);
    for (std::size_t i = 0; i < run.made.names.size(); ++i) {
      if (run.made.world.bodies()[i].is_static) continue;
      for (std::size_t f = 0; f < kFrames;) {
        const std::int64_t mode = reader.whole();
        for (std::int64_t n = reader.whole(); n > 0; --n, ++f)
          EXPECT_EQ(mode, static_cast<std::int64_t>(run.frames[f][i].mode)) << name << " frame " << f;
      }
    }
    EXPECT_TRUE(reader.atEnd());
  }
}

TEST(PageMotion, OfABodyAtRestCostsHardlyMoreThanOfNone) {
  const Simulated run("resting");
  const std::vector<BodyState> states = run.frames.back();
  PageMotion motion(run.made.world, pageQuanta(run.made.world));
  for (int frame = 0; frame < 1000; ++frame) motion.add(states);
  ByteStream out;
  motion.write(out);
  EXPECT_LT(out.bytes().size(), 64 * run.made.names.size());
}

}  // namespace
}  // namespace carom::demos
