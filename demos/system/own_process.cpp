#include "demos/system/own_process.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/system/exit_code.h"

namespace carom::demos {

OwnProcess::OwnProcess(std::vector<std::string> words, const std::filesystem::path& out,
                       const std::filesystem::path& err) {
  words.insert(words.begin(), "/proc/self/exe");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string out_name = out.string(), err_name = err.string();
  id_ = ::fork();
  if (id_ < 0) throw CannotWrite(std::string("cannot start a process: ") + std::strerror(errno));
  if (id_ > 0) return;
  const int to_out = ::open(out_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int to_err = ::open(err_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (::dup2(to_out, STDOUT_FILENO) == STDOUT_FILENO && ::dup2(to_err, STDERR_FILENO) == STDERR_FILENO)
    ::execv(argv[0], argv.data());
  ::_exit(127);
}

OwnProcess::~OwnProcess() {
  if (id_ <= 0) return;
  ::kill(id_, SIGTERM);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> OwnProcess::ended() {
  int status = 0;
  if (id_ <= 0 || ::waitpid(id_, &status, WNOHANG) != id_) return std::nullopt;
  id_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace carom::demos
