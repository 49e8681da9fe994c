// Loaded into the program by LD_PRELOAD: packing the rows of a PNG takes longer, by the share that
// CAROM_SLOWDOWN names (0.2: a fifth), as a slower libpng or ISA-L would. For
// tests/demos/program/budget_slowdown_test.cpp and tests/gate/timing_verdicts.py.
#include <cstdlib>
#include <ctime>

#include <dlfcn.h>
#include <png.h>

namespace {

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

/// Of this thread: what a busy machine takes from it is not made longer.
double cpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Calls, and keeps the processor busy for the share of the time it took. What a call is kept too long, by
/// one look at the clock at most, the next are kept less.
template <typename Call>
void slowly(const Call& call) {
  thread_local double owed_s = 0.0;
  const double begin_s = cpuSeconds();
  call();
  const double end_s = cpuSeconds();
  owed_s += slowdown() * (end_s - begin_s);
  if (owed_s <= 0.0) return;
  double now_s = end_s;
  while (now_s - end_s < owed_s) now_s = cpuSeconds();
  owed_s -= now_s - end_s;
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
