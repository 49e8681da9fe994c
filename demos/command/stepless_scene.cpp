#include "demos/command/stepless_scene.h"

#include <string>

#include "demos/language/scene_values.h"
#include "demos/motion/frame_clock.h"
#include "demos/system/exit_code.h"

namespace carom::demos {

void requireAStep(const SceneChoice& choice, const Scene& scene) {
  const FrameClock clock({.steps_per_second = scene.rate_hz});
  if (clock.stepCount(scene.duration_s) >= 1) return;
  const std::string what = "the duration of " + plainNumber(scene.duration_s) + " s holds no step at " +
                           plainNumber(scene.rate_hz) + " a second; accepted: at least half a step";
  if (choice.duration_s) throw UsageError(what);
  throw InputError(scene.file.string() + ": " + what);
}

}  // namespace carom::demos
