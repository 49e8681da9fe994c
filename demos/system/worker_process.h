#pragma once
// A process that works for this one: forked, joined to it by a socket, and gone when it is gone. Messages go
// both ways, each whole; neither side ever waits for the other to read while the other waits for it. An
// interrupt is the parent's to answer: workers ignore it and end when they are told or left alone. Tested in
// tests/demos/system/worker_process_test.cpp, and through the program in
// tests/demos/program/workers_program_test.cpp.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <sys/types.h>

namespace carom::demos {

using Message = std::vector<std::uint8_t>;

/// The worker's end of the socket.
class ParentLine {
 public:
  explicit ParentLine(int descriptor) : descriptor_(descriptor) {}
  /// The next message; none when the parent has no more, or has gone, or has called `endInput` while messages
  /// were still waiting.
  std::optional<Message> receive() const;
  /// False when the parent has gone.
  bool send(std::span<const std::uint8_t> message) const;

 private:
  int descriptor_;
};

class WorkerProcess {
 public:
  using Work = std::function<void(const ParentLine&)>;

  /// Forks; the child calls `work` and ends, with nothing of the parent's flushed or destroyed. To be called
  /// while the process has one thread. `siblings` are the workers before it, whose sockets it closes. Throws
  /// CannotWrite when the system allows no more processes or sockets.
  WorkerProcess(const Work& work, std::span<const WorkerProcess> siblings);
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) = delete;
  /// Ends the worker as `end` does.
  ~WorkerProcess();

  /// Hands a message over; what arrives meanwhile is kept for `receive`. False when the worker has gone.
  bool send(std::span<const std::uint8_t> message);
  /// Waits for the next message; none when the worker has gone. Throws Interrupted only when `heeding`.
  enum class Interrupts { kHeeding, kIgnoring };
  std::optional<Message> receive(Interrupts interrupts);
  /// Tells it that nothing more comes: it finishes what it is at, and leaves what waits.
  void endInput();
  /// Closes the socket and waits for the process, which finishes what it is at; 0, or the signal that killed
  /// it, or its exit code otherwise. Calling it again gives the same answer.
  struct End {
    int signal = 0;
    int code = 0;
  };
  End end();
  /// Ends it at once.
  void kill() const;

  pid_t id() const { return id_; }

 private:
  [[noreturn]] static void runChild(const Work& work, int descriptor);
  std::optional<Message> takeMessage();
  bool readAvailable();

  pid_t id_ = -1;
  int descriptor_ = -1;
  std::vector<std::uint8_t> arrived_;
  std::optional<End> end_;
};

}  // namespace carom::demos
