#pragma once
// The program's exit codes, and the failures that lead to them and that the engine has no name for.
// InputError (bad scene or asset) comes from engine/foundation, NoRenderer from renderer.
// Tested in tests/demos/system/exit_code_test.cpp, and through the program in
// tests/demos/program/program_test.cpp.

#include <exception>
#include <stdexcept>
#include <string>

namespace carom::demos {

enum class ExitCode {
  kOk = 0,
  kNo = 1,           ///< The question has been answered: no.
  kUsage = 2,        ///< Unknown command or option, or a value out of range.
  kBadInput = 3,     ///< Bad scene or asset.
  kCannotWrite = 4,  ///< Or the system gives no more memory, threads or processes.
  kInvalid = 5,      ///< The simulation left what it guarantees.
  kNoRenderer = 6,
  kInconclusive = 7,  ///< Too much noise to judge a time.
  kSignal = 128       ///< Plus the signal's number.
};

/// A command line that cannot be carried out as it stands.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or folder that cannot be written; says which and why.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The system gives no more memory, threads or processes; says which.
class OutOfResources : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A simulation whose state broke the engine's guarantee (a gap that closed, a number that is not finite).
class SimulationInvalid : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whoever read the frames has gone.
class PipeClosed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The person or the system asked the program to stop.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(int signal_number) : std::runtime_error("interrupted"), signal(signal_number) {}
  int signal;
};

/// How the program ends after an exception. The line is one, whatever the names in the message hold.
struct Failure {
  int code = 0;
  std::string line;     ///< What to print.
  bool is_bug = false;  ///< Nobody's input is at fault: end by abort.
};
Failure failureOf(const std::exception_ptr& thrown);

/// A failure of another process that worked for this one, which is this one's now.
class ProcessFailure : public std::runtime_error {
 public:
  explicit ProcessFailure(const Failure& of) : std::runtime_error(of.line), failure(of) {}
  Failure failure;
};

}  // namespace carom::demos
