#include "demos/system/worker_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"

namespace carom::demos {
namespace {

constexpr int kTurn_ms = 200;
constexpr std::size_t kHeadBytes = sizeof(std::uint64_t);

bool readAll(int descriptor, std::uint8_t* to, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(descriptor, to, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

/// Whether the other side has shut its half, though bytes of it may still wait.
bool hasEnded(int descriptor) {
  pollfd looked{descriptor, POLLRDHUP, 0};
  return ::poll(&looked, 1, 0) > 0 && (looked.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

std::array<std::uint8_t, kHeadBytes> headOf(std::span<const std::uint8_t> message) {
  const std::uint64_t size = message.size();
  std::array<std::uint8_t, kHeadBytes> head{};
  std::memcpy(head.data(), &size, kHeadBytes);
  return head;
}

/// While it lives no signal but those of faults arrives: a child is born with them held back.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_{};
};

}  // namespace

std::optional<Message> ParentLine::receive() const {
  std::uint64_t size = 0;
  if (!readAll(descriptor_, reinterpret_cast<std::uint8_t*>(&size), sizeof size)) return std::nullopt;
  Message message(size);
  if (!readAll(descriptor_, message.data(), message.size()) || hasEnded(descriptor_)) return std::nullopt;
  return message;
}

bool ParentLine::send(std::span<const std::uint8_t> message) const {
  const std::array<std::uint8_t, kHeadBytes> head = headOf(message);
  for (std::span<const std::uint8_t> rest : {std::span<const std::uint8_t>(head), message})
    while (!rest.empty()) {
      const ssize_t sent = ::send(descriptor_, rest.data(), rest.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent < 0) return false;
      rest = rest.subspan(static_cast<std::size_t>(sent));
    }
  return true;
}

WorkerProcess::WorkerProcess(const Work& work, std::span<const WorkerProcess> siblings) {
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    throw CannotWrite(std::string("cannot start a worker process: ") + std::strerror(errno));
  const HeldSignals held;
  id_ = ::fork();
  if (id_ == 0) {
    ::close(sockets[0]);
    for (const WorkerProcess& sibling : siblings) ::close(sibling.descriptor_);
    for (const int ignored : {SIGINT, SIGTERM, SIGPIPE}) std::signal(ignored, SIG_IGN);
    sigprocmask(SIG_SETMASK, &held.before(), nullptr);
    runChild(work, sockets[1]);
  }
  const int reason = errno;
  ::close(sockets[1]);
  descriptor_ = sockets[0];
  if (id_ > 0) return;
  ::close(descriptor_);
  throw CannotWrite(std::string("cannot start a worker process: ") + std::strerror(reason));
}

void WorkerProcess::runChild(const Work& work, int descriptor) {
  try {
    work(ParentLine(descriptor));
  } catch (...) {
    std::abort();  // `work` tells its failures itself
  }
  ::_exit(0);
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      arrived_(std::move(other.arrived_)),
      end_(other.end_) {}

WorkerProcess::~WorkerProcess() {
  end();
}

bool WorkerProcess::readAvailable() {
  std::array<std::uint8_t, 65536> part;
  while (true) {
    const ssize_t got = ::recv(descriptor_, part.data(), part.size(), MSG_DONTWAIT);
    if (got > 0) arrived_.insert(arrived_.end(), part.begin(), part.begin() + got);
    if (got > 0 || (got < 0 && errno == EINTR)) continue;
    return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
  }
}

bool WorkerProcess::send(std::span<const std::uint8_t> message) {
  if (descriptor_ < 0) return false;  // it went while it was listened to
  const std::array<std::uint8_t, kHeadBytes> head = headOf(message);
  for (std::span<const std::uint8_t> rest : {std::span<const std::uint8_t>(head), message})
    while (!rest.empty()) {
      pollfd waited{descriptor_, POLLIN | POLLOUT, 0};
      if (::poll(&waited, 1, -1) < 0) continue;
      if ((waited.revents & POLLIN) != 0 && !readAvailable()) return false;
      const ssize_t sent = ::send(descriptor_, rest.data(), rest.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent > 0)
        rest = rest.subspan(static_cast<std::size_t>(sent));
      else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
        return false;
    }
  return true;
}

std::optional<Message> WorkerProcess::takeMessage() {
  if (arrived_.size() < kHeadBytes) return std::nullopt;
  std::uint64_t size = 0;
  std::memcpy(&size, arrived_.data(), kHeadBytes);
  if (arrived_.size() - kHeadBytes < size) return std::nullopt;
  const auto begin = arrived_.begin() + static_cast<std::ptrdiff_t>(kHeadBytes);
  const auto end = begin + static_cast<std::ptrdiff_t>(size);
  Message message(begin, end);
  arrived_.erase(arrived_.begin(), end);
  return message;
}

std::optional<Message> WorkerProcess::receive(Interrupts interrupts) {
  while (true) {
    if (std::optional<Message> message = takeMessage()) return message;
    if (descriptor_ < 0) return std::nullopt;
    if (interrupts == Interrupts::kHeeding) throwIfInterrupted();
    pollfd waited{descriptor_, POLLIN, 0};
    if (::poll(&waited, 1, kTurn_ms) <= 0) continue;
    if (!readAvailable()) {  // its last words count
      ::close(descriptor_);
      descriptor_ = -1;
    }
  }
}

void WorkerProcess::endInput() {
  if (descriptor_ >= 0) ::shutdown(descriptor_, SHUT_WR);
}

void WorkerProcess::kill() const {
  if (id_ > 0 && !end_) ::kill(id_, SIGKILL);
}

WorkerProcess::End WorkerProcess::end() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (end_ || id_ <= 0) return end_.value_or(End{});
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  end_ = WIFSIGNALED(status) ? End{WTERMSIG(status), 0} : End{0, WEXITSTATUS(status)};
  return *end_;
}

}  // namespace carom::demos
