#include "demos/system/worker_process.h"

#include <cerrno>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace carom::demos {
namespace {

constexpr auto kHeeding = WorkerProcess::Interrupts::kHeeding;

Message bytes(std::size_t size, int seed) {
  Message message(size);
  for (std::size_t i = 0; i < size; ++i)
    message[i] = static_cast<std::uint8_t>(i * 31 + static_cast<std::size_t>(seed));
  return message;
}

void echo(const ParentLine& parent) {
  while (const std::optional<Message> message = parent.receive())
    if (!parent.send(*message)) return;
}

bool hasChildren() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

// Each message is far larger than a socket holds, and the parent sends all before it reads any: both would
// wait for ever if the parent did not read while it sends.
TEST(WorkerProcess, LargeMessagesBothWaysAtOnceArriveWholeAndInOrder) {
  WorkerProcess worker(echo, {});
  const std::size_t sizes[] = {5000000, 0, 1, 3000000, 4000000};
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(worker.send(bytes(sizes[i], i)));
  for (int i = 0; i < 5; ++i) {
    const std::optional<Message> message = worker.receive(kHeeding);
    ASSERT_TRUE(message.has_value());
    EXPECT_TRUE(*message == bytes(sizes[i], i)) << i;
  }
  const WorkerProcess::End end = worker.end();
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.code, 0);
  EXPECT_FALSE(hasChildren());
}

TEST(WorkerProcess, AKilledOneIsNoticedAndNamedByItsSignal) {
  WorkerProcess worker(echo, {});
  worker.kill();
  EXPECT_FALSE(worker.receive(kHeeding).has_value());
  EXPECT_EQ(worker.end().signal, SIGKILL);
  EXPECT_FALSE(hasChildren());
}

TEST(WorkerProcess, LastWordsOfOneThatEndsAreHeard) {
  WorkerProcess worker([](const ParentLine& parent) { parent.send(bytes(300000, 7)); }, {});
  const std::optional<Message> message = worker.receive(kHeeding);
  ASSERT_TRUE(message.has_value());
  EXPECT_TRUE(*message == bytes(300000, 7));
  EXPECT_FALSE(worker.receive(kHeeding).has_value());
}

TEST(WorkerProcess, InterruptsAreTheParentsAlone) {
  WorkerProcess worker(echo, {});
  for (const int number : {SIGINT, SIGTERM}) ::kill(worker.id(), number);
  ASSERT_TRUE(worker.send(bytes(10, 1)));
  EXPECT_TRUE(worker.receive(kHeeding).has_value());
}

// The worker takes the first message, and answers after the others wait and the end has been told.
TEST(WorkerProcess, AfterTheEndOfInputWhatWaitsIsLeft) {
  WorkerProcess worker(
      [](const ParentLine& parent) {
        while (const std::optional<Message> message = parent.receive()) {
          ::usleep(200000);
          if (!parent.send(*message)) return;
        }
      },
      {});
  ASSERT_TRUE(worker.send(bytes(1, 1)));
  ::usleep(100000);
  ASSERT_TRUE(worker.send(bytes(2, 2)));
  ASSERT_TRUE(worker.send(bytes(3, 3)));
  worker.endInput();
  const std::optional<Message> answer = worker.receive(WorkerProcess::Interrupts::kIgnoring);
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->size(), 1u);
  EXPECT_FALSE(worker.receive(WorkerProcess::Interrupts::kIgnoring).has_value());
}

// A sibling that held another's socket would keep it waiting for a parent that has gone.
TEST(WorkerProcess, EachEndsByItselfWhileItsSiblingsLive) {
  std::vector<WorkerProcess> workers;
  workers.reserve(3);
  for (int i = 0; i < 3; ++i) workers.emplace_back(echo, workers);
  for (WorkerProcess& worker : workers) EXPECT_EQ(worker.end().signal, 0);  // would not return otherwise
  EXPECT_FALSE(hasChildren());
}

}  // namespace
}  // namespace carom::demos
