#include "demos/system/pipe_writer.h"

#include <array>
#include <csignal>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

std::vector<std::uint8_t> manyBytes() {
  std::vector<std::uint8_t> bytes(1000003);  // many times what a pipe holds
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 31 + i / 251);
  return bytes;
}

TEST(PipeWriter, ASlowReaderGetsEveryByte) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  std::vector<std::uint8_t> read_bytes;
  std::thread reader([&] {
    std::array<std::uint8_t, 777> part{};
    for (ssize_t n = read(ends[0], part.data(), part.size()); n > 0;
         n = read(ends[0], part.data(), part.size()))
      read_bytes.insert(read_bytes.end(), part.begin(), part.begin() + n);
  });
  PipeWriter(ends[1], "it").write(manyBytes());
  close(ends[1]);
  reader.join();
  close(ends[0]);
  EXPECT_EQ(read_bytes, manyBytes());
}

TEST(PipeWriter, AClosedPipeIsNamedAndKillsNobody) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  close(ends[0]);
  EXPECT_EQ(thrownMessage<PipeClosed>([&] { PipeWriter(ends[1], "it").write(manyBytes()); }),
            "the reader of it closed the pipe");
  close(ends[1]);
}

TEST(PipeWriter, AFullDiskIsAnErrorOfWriting) {
  const int full = open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  EXPECT_EQ(thrownMessage<CannotWrite>([&] { PipeWriter(full, "it").write(manyBytes()); }),
            "cannot write to it: No space left on device");
  close(full);
}

[[noreturn]] void endWith43WhenInterruptedWhileNobodyReads() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) _exit(1);
  catchInterrupts();
  raise(SIGTERM);
  alarm(10);
  try {
    PipeWriter(ends[1], "it").write(manyBytes());
  } catch (const Interrupted& interrupted) {
    _exit(interrupted.signal == SIGTERM ? 43 : 2);
  }
  _exit(3);
}

// In a process of its own: the signal's flag stays up.
TEST(PipeWriterDeathTest, AnInterruptIsHeardWhileNobodyReads) {
  EXPECT_EXIT(endWith43WhenInterruptedWhileNobodyReads(), testing::ExitedWithCode(43), "");
}

}  // namespace
}  // namespace carom::demos
