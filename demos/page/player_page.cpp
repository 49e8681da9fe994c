#include "demos/page/player_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "demos/asset/asset_path.h"
#include "demos/format/formatted.h"
#include "demos/format/json.h"
#include "demos/format/markup_text.h"
#include "demos/overlay/mode_colors.h"
#include "demos/page/web_source.h"
#include "demos/system/build_info.h"
#include "demos/system/exit_code.h"
#include "engine/motion/rigid_body.h"
#include "renderer/look/light.h"
#include "renderer/look/surface.h"
#include "renderer/view/solid_extent.h"

namespace carom::demos {
namespace {

constexpr double kCameraAspect = 16.0 / 9.0;
constexpr double kFovSteps = 4096.0;             // Of a degree.
constexpr double kDarkHorizon = 0.2;             // Linear; what is written over a darker sky is white.
constexpr std::size_t kLongestSource = 1 << 17;  // Bytes of a scene's text; a program's are longer.

Json numbers(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

/// "#rrggbb"
std::string hexColor(const renderer::Color& color) {
  const auto byte = [](float channel) { return static_cast<int>(std::lround(255.0f * channel)) & 0xff; };
  return formatted("#%02x%02x%02x", byte(color.r), byte(color.g), byte(color.b));
}

/// JSON has no infinity: null.
Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json waterJson(const Scene& scene) {
  Json water = Json::array();
  for (const NamedFluid& named : scene.fluids) {
    const Fluid& fluid = named.fluid;
    Json waves = Json::array();
    for (const Wave& wave : fluid.waves) {
      const double g = scene.gravity.norm();
      const double phase = wavePhase(wave, g, Vec2::Zero(), 0.0);
      const Vec2 k = (2.0 * std::numbers::pi / wave.wavelength_m) * wave.direction;
      waves.push(Json::object({{"height", wave.amplitude_m},
                               {"k", Json::array({k.x(), k.y()})},
                               {"phase", phase},
                               {"pace", wavePhase(wave, g, Vec2::Zero(), 1.0) - phase}}));
    }
    Json low = Json::array(), high = Json::array();
    for (Eigen::Index i = 0; i < 3; ++i) {
      low.push(finite(fluid.min[i]));
      high.push(finite(fluid.max[i]));
    }
    water.push(Json::object({{"name", named.name},
                             {"low", std::move(low)},
                             {"high", std::move(high)},
                             {"color", hexColor(named.color)},
                             {"waves", std::move(waves)}}));
  }
  return water;
}

Json modesJson() {
  Json modes = Json::array();
  for (std::size_t i = 0; i < kModes; ++i) {
    const auto mode = static_cast<Mode>(i);
    modes.push(Json::object({{"name", modeName(mode)}, {"color", hexColor(modeColor(mode))}}));
  }
  return modes;
}

/// Throws UsageError for more poses than a page, and this program's memory, are for.
void requireFits(const World& world, int frames) {
  const auto moving = std::count_if(world.bodies().begin(), world.bodies().end(),
                                    [](const BodyDescription& body) { return !body.is_static; });
  const double poses = static_cast<double>(moving) * frames;
  if (poses <= kMostPagePoses) return;
  throw UsageError(std::to_string(moving) + " bodies in " + std::to_string(frames) +
                   " frames do not fit into a page; accepted: at most " +
                   std::to_string(static_cast<long>(kMostPagePoses)) +
                   " poses, by a shorter --duration or fewer --fps");
}

/// GLSL without its comments and indentation, which are a third of it.
std::string bareText(std::string_view text) {
  std::string bare;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    line = line.substr(0, line.find("//"));
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string_view::npos)
      bare.append(line.substr(first, line.find_last_not_of(' ') + 1 - first)).push_back('\n');
    at = end + 1;
  }
  return bare;
}

std::string shaderElements() {
  constexpr std::string_view kEnding = ".glsl";
  std::string elements;
  for (const WebSource& source : playerSources()) {
    if (!source.name.ends_with(kEnding)) continue;
    const std::string_view name = source.name.substr(0, source.name.size() - kEnding.size());
    elements.append("<script type=\"text/plain\" id=\"glsl-").append(name).append("\">\n");
    elements.append(bareText(source.text)).append("</script>\n");
  }
  return elements;
}

/// The look of what a body is made of, or of the ground that it is; plain: empty.
std::string lookName(const SurfaceLook& look) {
  if (look.checker) return "ground " + renderer::nameOf(look.pattern);
  return look.surface == renderer::SurfaceKind::kPlain ? "" : renderer::nameOf(look.surface);
}

/// What the shaders of bodies with such a look have besides.
std::string lookLines(const SurfaceLook& look) {
  return look.checker ? "#define CHECKER\n" + renderer::shaderLines(look.pattern)
                      : renderer::shaderLines(look.surface);
}

Json looksJson(std::span<const SurfaceLook> looks) {
  Json lines = Json::object({});
  for (const SurfaceLook& look : looks)
    if (const std::string name = lookName(look); !name.empty()) lines.set(name, lookLines(look));
  return lines;
}

/// Of the coordinates in which the surface is drawn (renderer/glsl/surface.glsl).
Json finishJson(const renderer::Surface& surface, const Solid& drawn) {
  const renderer::SurfaceFrame frame = renderer::surfaceFrame(surface, renderer::solidExtent(drawn).half);
  return Json::array({1.0 / surface.scale_m, frame.axis, frame.number, renderer::isBall(drawn) ? 1 : 0});
}

/// A line a frame; one line where all are the same.
Json captionsJson(const std::vector<std::string>& captions) {
  Json lines = Json::array({});
  const bool same =
      std::adjacent_find(captions.begin(), captions.end(), std::not_equal_to<>()) == captions.end();
  for (std::size_t i = 0; i < (same ? std::min<std::size_t>(captions.size(), 1) : captions.size()); ++i)
    lines.push(captions[i]);
  return lines;
}

Json lightJson(const renderer::Light& light) {
  return Json::object({{"toSun", numbers(light.to_light)},
                       {"pool", light.pool},
                       {"dark", light.horizon.maxCoeff() < kDarkHorizon},
                       {"lines", renderer::shaderLines(light)}});
}

}  // namespace

