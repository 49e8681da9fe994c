#include "demos/against/paced_program.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>

#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/against/paced_frames.h"
#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr int kLook_ms = 100;  // between two looks at whether to go on waiting

void keepTo(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(processor), &set);
  ::sched_setaffinity(0, sizeof set, &set);
}

/// How far data lie from the begin of a cache line makes a phase some percent slower, of one program started
/// with other words too. So that this strikes both alike, it is drawn anew for each: the C library copies the
/// list of variables to the heap as soon as the program sets one, and what it allocates later lies behind
/// that copy.
void shiftHeap() {
  constexpr unsigned kMost = 16;  // variables of 8 bytes: a line of 64, twice
  std::random_device random;
  for (unsigned i = random() % kMost; i > 0; --i)
    ::setenv(("CAROM_PACED_" + std::to_string(i)).c_str(), "", 1);
}

[[noreturn]] void runChild(std::vector<std::string>& words, int socket, std::optional<int> processor) {
  if (processor) keepTo(*processor);
  shiftHeap();
  ::signal(SIGINT, SIG_IGN);  // the parent's to answer
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (::dup2(socket, STDIN_FILENO) == STDIN_FILENO && ::dup2(socket, STDOUT_FILENO) == STDOUT_FILENO)
    ::execvp(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

std::vector<int> usableProcessors() {
  std::vector<int> all;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return all;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(static_cast<std::size_t>(i), &set)) all.push_back(i);
  return all;
}

PacedProgram::PacedProgram(std::vector<std::string> words, std::string name, std::optional<int> processor)
    : name_(std::move(name)) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw CannotWrite(std::string("cannot start ") + name_ + ": " + std::strerror(errno));
  id_ = ::fork();
  if (id_ == 0) runChild(words, ends[1], processor);
  ::close(ends[1]);
  socket_ = ends[0];
  if (id_ > 0) return;
  const int reason = errno;
  ::close(socket_);
  throw CannotWrite(std::string("cannot start ") + name_ + ": " + std::strerror(reason));
}

PacedProgram::~PacedProgram() {
  ::close(socket_);
  ::kill(id_, SIGKILL);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::string PacedProgram::readLine() {
  constexpr std::size_t kLongest = 1 << 16;
  for (;;) {
    const std::size_t end = arrived_.find('\n');
    if (end != std::string::npos) {
      std::string line = arrived_.substr(0, end);
      arrived_.erase(0, end + 1);
      return line;
    }
    throwIfInterrupted();
    pollfd wait{socket_, POLLIN, 0};
    if (::poll(&wait, 1, kLook_ms) <= 0) continue;
    char bytes[4096];
    const ssize_t count = ::read(socket_, bytes, sizeof bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 || arrived_.size() > kLongest)
      throw InputError("--against: " + name_ +
                       " ended without an answer; accepted: a carom that knows --paced");
    arrived_.append(bytes, static_cast<std::size_t>(count));
  }
}

int PacedProgram::awaitReady() {
  const std::string line = readLine(), greeting = "carom-paced 1 ";
  if (line.rfind(greeting, 0) != 0)
    throw InputError("--against: " + name_ + " begins with \"" + line +
                     "\"; accepted: a carom that knows --paced");
  return std::atoi(line.c_str() + greeting.size());
}

FrameCost PacedProgram::next() {
  while (::send(socket_, "\n", 1, MSG_NOSIGNAL) < 0 && errno == EINTR) throwIfInterrupted();
  return readPacedLine(readLine(), name_);
}

}  // namespace carom::demos
