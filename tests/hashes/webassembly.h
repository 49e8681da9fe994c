#pragma once
// What the C++ library of emscripten 3.1.69 (Debian 13) lacks of C++20, for a module of one thread: read
// before every source of the WebAssembly cell (webassembly.sh).
#ifdef __cplusplus
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

namespace std {

/// One thread: plain reading and writing.
template <class T>
class atomic_ref {
 public:
  explicit atomic_ref(T& value) : value_(value) {}
  T operator+=(T more) const { return value_ += more; }
  T load(memory_order = memory_order_seq_cst) const { return value_; }
  void store(T value, memory_order = memory_order_seq_cst) const { value_ = value; }
  bool compare_exchange_weak(T& expected, T value, memory_order = memory_order_seq_cst) const {
    const bool is_expected = value_ == expected;
    (is_expected ? value_ : expected) = is_expected ? value : value_;
    return is_expected;
  }

 private:
  T& value_;
};

/// musl's strtod rounds to the nearest, as from_chars does.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string_view rest(first, static_cast<size_t>(last - first));
  const string number(rest.substr(0, rest.find_first_not_of("0123456789.eE+-")));
  if (number.empty() || number[0] == '+') return {first, errc::invalid_argument};
  char* end = nullptr;
  errno = 0;
  const double read = strtod(number.c_str(), &end);
  if (end == number.c_str()) return {first, errc::invalid_argument};
  const char* after = first + (end - number.c_str());
  if (errno == ERANGE) return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}

}  // namespace std
#endif
