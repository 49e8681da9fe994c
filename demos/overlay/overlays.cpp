#include "demos/overlay/overlays.h"

#include <algorithm>
#include <cmath>

#include "demos/format/progress.h"
#include "demos/overlay/contact_overlays.h"
#include "demos/overlay/feature_overlays.h"
#include "demos/overlay/mode_colors.h"
#include "demos/overlay/motion_overlays.h"
#include "demos/overlay/panel_overlays.h"

namespace carom::demos {
namespace {

// Those that stand in the world, in the order in which they cover each other.
struct WorldOverlay {
  Overlay overlay;
  void (*paint)(renderer::OverlayPainter&, const OverlayFrame&, const Pen&);
};
constexpr WorldOverlay kWorldOverlays[] = {
    {Overlay::kBounds, paintBounds},     {Overlay::kPairs, paintCandidates},
    {Overlay::kRegions, paintRegions},   {Overlay::kSupport, paintSupports},
    {Overlay::kTrails, paintTrails},     {Overlay::kManifold, paintManifolds},
    {Overlay::kClosest, paintClosest},   {Overlay::kNormals, paintNormals},
    {Overlay::kImpulses, paintImpulses}, {Overlay::kVelocities, paintVelocities},
    {Overlay::kWindow, paintWindows},    {Overlay::kDistance, paintDistances},
    {Overlay::kLabels, paintLabels},
};

}  // namespace

Overlays::Overlays(const Choice& choice, SceneWorld& scene, const FrameClock& clock)
    : choice_(choice), scene_(scene), clock_(clock), focus_(choice.focus, scene.names) {
  if (choice_.recorded) requireRecordable(choice_.shown);
  if (choice_.shown.has(Overlay::kTimings)) watch_ = std::make_unique<PhaseStopwatch>(steadySeconds, false);
  if (any() && !choice_.recorded) scene_.world.watch(&step_);
}

Overlays::~Overlays() {
  if (any() && !choice_.recorded) scene_.world.watch(nullptr);
}

std::string Overlays::identity() const {
  if (!any()) return "";
  return choice_.shown.text() + (choice_.focus.empty() ? "" : " of " + choice_.focus);
}

void Overlays::follow(const FrameState& state, int frame) {
  followed_ = frame;
  // The world may stand at the end of a step that the frame's instant lies in: what comes later is kept.
  const double time_s = clock_.time(frame);
  const auto later = std::stable_partition(step_.collisions.begin(), step_.collisions.end(),
                                           [&](const ContactView& c) { return c.time_s <= time_s; });
  collisions_.assign(step_.collisions.begin(), later);
  step_.collisions.erase(step_.collisions.begin(), later);
  std::vector<Vec3> positions;
  for (const BodyState& body : state.bodies) positions.push_back(body.X_WB.position);
  positions_.push_back(std::move(positions));
  const auto most = static_cast<std::size_t>(std::lround(kTrailTime_s * clock_.fps())) + 1;
  while (positions_.size() > most) positions_.pop_front();
}

void Overlays::beginTiming(int frame) {
  if (!watch_) return;
  endTiming();  // a frame that was kept, not drawn
  watch_->beginFrame(frame);
  timing_ = true;
}

FrameCost Overlays::endTiming() {
  FrameCost cost;
  if (timing_) watch_->endFrame(cost);
  timing_ = false;
  return cost;
}

FrameState Overlays::advance(FrameSource& source, int frame) {
  if (!any()) return source.at(frame);
  beginTiming(frame);
  while (followed_ < frame - 1) follow(source.at(followed_ + 1), followed_ + 1);
  const FrameState state = source.at(frame);
  if (followed_ < frame) follow(state, frame);
  return state;
}

void Overlays::recolor(std::span<const BodyState> bodies, std::vector<renderer::Instance>& instances) const {
  if (!choice_.shown.has(Overlay::kModes)) return;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!instances[i].checker) instances[i].color = modeColor(bodies[i].mode);
}

OverlayFrame Overlays::frameOf(const FrameState& state, int frame) const {
  OverlayFrame of{scene_, focus_, state.bodies, frame, clock_.time(frame), {}, nullptr, collisions_, {}, {}};
  of.pairs = nearPairs(scene_.world, state.bodies, focus_);
  if (!choice_.recorded) of.step = &step_;
  of.trails.resize(state.bodies.size());
  if (choice_.shown.has(Overlay::kTrails))
    for (const std::vector<Vec3>& positions : positions_)
      for (std::size_t i = 0; i < positions.size(); ++i) of.trails[i].push_back(positions[i]);
  return of;
}

renderer::Image Overlays::draw(renderer::FrameRenderer& pictures, const FrameState& state, int frame,
                               const renderer::Camera& camera, std::span<const renderer::WaterVolume> water) {
  std::vector<renderer::Instance> instances = drawnInstances(scene_, state.bodies);
  if (!any()) return pictures.draw(instances, camera, {}, water);
  recolor(state.bodies, instances);
  if (watch_) watch_->begin(FramePhase::kDraw);
  const renderer::Image& picture = pictures.draw(instances, camera, {}, water);
  if (watch_) watch_->end();
  OverlayFrame of = frameOf(state, frame);
  of.cost = endTiming();
  return paint(picture, pictures.depth(), of, camera);
}

renderer::Image Overlays::paint(const renderer::Image& image, const renderer::DepthImage& depth,
                                const OverlayFrame& frame, const renderer::Camera& camera) const {
  renderer::Canvas canvas(image);
  renderer::OverlayPainter painter(canvas, camera, depth);
  const Pen pen(image.height);
  std::vector<Panel> panels;
  if (choice_.shown.has(Overlay::kStatistics)) panels.push_back(statisticsPanel(frame));
  if (choice_.shown.has(Overlay::kModes)) panels.push_back(legendPanel(frame));
  if (choice_.shown.has(Overlay::kTimings)) panels.push_back(timingsPanel(frame));
  const std::vector<renderer::PixelRect> rects = placedPanels(canvas, panels, pen);
  for (const renderer::PixelRect& rect : rects) painter.reserve(rect);
  for (const WorldOverlay& overlay : kWorldOverlays)
    if (choice_.shown.has(overlay.overlay)) overlay.paint(painter, frame, pen);
  for (std::size_t i = 0; i < panels.size(); ++i) paintPanel(canvas, panels[i], rects[i], pen);
  return canvas.image();
}

}  // namespace carom::demos
