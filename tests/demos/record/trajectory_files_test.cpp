#include "demos/record/trajectory_files.h"

#include <bit>
#include <cstdlib>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr int kFrames = 3;
constexpr int kBodies = 2;
const std::vector<std::string> kNames{"die", "b\u00e5ll"};

double timeOf(int frame) {
  return 0.1 * frame;
}

/// Every number is another one, and none is short in binary.
std::vector<BodyState> statesAt(int frame) {
  std::vector<BodyState> states(kBodies);
  for (int i = 0; i < kBodies; ++i) {
    BodyState& s = states[static_cast<std::size_t>(i)];
    const double base = 0.1 + 100.0 * frame + 1000.0 * i;
    s.X_WB.position = Vec3(base + 1, base + 2, base + 3);
    s.X_WB.rotation = Quat(base + 4, base + 5, base + 6, base + 7);
    s.linear_velocity = Vec3(base + 8, base + 9, base + 10);
    s.angular_velocity = Vec3(base + 11, base + 12, -base);
    s.mode = i == 0 ? Mode::kSliding : static_cast<Mode>(frame);
  }
  return states;
}

void write(const TrajectoryPaths& paths) {
  TrajectoryFiles files(paths, kNames, kFrames);
  ASSERT_TRUE(files);
  for (int frame = 0; frame < kFrames; ++frame) files.add(timeOf(frame), statesAt(frame));
  files.commit();
}

/// The elements of an .npy file of doubles with this shape in its header.
std::vector<double> doubles(const fs::path& path, const std::string& shape) {
  const std::string file = readTextFile(path);
  const std::size_t start =
      10 + static_cast<unsigned char>(file.at(8)) + 256u * static_cast<unsigned char>(file.at(9));
  EXPECT_NE(file.substr(0, start).find("'descr': '<f8', 'fortran_order': False, 'shape': " + shape),
            std::string::npos)
      << file.substr(10, start - 10);
  std::vector<double> values;
  for (std::size_t at = start; at < file.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < 8; ++k)
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(file.at(at + k))) << (8 * k);
    values.push_back(std::bit_cast<double>(word));
  }
  return values;
}

std::vector<double> expected(auto&& numbersOf) {
  std::vector<double> values;
  for (int frame = 0; frame < kFrames; ++frame)
    for (const BodyState& state : statesAt(frame))
      for (const double x : numbersOf(state)) values.push_back(x);
  return values;
}

TEST(TrajectoryFiles, ArraysHoldEveryBitInTheDocumentedOrder) {
  const TemporaryFolder folder;
  const fs::path npy = folder.path() / "arrays";
  write({{}, npy});
  EXPECT_EQ(doubles(npy / "times.npy", "(3,)"), (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(doubles(npy / "positions.npy", "(3, 2, 3)"),
            expected([](const BodyState& s) { return s.X_WB.position; }));
  EXPECT_EQ(doubles(npy / "rotations.npy", "(3, 2, 4)"), expected([](const BodyState& s) {
              const Quat& q = s.X_WB.rotation;
              return std::vector<double>{q.w(), q.x(), q.y(), q.z()};
            }));
  EXPECT_EQ(doubles(npy / "linear_velocities.npy", "(3, 2, 3)"),
            expected([](const BodyState& s) { return s.linear_velocity; }));
  EXPECT_EQ(doubles(npy / "angular_velocities.npy", "(3, 2, 3)"),
            expected([](const BodyState& s) { return s.angular_velocity; }));
  const std::string modes = readTextFile(npy / "modes.npy");
  EXPECT_EQ(modes.substr(modes.size() - 6), std::string("\3\0\3\1\3\2", 6));
}

TEST(TrajectoryFiles, NumpyLoadsEveryArray) {
  if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0)
    GTEST_SKIP() << "needs python3-numpy";
  const TemporaryFolder folder;
  write({{}, folder.path()});
  const fs::path script = folder.file("load.py", R"(
import numpy, sys
load = lambda name: numpy.load(sys.argv[1] + "/" + name + ".npy", allow_pickle=False)
for name, shape in dict(times=(3,), positions=(3, 2, 3), rotations=(3, 2, 4), linear_velocities=(3, 2, 3),
                        angular_velocities=(3, 2, 3)).items():
    assert load(name).shape == shape and load(name).dtype == numpy.float64, name
assert load("positions")[2, 1].tolist() == [0.1 + 200 + 1000 + k for k in (1, 2, 3)]
assert load("rotations")[1, 0].tolist() == [0.1 + 100 + k for k in (4, 5, 6, 7)]
assert load("modes").dtype == numpy.uint8
assert load("names").tolist() == ["die", "b\u00e5ll"]
modes = load("mode_names")[load("modes")]
assert modes.tolist() == [["sliding", "static"], ["sliding", "free"], ["sliding", "colliding"]], modes
)");
  EXPECT_EQ(std::system(("/usr/bin/python3 " + script.string() + " " + folder.path().string()).c_str()), 0);
}

TEST(TrajectoryFiles, ACsvHasARowABodyAndFrame) {
  const TemporaryFolder folder;
  write({folder.path() / "run.csv", {}});
  std::istringstream rows(readTextFile(folder.path() / "run.csv"));
  std::string header, first, second;
  std::getline(rows, header);
  std::getline(rows, first);
  std::getline(rows, second);
  EXPECT_EQ(header, "frame,time_s,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,mode");
  EXPECT_EQ(first.substr(0, 14), "0,0,\"die\",1.10");
  EXPECT_NE(second.find("\"b\u00e5ll\",1001.1,1002.1"), std::string::npos) << second;
}

TEST(TrajectoryFiles, ANameIsOneFieldOfTheCsvWhateverItHolds) {
  const TemporaryFolder folder;
  const std::vector<std::string> names{"a\",\"b", "c,d\"\n"};
  TrajectoryFiles files({folder.path() / "run.csv", {}}, names, 1);
  files.add(0.0, statesAt(0));
  files.commit();
  const std::string text = readTextFile(folder.path() / "run.csv");
  EXPECT_NE(text.find("\n0,0,\"a\"\",\"\"b\",1.1"), std::string::npos) << text;
  EXPECT_NE(text.find("\n0,0,\"c,d\"\"\n\",1001.1"), std::string::npos) << text;
}

TEST(TrajectoryFiles, NothingIsThereBeforeTheEnd) {
  const TemporaryFolder folder;
  {
    TrajectoryFiles files({folder.path() / "run.csv", folder.path() / "arrays"}, kNames, kFrames);
    files.add(0.0, statesAt(0));
  }
  EXPECT_FALSE(fs::exists(folder.path() / "run.csv"));
  EXPECT_TRUE(fs::is_empty(folder.path() / "arrays"));
}

TEST(TrajectoryFiles, WithoutPathsThereIsNothingToDo) {
  EXPECT_FALSE(TrajectoryFiles({}, kNames, kFrames));
}

}  // namespace
}  // namespace carom::demos
