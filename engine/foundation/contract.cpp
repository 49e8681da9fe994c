#include "engine/foundation/contract.h"

namespace carom {

void failContract(const char* condition, const char* file, int line, const std::string& values) {
  std::ostringstream message;
  message << "bug: " << condition << " does not hold at " << file << ':' << line;
  if (!values.empty()) message << " with" << values;
  throw ContractViolation(message.str());
}

}  // namespace carom
