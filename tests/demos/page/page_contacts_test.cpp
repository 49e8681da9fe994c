// What a page holds of contacts is what the overlays of `carom render` show, within the step of its numbers.
#include "demos/page/page_contacts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "demos/language/scene_choice.h"
#include "demos/motion/frame_source.h"
#include "tests/demos/support/whole_reader.h"

namespace carom::demos {
namespace {

using Row = std::vector<std::int64_t>;
struct ReadPair {
  int a = 0, b = 0;
  Row row;
};

/// The reading half of PageContacts::addPairs.
class PairReader {
 public:
  std::vector<ReadPair> next(WholeReader& reader) {
    std::map<std::tuple<int, int, int>, Row> now;
    std::map<std::pair<int, int>, int> count;
    std::vector<ReadPair> pairs;
    for (std::int64_t n = reader.whole(); n > 0; --n) {
      ReadPair pair{static_cast<int>(reader.whole()), static_cast<int>(reader.whole()), {}};
      for (std::int64_t k = reader.whole(); k > 0; --k) pair.row.push_back(reader.whole());
      const std::tuple key(pair.a, pair.b, count[{pair.a, pair.b}]++);
      const auto before = former_.find(key);
      if (before != former_.end() && before->second.size() == pair.row.size())
        for (std::size_t i = 0; i < pair.row.size(); ++i) pair.row[i] += before->second[i];
      now[key] = pair.row;
      pairs.push_back(pair);
    }
    former_ = std::move(now);
    return pairs;
  }

 private:
  std::map<std::tuple<int, int, int>, Row> former_;
};

void skipRegions(WholeReader& reader) {
  const auto skipPoints = [&reader] {
    for (std::int64_t n = 3 * reader.whole(); n > 0; --n) reader.whole();
  };
  for (std::int64_t n = reader.whole(); n > 0; --n) {
    const bool is_wide = reader.whole() == 1;
    for (int i = 0; i < (is_wide ? 7 : 4); ++i) reader.whole();
    if (is_wide) continue;
    skipPoints();
    for (int kind = 0; kind < 2; ++kind)
      for (std::int64_t lines = reader.whole(); lines > 0; --lines) skipPoints();
  }
}

struct ReadFrame {
  std::vector<ReadPair> contacts, impulses, distances;
  Row closest;
};

std::vector<ReadFrame> readFrames(const PageContacts& page, int frames) {
  ByteStream out;
  page.write(out);
  WholeReader reader(out.bytes());
  skipRegions(reader);
  PairReader contacts, impulses, distances;
  std::vector<ReadFrame> read;
  for (int frame = 0; frame < frames; ++frame) {
    ReadFrame one{contacts.next(reader), impulses.next(reader), distances.next(reader), {}};
    if (reader.whole() == 1)
      for (int i = 0; i < 11; ++i) one.closest.push_back(reader.whole());
    read.push_back(one);
  }
  EXPECT_TRUE(reader.atEnd());
  return read;
}

Vec3 pointAt(const Row& row, std::size_t at, double quantum) {
  return quantum * Vec3(static_cast<double>(row[at]), static_cast<double>(row[at + 1]),
                        static_cast<double>(row[at + 2]));
}

TEST(PageContacts, AreThoseOfTheOverlays) {
  constexpr int kFrames = 30;
  SceneChoice choice;
  choice.scene = "fifty-bodies";
  const Scene scene = chosenScene(choice);
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock({20.0, scene.rate_hz});
  const double quantum = pageQuanta(made.world).contact_m;
  PageContacts page(made, {quantum, false, kFrames});
  RunFacts facts;
  FrameSource source(made, clock, facts);
  std::vector<std::vector<NearPair>> near;
  for (int frame = 0; frame < kFrames; ++frame) {
    const FrameState state = source.at(frame);
    page.add(state.bodies, frame, clock.time(frame));
    near.push_back(nearPairs(made.world, state.bodies));
  }
  std::size_t points = 0, impulses = 0;
  const std::vector<ReadFrame> frames = readFrames(page, kFrames);
  for (std::size_t f = 0; f < kFrames; ++f) {
    // Every manifold of the frame is there, with the points that it had.
    std::vector<ReadPair> left = frames[f].contacts;
    for (const NearPair& pair : near[f]) {
      if (!touches(pair)) continue;
      const ContactManifold manifold = manifoldOf(pair);
      const auto found = std::find_if(left.begin(), left.end(), [&](const ReadPair& read) {
        return read.a == pair.body_a && read.b == pair.body_b &&
               read.row.size() == 1 + 6 * static_cast<std::size_t>(manifold.count) &&
               (pointAt(read.row, 1, quantum) - manifold.points[0].p_W).norm() <= quantum;
      });
      ASSERT_NE(found, left.end()) << "frame " << f << " "
                                   << made.names[static_cast<std::size_t>(pair.body_a)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k, ++points) {
        EXPECT_LE((pointAt(found->row, 1 + 6 * k, quantum) - manifold.points[k].p_W).norm(), quantum);
        EXPECT_LE((pointAt(found->row, 4 + 6 * k, 1.0 / 127.0) - manifold.points[k].n_W).norm(), 0.007);
      }
      left.erase(found);
    }
    EXPECT_TRUE(left.empty()) << "frame " << f;
    impulses += frames[f].impulses.size();
    if (near[f].empty()) continue;
    ASSERT_EQ(frames[f].closest.size(), 11u);
    EXPECT_EQ(frames[f].closest[0], near[f][0].body_a);
    EXPECT_EQ(frames[f].closest[10], byLogarithm(near[f][0].closest.distance_m));
  }
  EXPECT_GT(points, 500u) << "the bodies have landed";
  EXPECT_GT(impulses, 100u);
  EXPECT_EQ(page.leftOut(), 0);
}

TEST(PageContacts, OfARecordingHaveNoImpulses) {
  SceneChoice choice;
  choice.scene = "resting";
  const Scene scene = chosenScene(choice);
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock({10.0, scene.rate_hz});
  RunFacts facts;
  FrameSource source(made, clock, facts);
  PageContacts page(made, {pageQuanta(made.world).contact_m, true, 20});
  for (int frame = 0; frame < 20; ++frame) page.add(source.at(frame).bodies, frame, clock.time(frame));
  const std::vector<ReadFrame> frames = readFrames(page, 20);
  EXPECT_FALSE(frames.back().contacts.empty());
  for (const ReadFrame& frame : frames) EXPECT_TRUE(frame.impulses.empty());
}

TEST(PageContacts, ShareTheRoomOfAPage) {
  SceneChoice choice;
  choice.scene = "wall";
  const Scene scene = chosenScene(choice);
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  PageContacts page(made, {pageQuanta(made.world).contact_m, false, PageContacts::kMostPoints});
  page.add(made.world.states(), 0, 0.0);
  std::size_t points = 0;
  const std::vector<ReadFrame> frames = readFrames(page, 1);
  for (const ReadPair& pair : frames[0].contacts) points += (pair.row.size() - 1) / 6;
  EXPECT_LE(points, static_cast<std::size_t>(PageContacts::kFewestPoints));
  EXPECT_GT(page.leftOut(), 0);
}

}  // namespace
}  // namespace carom::demos
