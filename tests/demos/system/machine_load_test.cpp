#include "demos/system/machine_load.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

TEST(MachineLoad, ReadsTheFirstLineOfProcStat) {
  const std::optional<CpuTime> time = parseCpuTime("cpu  100 20 30 400 50 6 7 8 9 10\ncpu0 1 2 3\n", 100.0);
  ASSERT_TRUE(time);
  EXPECT_DOUBLE_EQ(time->total_s, 6.21);  // guests are counted within user and nice
  EXPECT_DOUBLE_EQ(time->busy_s, 1.71);   // neither idle nor iowait; stolen time is
  for (const char* other : {"", "cpu", "cpu 1 2", "cpu a b c d e f g h", "intr 1 2 3 4 5 6 7 8 9"})
    EXPECT_FALSE(parseCpuTime(other, 100.0)) << other;
}

TEST(MachineLoad, TheOutsideShareIsWhatIsBusyAndNotOurs) {
  const CpuTime before{100.0, 40.0}, after{120.0, 52.0};
  EXPECT_DOUBLE_EQ(outsideShare(before, after, 5.0, 0.0), 0.35);
  EXPECT_DOUBLE_EQ(outsideShare(before, after, 5.0, 1.0), 0.3);
  EXPECT_DOUBLE_EQ(outsideShare(before, after, 12.5, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(outsideShare(before, before, 0.0, 0.0), 0.0);
}

TEST(MachineLoad, OurOwnThreadsAreNotOutside) {
  std::atomic<bool> stop = false;
  const auto spin = [&stop] {
    while (!stop) continue;
  };
  const MachineLoad load;
  if (!load.outsideShare()) GTEST_SKIP() << "/proc/stat does not tell";
  std::thread a(spin), b(spin);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  stop = true;
  a.join();
  b.join();
  const double share = load.outsideShare().value();
  EXPECT_GE(share, 0.0);
  EXPECT_LT(share, 0.9);  // two busy threads of ours alone would be 1 of two cores
}

}  // namespace
}  // namespace carom::demos
