#include "tests/fuzz/program.h"
#include "tests/support/shell.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <csignal>
#include <unistd.h>

namespace carom::fuzz {
namespace fs = std::filesystem;
namespace {

using Words = std::vector<std::string>;

std::vector<Words> commandsFor(const Input& input, const std::string& file) {
  switch (input.kind) {
    case Kind::kScene:
      return {{"check", file}, {"simulate", file, "-q", "--duration", "0.01"}};
    case Kind::kRecording:
      return {{"export", file, "-q", "--csv", "/dev/null"},
              {"render", "--from", file, "-q", "--size", "32x18", "--frames", "0", "-o", "-", "--stream",
               "rgb24"}};
    case Kind::kMesh:
      return {{"check", file}, {"distance", file, file}};
    case Kind::kPng:
      return {{"compare", file, file, "-q", "--report", "none"}};
    case Kind::kQueries:
      return {{"distance", "--batch", file}};
    case Kind::kWords:  // They may name any file to be written.
      return {};
  }
  return {};
}

[[noreturn]] void runProgram(const fs::path& program, Words words, const fs::path& said) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  const int lines = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(lines, STDERR_FILENO);
  words.insert(words.begin(), program.string());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

std::string wrongWithProgram(const fs::path& program, const Input& input, const fs::path& file,
                             std::uint64_t turn) {
  const std::vector<Words> commands = commandsFor(input, file.string());
  if (commands.empty()) return "";
  const Words& words = commands[turn % commands.size()];
  const fs::path said = file.string() + ".said";
  const pid_t id = ::fork();
  if (id == 0) runProgram(program, words, said);
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  std::ifstream in(said);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const int code = exitCodeOf(status);
  const auto lines = std::count(text.begin(), text.end(), '\n');
  const bool is_line = lines == 1 && text.back() == '\n' && text.rfind("carom: ", 0) == 0;
  if (code <= 5 && (code == 0 || is_line)) return "";
  return words[0] + " ends with " + std::to_string(code) + " and says: " + text.substr(0, 3000);
}

}  // namespace carom::fuzz
