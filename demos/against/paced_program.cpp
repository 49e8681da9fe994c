#include "demos/against/paced_program.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/personality.h>
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

/// The program of that name, sought along PATH where it names no folder; -1: there is none.
int opened(const std::string& name) {
  if (name.find('/') != std::string::npos) return ::open(name.c_str(), O_RDONLY);
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + name).c_str(), X_OK) == 0)
      return ::open((folder + "/" + name).c_str(), O_RDONLY);
  return -1;
}

[[noreturn]] void runChild(std::vector<std::string>& words, int socket) {
  const int current = ::personality(0xffffffff);
  if (current != -1) ::personality(static_cast<unsigned long>(current) | ADDR_NO_RANDOMIZE);
  ::signal(SIGINT, SIG_IGN);  // the parent's to answer
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // The path and the first word lie on the new stack: of equal length, or equal programs run on other
  // addresses.
  const int program = opened(words[0]);
  std::string name = "carom";
  argv[0] = name.data();
  constexpr int kProgram = 3;
  if (program >= 0 && ::dup2(socket, STDIN_FILENO) == STDIN_FILENO &&
      ::dup2(socket, STDOUT_FILENO) == STDOUT_FILENO && ::dup2(program, kProgram) == kProgram)
    ::fexecve(kProgram, argv.data(), environ);
  ::_exit(127);
}

}  // namespace

PacedProgram::PacedProgram(std::vector<std::string> words, std::string name) : name_(std::move(name)) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw CannotWrite(std::string("cannot start ") + name_ + ": " + std::strerror(errno));
  id_ = ::fork();
  if (id_ == 0) runChild(words, ends[1]);
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
