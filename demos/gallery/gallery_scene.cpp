#include "demos/gallery/gallery_scene.h"

#include <algorithm>
#include <cmath>

#include "demos/format/content_hash.h"
#include "demos/frames/picture_settings.h"
#include "demos/motion/frame_source.h"
#include "demos/page/player_page.h"
#include "demos/scene/drawn_water.h"
#include "demos/system/atomic_file.h"
#include "demos/video/small_animation.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {
namespace {

constexpr double kPageFps = 60.0;
constexpr const char* kRest = "more";  // The group of scenes that name none.

int movingBodies(const SceneWorld& made) {
  return static_cast<int>(std::count_if(made.world.bodies().begin(), made.world.bodies().end(),
                                        [](const BodyDescription& body) { return !body.is_static; }));
}

/// Which of the page's frames are drawn: at twice the picture's rate, whose half is the best that it has.
std::vector<int> drawnFrames(const GalleryShape& shape, double page_fps, int frames) {
  std::vector<int> drawn;
  for (int i = 0;; ++i) {
    const double time_s = i / (2.0 * shape.fps);
    const int frame = static_cast<int>(std::lround(time_s * page_fps));
    if (frame >= frames || time_s > kLongestPicture_s) return drawn;
    drawn.push_back(frame);
  }
}

template <typename Bytes>
GalleryFile written(const GalleryShape& shape, const std::string& name, const Bytes& bytes) {
  AtomicFile file(shape.folder / name);
  file.write(bytes);
  file.commit();
  ContentHash hash;
  hash.add(std::string(bytes.begin(), bytes.end()));
  return {name, hash.value(), static_cast<std::int64_t>(bytes.size())};
}

GalleryEntry emptyEntry(const Scene& scene, const SceneChoice& choice, const GalleryShape& shape) {
  GalleryEntry entry;
  entry.name = scene.name;
  entry.identity = galleryIdentity(scene, shape);
  entry.group = scene.group.empty() ? kRest : scene.group;
  entry.description = scene.description;
  entry.look_for = scene.look_for;
  entry.command = "carom render " + std::filesystem::path(choice.scene).filename().string();
  entry.duration_s = scene.duration_s;
  return entry;
}

}  // namespace

GalleryEntry makeGalleryScene(const SceneChoice& choice, const GalleryShape& shape) {
  const Scene scene = chosenScene(choice);
  GalleryEntry entry = emptyEntry(scene, choice, shape);
  SceneWorld made = makeSceneWorld(scene, choice.mesh, 1);
  entry.bodies = movingBodies(made);
  const double fps = entry.bodies > kManyBodies ? 0.5 * kPageFps : kPageFps;
  const FrameClock clock({fps, scene.rate_hz});
  const int frames = std::max(1, clock.frameCount(scene.duration_s));
  const std::string command =
      "carom export " + std::filesystem::path(choice.scene).filename().string() + " " + scene.name + ".html";
  PlayerPage page(
      scene, made,
      {.fps = fps, .frames = frames, .recorded = false, .command = command, .index = "../index.html"});

  renderer::Settings settings = pictureSettings(scene.light, {shape.width, shape.height, shape.gl});
  settings.gl_threads = 1;
  renderer::FrameRenderer pictures(settings, made.drawnSolids());
  const CameraPath camera(chosenCamera(scene, "").camera, made,
                          static_cast<double>(shape.width) / shape.height);
  const std::vector<int> drawn = drawnFrames(shape, fps, frames);
  std::vector<renderer::Image> images;
  RunFacts facts;
  FrameSource source(made, clock, facts);
  for (int frame = 0; frame < frames; ++frame) {
    const FrameState state = source.at(frame);
    page.add(frame, state.bodies);
    if (!std::binary_search(drawn.begin(), drawn.end(), frame)) continue;
    const double time_s = clock.time(frame);
    images.push_back(pictures.draw(drawnInstances(made, state.bodies), camera.at(time_s, state.bodies), {},
                                   drawnWater(scene, time_s)));
  }
  const SmallAnimation animation = smallAnimation(images, shape.fps, kMostPictureBytes);
  entry.width = animation.width;
  entry.height = animation.height;
  entry.files = {written(shape, galleryPage(scene.name), page.html()),
                 written(shape, galleryPicture(scene.name), animation.moving),
                 written(shape, galleryStill(scene.name), animation.still)};
  return entry;
}

}  // namespace carom::demos