std::vector<NamedCamera> pageCameras(const Scene& scene) {
  std::vector<NamedCamera> cameras{chosenCamera(scene, "")};
  for (const auto& [name, camera] : scene.cameras)
    if (name != cameras.front().name) cameras.push_back({name, camera});
  if (!scene.cameras.contains("fit")) cameras.push_back(chosenCamera(scene, "fit"));
  return cameras;
}

PlayerPage::PlayerPage(const Scene& scene, SceneWorld& made, PageChoice choice)
    : scene_(scene),
      made_(made),
      choice_(std::move(choice)),
      quanta_(pageQuanta(made.world)),
      shapes_(made, pictures_),
      ground_(pageGround(made)),
      motion_(made.world, quanta_),
      contacts_(made, {quanta_.contact_m, choice_.recorded, choice_.frames}),
      caption_(scene, made) {
  requireFits(made.world, choice_.frames);
  for (const auto& [name, camera] : pageCameras(scene))
    cameras_.push_back({name, CameraPath(camera, made, kCameraAspect), false, {}});
}

void PlayerPage::add(int frame, std::span<const BodyState> states) {
  const double time_s = frame / choice_.fps;
  motion_.add(states);
  contacts_.add(states, frame, time_s);
  if (!caption_.empty()) captions_.push_back(caption_.at(time_s, states));
  for (CameraTrack& track : cameras_) {
    track.frames.push_back(track.path.at(time_s, states));
    const renderer::Camera &first = track.frames.front(), &now = track.frames.back();
    track.moves = track.moves || first.eye != now.eye || first.target != now.target ||
                  first.fov_degrees != now.fov_degrees;
  }
}

// Eye, target and field of view, each of one number or of one a frame.
void PlayerPage::writeCameras(ByteStream& out) const {
  for (const CameraTrack& track : cameras_) {
    std::array<std::vector<std::int64_t>, 7> columns;
    const std::size_t count = track.moves ? track.frames.size() : 1;
    for (std::size_t f = 0; f < count; ++f) {
      const renderer::Camera& camera = track.frames[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        columns[i].push_back(std::llround(camera.eye[at] / quanta_.length_m));
        columns[3 + i].push_back(std::llround(camera.target[at] / quanta_.length_m));
      }
      columns[6].push_back(std::llround(kFovSteps * camera.fov_degrees));
    }
    for (const std::vector<std::int64_t>& column : columns) out.addColumn(column);
  }
}

Json PlayerPage::camerasJson() const {
  Json cameras = Json::array();
  for (const CameraTrack& track : cameras_)
    cameras.push(Json::object({{"name", track.name}, {"moves", track.moves}}));
  return cameras;
}

