#pragma once
// REQUIRE states what must hold if the program has no bug; it is on in every build and prints its values.
// InputError is the other kind of failure: something a person gave us. Numerical outcomes are neither: they
// are returned as a status. Tested in tests/engine/foundation/contract_test.cpp.

#include <sstream>
#include <stdexcept>
#include <string>

namespace carom {

/// Bad input. The message is one line that says what is wrong, the value, and what would be accepted.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A broken contract: a bug of this program.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void failContract(const char* condition, const char* file, int line, const std::string& values);

/// "name=value name=value" for the message of REQUIRE.
template <typename... Values>
std::string printValues(const Values&... values) {
  std::ostringstream out;
  out.precision(17);
  ((out << ' ' << values), ...);
  return out.str();
}

}  // namespace carom

#define REQUIRE(condition, ...)                                                                 \
  do {                                                                                          \
    if (!(condition))                                                                           \
      ::carom::failContract(#condition, __FILE__, __LINE__, ::carom::printValues(__VA_ARGS__)); \
  } while (false)
