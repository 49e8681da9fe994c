#include "demos/record/motion_recorder.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "demos/cause/source_prints.h"
#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "demos/system/atomic_file.h"
#include "demos/system/build_info.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

std::string numberText(double value) {
  return formatted("%.9g", value);
}

std::string vectorText(const Vec3& v) {
  return formatted("%.9g %.9g %.9g", v.x(), v.y(), v.z());
}

std::string rotationText(const Quat& q) {
  return numberText(q.w()) + ' ' + vectorText(q.vec());
}

std::string colorText(const renderer::Color& c) {
  return formatted("#%02x%02x%02x", static_cast<int>(255.0f * c.r + 0.5f) & 0xff,
                   static_cast<int>(255.0f * c.g + 0.5f) & 0xff,
                   static_cast<int>(255.0f * c.b + 0.5f) & 0xff);
}

/// Of all that a solid's drawing and colliding depend on.
std::string shapePrint(const Solid& solid) {
  ContentHash hash;
  for (const ConvexPart& part : solid.parts()) {
    hash.add(&part.radius_m, sizeof part.radius_m);
    for (const Vec3& vertex : part.core.vertices()) hash.add(vertex.data(), 3 * sizeof(double));
    for (int f = 0; f < part.core.faceCount(); ++f) {
      const std::span<const int> loop = part.core.faceVertices(f);
      hash.add(loop.data(), loop.size() * sizeof(int));
    }
  }
  return hexText(hash.value()).substr(8);
}

/// What is as usual is left out, as records from before it could be otherwise do.
Facts lookOf(const SurfaceLook& look, const renderer::Surface& surface) {
  Facts facts = {{"color", colorText(look.color)}, {"checker", look.checker ? "true" : "false"}};
  if (look.checker && look.pattern != renderer::GroundPattern::kChecker)
    facts.emplace_back("ground", nameOf(look.pattern));
  if (surface.kind == renderer::SurfaceKind::kPlain) return facts;
  facts.emplace_back("surface", nameOf(surface.kind));
  facts.emplace_back("surface scale", numberText(surface.scale_m));
  return facts;
}

RecordedBody recordedBody(const SceneWorld& made, std::size_t i) {
  const BodyDescription& body = made.world.bodies()[i];
  const Solid& solid = made.world.solids()[static_cast<std::size_t>(body.solid)];
  const BodyState& start = made.world.states()[i];
  const Material& m = body.material;
  RecordedBody recorded;
  recorded.name = made.names[i];
  recorded.motion = {{"position", vectorText(start.X_WB.position)},
                     {"rotation", rotationText(start.X_WB.rotation)},
                     {"velocity", vectorText(start.linear_velocity)},
                     {"angular velocity", vectorText(start.angular_velocity)},
                     {"static", body.is_static ? "true" : "false"}};
  recorded.stuff = {{"static friction", numberText(m.static_friction)},
                    {"dynamic friction", numberText(m.dynamic_friction)},
                    {"restitution", numberText(m.restitution)},
                    {"density", numberText(m.density_kgpm3)},
                    {"rolling resistance", numberText(m.rolling_resistance_m)},
                    {"spinning resistance", numberText(m.spinning_resistance_m)},
                    {"drag coefficient", m.drag_coefficient ? numberText(*m.drag_coefficient) : "standard"}};
  recorded.shape = {{"volume", numberText(solid.volume())},
                    {"radius", numberText(solid.radius())},
                    {"geometry", shapePrint(solid)}};
  recorded.look = lookOf(made.looks[i], made.surfaces[i]);
  return recorded;
}

std::string fluidText(const Fluid& f) {
  std::string text = "from " + vectorText(f.min) + " to " + vectorText(f.max) + ", density " +
                     numberText(f.density_kgpm3) + ", drag " + numberText(f.drag) + " and " +
                     numberText(f.linear_drag_mps) + ", flow " + vectorText(f.flow) + ", added mass " +
                     numberText(f.added_mass);
  for (const Wave& w : f.waves)
    text += ", wave " + numberText(w.amplitude_m) + ' ' + numberText(w.wavelength_m) + ' ' +
            numberText(w.direction.x()) + ' ' + numberText(w.direction.y()) + ' ' + numberText(w.period_s) +
            ' ' + numberText(w.phase);
  return text;
}

