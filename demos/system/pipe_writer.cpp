#include "demos/system/pipe_writer.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>

#include <poll.h>
#include <unistd.h>

#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"

namespace carom::demos {
namespace {

constexpr int kTurn_ms = 200;

}  // namespace

PipeWriter::PipeWriter(int descriptor, std::string target)
    : descriptor_(descriptor), target_(std::move(target)) {
  std::signal(SIGPIPE, SIG_IGN);
}

void PipeWriter::waitUntilReady() const {
  while (true) {
    pollfd waited{descriptor_, POLLOUT, 0};
    if (::poll(&waited, 1, kTurn_ms) > 0) return;  // ready, or an error that write names
    throwIfInterrupted();
  }
}

void PipeWriter::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    waitUntilReady();
    // A pipe that is ready takes PIPE_BUF bytes without blocking; more could block.
    const ssize_t written = ::write(descriptor_, bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno == EPIPE) {
      throw PipeClosed("the reader of " + target_ + " closed the pipe");
    } else if (errno != EINTR && errno != EAGAIN) {
      throw CannotWrite("cannot write to " + target_ + ": " + std::strerror(errno));
    }
  }
}

}  // namespace carom::demos
