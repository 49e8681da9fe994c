#pragma once
// Base64 (RFC 4648, section 4), as data: addresses of embedded images need it. Tested in
// tests/demos/format/base64_test.cpp.

#include <cstdint>
#include <span>
#include <string>

namespace carom::demos {

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace carom::demos