Facts worldFacts(const Scene& scene) {
  Facts facts = {
      {"gravity", vectorText(scene.gravity)},
      {"step rate", numberText(scene.rate_hz)},
      {"air", "density " + numberText(scene.air.density_kgpm3) + ", wind " + vectorText(scene.air.wind) +
                  ", skin friction " + numberText(scene.air.skin_friction)}};
  for (const NamedFluid& fluid : scene.fluids) facts.emplace_back(fluid.name, fluidText(fluid.fluid));
  return facts;
}

/// But for its direction, what is not that of the usual light.
void addLight(const renderer::Light& light, Facts& facts) {
  const renderer::Light usual;
  const auto add = [&](const char* name, const Vec3& value, const Vec3& known) {
    if (value != known) facts.emplace_back(std::string("light of the ") + name, vectorText(value));
  };
  add("sun", light.sun, usual.sun);
  add("sky", light.sky_light, usual.sky_light);
  add("ground", light.ground_light, usual.ground_light);
  add("horizon", light.horizon, usual.horizon);
  add("zenith", light.zenith, usual.zenith);
  if (light.exposure != usual.exposure) facts.emplace_back("light's exposure", numberText(light.exposure));
  if (light.softness != usual.softness) facts.emplace_back("light's softness", numberText(light.softness));
}

Facts lookFacts(const Scene& scene, const renderer::Settings& s) {
  Facts facts = {{"size", std::to_string(s.width) + "x" + std::to_string(s.height)},
                 {"light", vectorText(s.light.to_light)},
                 {"preset", nameOf(s.preset)},
                 {"style", nameOf(s.style)},
                 {"pixels", s.pixels == renderer::PixelPolicy::kPortable ? "portable" : "of this CPU"}};
  addLight(s.light, facts);
  if (s.cutout) facts.emplace_back("background", "none");
  for (const NamedFluid& fluid : scene.fluids)
    facts.emplace_back("color of " + fluid.name, colorText(fluid.color));
  return facts;
}

/// A ten-thousandth of the smallest body that moves, as a power of two: no rounding of its own.
double lengthQuantum(const World& world) {
  double smallest = 1.0;
  bool any = false;
  for (const BodyDescription& body : world.bodies()) {
    const double radius = world.solids()[static_cast<std::size_t>(body.solid)].radius();
    if (!body.is_static && (!any || radius < smallest)) {
      smallest = radius;
      any = true;
    }
  }
  return std::exp2(std::floor(std::log2(1e-4 * smallest)));
}

/// The impulses of all contacts of two bodies, by their indices.
std::map<std::pair<int, int>, double> touchesOf(const std::vector<ContactView>& contacts) {
  std::map<std::pair<int, int>, Vec3> sums;
  for (const ContactView& c : contacts) {
    const bool in_order = c.body_a < c.body_b;
    const auto pair = in_order ? std::pair(c.body_a, c.body_b) : std::pair(c.body_b, c.body_a);
    const auto at = sums.try_emplace(pair, Vec3::Zero()).first;
    at->second += in_order ? c.impulse_W : Vec3(-c.impulse_W);
  }
  std::map<std::pair<int, int>, double> touches;
  for (const auto& [pair, sum] : sums) touches[pair] = sum.norm();
  return touches;
}

