// The libraries side by side. Which peers there are was decided by tests/bench/CMakeLists.txt.

#include "tests/bench/peers/library.h"

namespace carom::bench {

Library caromLibrary();
Library fclLibrary();
Library bulletLibrary();
Library odeLibrary();

std::vector<Library> libraries() {
  std::vector<Library> all{caromLibrary()};
#ifdef CAROM_BENCH_FCL
  all.push_back(fclLibrary());
#endif
#ifdef CAROM_BENCH_BULLET
  all.push_back(bulletLibrary());
#endif
#ifdef CAROM_BENCH_ODE
  all.push_back(odeLibrary());
#endif
  return all;
}

}  // namespace carom::bench
