#pragma once
// Text of unknown origin (names in a scene, file names, what a library says) as one line that a terminal
// shows as it is: control characters are written as escapes, so that none begins a line, moves the cursor or
// changes a colour. Tested in tests/demos/format/printable_test.cpp.

#include <string>
#include <string_view>

namespace carom::demos {

/// \n, \r and \t by these two letters; other control characters and bytes that are no UTF-8 as \xHH. What
/// would be longer than `kLongestLine` bytes lacks its middle, where dots stand.
inline constexpr std::size_t kLongestLine = 8000;
std::string printable(std::string_view text);

}  // namespace carom::demos
