#pragma once
// Numbers in lines of text, as printf writes them.

#include <string>

namespace carom::demos {

/// At most 511 characters; what is longer is cut off.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

}  // namespace carom::demos