Json PlayerPage::bodiesJson() const {
  Json bodies = Json::array();
  for (std::size_t i = 0; i < made_.names.size(); ++i) {
    const BodyDescription& description = made_.world.bodies()[i];
    const Solid& solid = made_.world.solids()[static_cast<std::size_t>(description.solid)];
    const Solid& drawn = made_.drawn(i);
    const SurfaceLook& look = made_.looks[i];
    const PlacedMesh& mesh = shapes_.of(i);
    Json body = Json::object({{"name", made_.names[i]},
                              {"mesh", mesh.mesh},
                              {"low", numbers(mesh.low)},
                              {"high", numbers(mesh.high)},
                              {"radius", made_.drawnRadius(i)},
                              {"color", hexColor(look.color)}});
    if (look.checker) body.set("checker", true);
    body.set("look", lookName(look));
    body.set("finish", finishJson(made_.surfaces[i], drawn));
    if (!made_.looksOtherwise(i) && solid.parts().size() == 1) body.set("boxy", true);
    if (!look.material.empty()) body.set("material", look.material);
    if (description.is_static) body.set("static", true);
    if (description.is_kinematic) body.set("kinematic", true);
    if (!description.is_static && !description.is_kinematic) {
      const double mass = made_.world.mass(static_cast<int>(i));
      const Inertia inertia = inertiaOf(mass / solid.volume(), solid.volume(), solid.unitInertia());
      const Mat3& I = inertia.tensor_B;
      body.set("mass", mass);
      body.set("inertia", Json::array({I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)}));
    }
    bodies.push(std::move(body));
  }
  return bodies;
}

Json PlayerPage::sceneJson() const {
  std::string source = readTextFile(scene_.file);
  if (source.size() > kLongestSource) source.clear();
  return Json::object({{"name", scene_.name},
                       {"description", scene_.description},
                       {"lookFor", scene_.look_for},
                       {"group", scene_.group},
                       {"file", scene_.file.filename().string()},
                       {"command", choice_.command},
                       {"index", choice_.index},
                       {"rate", scene_.rate_hz},
                       {"seed", static_cast<double>(scene_.seed)},
                       {"source", std::move(source)}});
}

Json PlayerPage::factsJson() const {
  Json facts = Json::object({{"format", 1},
                             {"program", "carom " + programVersion()},
                             {"scene", sceneJson()},
                             {"fps", choice_.fps},
                             {"frames", choice_.frames},
                             {"gravity", numbers(scene_.gravity)},
                             {"impulses", !choice_.recorded},
                             {"leftOut", static_cast<double>(contacts_.leftOut())},
                             {"quanta", Json::object({{"length", quanta_.length_m},
                                                      {"contact", quanta_.contact_m},
                                                      {"quaternion", quanta_.quaternion},
                                                      {"speed", quanta_.speed_mps},
                                                      {"spin", quanta_.spin_radps},
                                                      {"fov", 1.0 / kFovSteps}})},
                             {"light", lightJson(scene_.light.light)},
                             {"looks", looksJson(made_.looks)},
                             {"captions", captionsJson(captions_)},
                             {"modes", modesJson()},
                             {"water", waterJson(scene_)},
                             {"cameras", camerasJson()},
                             {"bodies", bodiesJson()}});
  if (ground_) facts.set("ground", Json::object({{"body", ground_->body}, {"z", ground_->z_m}}));
  return facts;
}

std::string PlayerPage::html() const {
  REQUIRE(motion_.frames() == choice_.frames, motion_.frames(), choice_.frames);
  ByteStream data;
  data.addText(factsJson().text());
  shapes_.write(data);
  pictures_.write(data);
  motion_.write(data);
  writeCameras(data);
  contacts_.write(data);
  const std::vector<WebSource>& web = playerSources();
  return withParts(
      textOf(web, "player.html"),
      {{"<!--DESCRIPTION-->", markupText(scene_.description)},
       {"<!--TITLE-->", markupText(scene_.name)},
       {"/*STYLE*/", std::string(textOf(web, "player.css"))},
       {"<!--SHADERS-->", shaderElements()},
       {"<!--DATA-->", packedBase64(data.bytes())},
       {"/*SCRIPT*/",
        bundledScript(web, {"geometry.js", "stream.js", "pictures.js", "contacts.js", "recording.js",
                            "program.js", "offscreen.js", "sunlight.js", "water.js", "graphics.js", "view.js",
                            "link.js", "overlays.js", "facts.js", "player.js"})}});
}

}  // namespace carom::demos
