#include "engine/simulation/bodies/active_bodies.h"

#include <algorithm>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"

namespace carom {

void ActiveBodies::beginStep(std::vector<Body>& bodies) {
  std::erase_if(active_, [&](int i) {
    Body& body = bodies[at(i)];
    body.active = body.travels() || !body.lay;
    body.lay = !body.travels();
    return !body.active;
  });
}

std::span<const int> ActiveBodies::wakeIsland(std::vector<Body>& bodies, int body) {
  REQUIRE(bodies[at(body)].resting, body);
  woken_.clear();
  const auto before = static_cast<std::ptrdiff_t>(active_.size());
  for (int i = body; bodies[at(i)].resting; i = bodies[at(i)].next_at_rest) {
    woken_.push_back(i);
    wake(bodies[at(i)]);
    if (bodies[at(i)].active) continue;
    bodies[at(i)].active = true;
    active_.push_back(i);
  }
  std::sort(active_.begin() + before, active_.end());
  std::inplace_merge(active_.begin(), active_.begin() + before, active_.end());
  return woken_;
}

}  // namespace carom
