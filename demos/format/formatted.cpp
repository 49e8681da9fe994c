#include "demos/format/formatted.h"

#include <cstdarg>
#include <cstdio>

namespace carom::demos {

std::string formatted(const char* pattern, ...) {
  char buffer[512];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, values);
  va_end(values);
  return buffer;
}

}  // namespace carom::demos
