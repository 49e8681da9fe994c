// Loaded into the program by LD_PRELOAD: packing the rows of a PNG takes longer, by the share that
// CAROM_SLOWDOWN names (0.2: a fifth), as a slower libpng or ISA-L would. For
// tests/demos/budget_slowdown_test.cpp.
#include <chrono>
#include <cstdlib>

#include <dlfcn.h>
#include <png.h>

namespace {

using Clock = std::chrono::steady_clock;

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

double slowdown() {
  static const double share = [] {
    const char* text = std::getenv("CAROM_SLOWDOWN");
    return text == nullptr ? 0.0 : std::atof(text);
  }();
  return share;
}

/// Calls, and keeps the processor busy for the share of the time it took.
template <typename Call>
void slowly(const Call& call) {
  const Clock::time_point begin = Clock::now();
  call();
  const Clock::time_point end = Clock::now();
  const auto more = std::chrono::duration_cast<Clock::duration>(slowdown() * (end - begin));
  while (Clock::now() < end + more) continue;
}

}  // namespace

extern "C" void png_write_row(png_structrp png, png_const_bytep row) {
  static auto* const original = next<void(png_structrp, png_const_bytep)>("png_write_row");
  slowly([&] { original(png, row); });
}

extern "C" void png_write_end(png_structrp png, png_inforp info) {
  static auto* const original = next<void(png_structrp, png_inforp)>("png_write_end");
  slowly([&] { original(png, info); });
}

struct isal_zstream;
extern "C" int isal_deflate(isal_zstream* stream) {
  static auto* const original = next<int(isal_zstream*)>("isal_deflate");
  int outcome = 0;
  slowly([&] { outcome = original(stream); });
  return outcome;
}