/// None where there is none, or none that can be read.
std::optional<MotionRecord> recordIn(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / kRecordName, ignored)) return std::nullopt;
  try {
    return readRecord(folder / kRecordName);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

MotionRecorder::MotionRecorder(const Scene& scene, SceneWorld& made, const renderer::Settings& settings)
    : made_(made) {
  record_.scene = scene.name;
  record_.world = worldFacts(scene);
  record_.look = lookFacts(scene, settings);
  record_.sources = sourcePrints();
  record_.step_s = 1.0 / scene.rate_hz;
  record_.length_quantum_m = lengthQuantum(made.world);
  for (std::size_t i = 0; i < made.names.size(); ++i) record_.bodies.push_back(recordedBody(made, i));
  made.world.watch(&view_);
  addPrint(made.world);
  addMoment(made.world);
}

MotionRecorder::~MotionRecorder() {
  made_.world.watch(nullptr);
}

std::vector<RoundedPose> MotionRecorder::posesOf(std::span<const BodyState> states) const {
  std::vector<RoundedPose> poses;
  for (const BodyState& state : states) poses.push_back(roundedPose(state.X_WB, record_.length_quantum_m));
  return poses;
}

void MotionRecorder::addPrint(const World& world) {
  if (world.stepCount() % record_.print_stride != 0) return;
  record_.prints.push_back(static_cast<std::uint32_t>(world.stateHash()));
  if (record_.prints.size() <= kMostPrints) return;
  for (std::size_t i = 1; 2 * i < record_.prints.size(); ++i) record_.prints[i] = record_.prints[2 * i];
  record_.prints.resize((record_.prints.size() + 1) / 2);
  record_.print_stride *= 2;
}

void MotionRecorder::addMoment(const World& world) {
  if (world.stepCount() % moment_stride_ != 0) return;
  RecordedMoment moment{world.stepCount(), world.time(), posesOf(world.states()), {}};
  for (const auto& [pair, impulse] : touchesOf(view_.lasting))
    moment.touches.push_back({pair.first, pair.second, impulse});
  record_.moments.push_back(std::move(moment));
  if (record_.moments.size() < 4 || record_.moments.size() * made_.names.size() <= kMostPoses) return;
  std::vector<RecordedMoment> kept;
  for (std::size_t i = 0; i < record_.moments.size(); i += 2) kept.push_back(std::move(record_.moments[i]));
  record_.moments = std::move(kept);
  moment_stride_ *= 2;
}

void MotionRecorder::follow(const World& world) {
  addPrint(world);
  addMoment(world);
  for (const ContactView& c : view_.collisions)
    if (record_.strikes.size() < kMostStrikes)
      record_.strikes.push_back({world.stepCount(), c.time_s, c.body_a, c.body_b, c.impulse_W.norm()});
  view_.collisions.clear();
}

void MotionRecorder::addShot(const ShotFile& file, double time_s, const FrameState& state,
                             const renderer::Camera& camera) {
  record_.shots.push_back(
      {file.name, time_s, state.state_hash, camera, posesOf(state.bodies), 0, 0, {}, textPrint(file.text)});
}

void MotionRecorder::recall(const std::filesystem::path& folder) {
  former_ = recordIn(folder);
}

bool MotionRecorder::recallPixels(int width, int height) {
  if (!former_) return false;
  RecordedShot& shot = record_.shots.back();
  for (const RecordedShot& was : former_->shots) {
    const bool same = was.file == shot.file && was.state_hash == shot.state_hash &&
                      was.text_print == shot.text_print && was.width == width && was.height == height;
    if (!same || was.bodies.empty()) continue;
    shot.width = width;
    shot.height = height;
    shot.bodies = was.bodies;
    pixels_ += was.bodies.size();
    return true;
  }
  return false;
}

bool MotionRecorder::wantsPixels(int width, int height) const {
  return pixels_ + static_cast<std::size_t>(width) * static_cast<std::size_t>(height) <= kMostPixels;
}

void MotionRecorder::addPixels(const renderer::SurfaceImage& surfaces, int width, int height) {
  RecordedShot& shot = record_.shots.back();
  shot.width = width;
  shot.height = height;
  shot.bodies = surfaces.instance;
  pixels_ += surfaces.instance.size();
}

void MotionRecorder::write(const std::filesystem::path& folder, const renderer::ContextInfo& gl) {
  MotionRecord record = record_;
  record.look.emplace_back("renderer", gl.renderer + ", " + gl.version);
  record.look.emplace_back("program", "carom " + programVersion() + ", " + buildName());
  AtomicFile file(folder / kRecordName);
  file.write(recordBytes(record));
  file.commit();
}

bool recordIsOfOthers(const std::filesystem::path& folder, const std::set<std::string>& files) {
  const std::optional<MotionRecord> record = recordIn(folder);
  if (!record) return false;
  return std::any_of(record->shots.begin(), record->shots.end(), [&](const RecordedShot& shot) {
    return !files.contains(shot.file) && shot.isOf(renderer::readPngText(folder / shot.file));
  });
}

}  // namespace carom::demos
