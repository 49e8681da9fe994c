#include "demos/compare/cause.h"

#include <algorithm>

#include "demos/cause/picture_evidence.h"
#include "demos/compare/picture_mask.h"
#include "demos/compare/record_changes.h"
#include "demos/compare/record_motion.h"
#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::size_t kMostChanges = 40;  // a wholly other world is not told body by body

std::string joined(const std::vector<Change>& changes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(changes.size(), kMostNamed); ++i)
    text += (i == 0 ? "" : "; ") + changes[i].text;
  if (changes.size() > kMostNamed) text += "; and " + std::to_string(changes.size() - kMostNamed) + " more";
  return text;
}

void append(std::vector<Change>& changes, const std::vector<Change>& more) {
  for (const Change& c : more)
    if (changes.size() < kMostChanges) changes.push_back(c);
}

bool onlyProgram(const std::vector<Change>& look) {
  return std::all_of(look.begin(), look.end(),
                     [](const Change& c) { return c.part == "renderer" || c.part == "program"; });
}

/// Whether the frames' files name two versions of the scene. What of it no record knows (forces, locked axes,
/// paths, meshes and pictures that are drawn) may then have changed.
bool isEdited(const RecordedPicture& actual, const RecordedPicture& golden) {
  return !actual.scene.empty() && !golden.scene.empty() && actual.scene != golden.scene;
}

/// The states differ, and nothing that the records know of the world does.
void blameUnknown(const RecordedPicture& actual, const RecordedPicture& golden, int step, Cause& cause) {
  const bool edited = isEdited(actual, golden);
  cause.headline = edited ? "physics moved: the scene was edited" : "physics moved: the same scene";
  if (edited) cause.changes.push_back({"scene", actual.record.scene, "the scene was edited"});
  if (step >= 0)
    cause.headline += ", other states from step " + std::to_string(step) + " (" +
                      formatted("%.3g", cause.since_s) + " s) on";
  const std::vector<Change> sources = changedSources(actual.record, golden.record, true);
  cause.headline += sources.empty() ? "" : "; " + joined(sources);
  append(cause.changes, sources);
  if (sources.empty() && !edited)
    cause.changes.push_back({"engine", "engine", "the same sources of the engine, other states"});
}

/// The states differ.
void blameMotion(const RecordedPicture& actual, const RecordedPicture& golden, const Differences& found,
                 Cause& cause) {
  const int step = firstDifferentStep(actual.record, golden.record);
  if (step >= 0) cause.since_s = step * actual.record.step_s;
  cause.first_event = firstEvent(actual.record, golden.record, actual.shot.time_s);
  cause.moved = movedBodies(actual, golden);
  if (!found.world.empty()) {
    cause.headline = "physics moved: " + joined(found.world);
    append(cause.changes, found.world);
  } else {
    blameUnknown(actual, golden, step, cause);
  }
  if (!onlyProgram(found.look)) cause.headline += "; also " + found.look.front().text;
  append(cause.changes, found.look);
}

/// The states are the same.
void blamePicture(const RecordedPicture& actual, const RecordedPicture& golden, const Differences& found,
                  Cause& cause) {
  std::vector<Change> world;  // what shows without moving: shapes, bodies that came or went
  for (const Change& c : found.world)
    if (c.part == "mesh" || c.part == "body") world.push_back(c);
  append(cause.changes, world);
  if (!onlyProgram(found.look) || !world.empty()) {
    append(cause.changes, found.look);
    cause.headline = "the same motion, another look: " + joined(cause.changes);
    return;
  }
  const std::vector<Change> sources = changedSources(actual.record, golden.record, false);
  if (isEdited(actual, golden)) {
    cause.headline = "the same motion, another look: the scene was edited";
    if (!sources.empty()) cause.headline += "; " + joined(sources);
    cause.changes.push_back({"scene", actual.record.scene, "the scene was edited"});
    append(cause.changes, sources);
    append(cause.changes, found.look);
    return;
  }
  append(cause.changes, sources);
  append(cause.changes, found.look);
  cause.headline = "the renderer changed: the same states and look";
  if (!cause.changes.empty()) cause.headline += "; " + joined(cause.changes);
  if (cause.changes.empty())
    cause.changes.push_back({"renderer", "renderer", "the same sources, other pixels"});
}

Cause causeAtShots(const RecordedPicture& actual, const RecordedPicture& golden) {
  Cause cause;
  if (actual.record.scene != golden.record.scene) {
    cause.headline = "another scene: " + actual.record.scene + ", was " + golden.record.scene;
    cause.changes.push_back({"scene", actual.record.scene, cause.headline});
    return cause;
  }
  if (actual.shot.time_s != golden.shot.time_s) {
    cause.headline = "another moment: " + formatted("%.3g", actual.shot.time_s) + " s, was " +
                     formatted("%.3g", golden.shot.time_s) + " s";
    cause.changes.push_back({"moment", actual.shot.file, cause.headline});
  }
  const Differences found = differencesOf(actual, golden);
  if (!cause.changes.empty()) {
    append(cause.changes, found.world);
    append(cause.changes, found.look);
    return cause;
  }
  // Prints of states of other numbers of bodies or steps differ even where what is drawn does not.
  if (actual.shot.state_hash != golden.shot.state_hash)
    blameMotion(actual, golden, found, cause);
  else
    blamePicture(actual, golden, found, cause);
  return cause;
}

/// Whether the pixels are those that the frame's text signs; true where it signs none.
bool isAsDrawn(const renderer::DecodedRaster& frame) {
  const std::string signature = textOf(frame.text, "Pixels");
  if (signature.empty()) return true;
  ContentHash hash;
  const std::vector<std::uint16_t>& samples = frame.raster.samples;
  if (frame.raster.bits == 16) {
    hash.add(samples.data(), samples.size() * sizeof(std::uint16_t));
  } else {
    const std::vector<std::uint8_t> bytes(samples.begin(), samples.end());
    hash.add(bytes.data(), bytes.size());
  }
  return hexText(hash.value()) == signature;
}

/// What frames' texts say of the look, and what it is where they do not (frames/frame_identity.cpp).
struct LookOfFrame {
  const char* key;
  const char* unsaid;
};
constexpr LookOfFrame kLooks[] = {{"Preset", "the usual one"},
                                  {"Style", "the usual one"},
                                  {"Light", "the usual one"},
                                  {"Shutter", "the usual one"},
                                  {"Background", "the usual one"},
                                  {"Overlays", "the usual one"},
                                  {"Caption", "off"},
                                  {"Portable", "yes"}};

Cause single(const std::string& part, const std::string& name, const std::string& text) {
  return {text, {{part, name, text}}, -1.0, "", {}, {}, ""};
}

}  // namespace

Cause causeByText(const renderer::DecodedRaster& actual, const renderer::DecodedRaster& golden) {
  for (const auto& [frame, which] : {std::pair(&actual, "actual"), std::pair(&golden, "golden")})
    if (!isAsDrawn(*frame))
      return single(
          "encoder", which,
          std::string("the pixels of the ") + which +
              " frame are not those that its text signs: the file was changed after it was drawn, or "
              "packed wrongly");
  const auto differs = [&](const char* key) {
    const std::string a = textOf(actual.text, key), g = textOf(golden.text, key);
    return !a.empty() && !g.empty() && a != g;
  };
  const auto change = [&](const char* key) {
    return textOf(golden.text, key) + " became " + textOf(actual.text, key);
  };
  // "sliding 0123456789abcdef"
  const auto scene = [](const renderer::PngText& text) {
    const std::string whole = textOf(text, "Scene");
    return whole.substr(0, whole.rfind(' '));
  };
  if (differs("Scene")) {
    const std::string a = scene(actual.text), g = scene(golden.text);
    if (a != g) return single("scene", a, "another scene: " + a + ", was " + g);
    return single("scene", a, "the scene was edited");
  }
  if (differs("Camera"))
    return single("camera", textOf(actual.text, "Camera"), "another camera: " + change("Camera"));
  if (differs("Time")) return single("moment", "time", "another time: " + change("Time") + " s");
  if (differs("State")) return single("engine", "state", "physics moved: state " + change("State"));
  const std::string state = textOf(golden.text, "State");
  if (state.empty() || textOf(actual.text, "State").empty()) return {};
  for (const LookOfFrame& look : kLooks) {
    const std::string a = textOf(actual.text, look.key), g = textOf(golden.text, look.key);
    if (a != g)
      return single(look.key == std::string("Light") ? "light" : "preset", look.key,
                    std::string("the same motion, another look: ") + look.key + " is " +
                        (a.empty() ? look.unsaid : a) + ", was " + (g.empty() ? look.unsaid : g));
  }
  return single(
      "renderer", "renderer",
      "the renderer changed: same state " + state + (differs("Renderer") ? ", " + change("Renderer") : ""));
}

const MotionRecord* RecordShelf::recordBeside(const std::filesystem::path& frame) {
  std::filesystem::path folder = frame.parent_path();
  if (folder.extension() == ".variants") folder = folder.parent_path();
  const std::filesystem::path file = folder / kRecordName;
  const auto [at, is_new] = records_.try_emplace(file);
  std::error_code ignored;
  if (is_new && std::filesystem::exists(file, ignored)) {
    try {
      at->second = readRecord(file);
    } catch (const InputError& error) {
      problems_.push_back(error.what());
    }
  }
  return at->second ? &*at->second : nullptr;
}

std::optional<RecordedPicture> RecordShelf::pictureOf(const std::filesystem::path& frame,
                                                      const std::string& name) {
  const MotionRecord* record = recordBeside(frame);
  if (record == nullptr) return std::nullopt;
  const renderer::PngText text = renderer::readPngText(frame);
  const RecordedShot* shot = record->shotOf(name, text);
  if (shot == nullptr) return std::nullopt;
  return RecordedPicture{*record, *shot, textOf(text, "Scene")};
}

std::optional<RecordedPicture> RecordShelf::ofActual(const ImagePair& pair) {
  return pictureOf(pair.actual, pair.actual.filename().string());
}

std::optional<RecordedPicture> RecordShelf::ofGolden(const ImagePair& pair) {
  return pictureOf(pair.golden, std::filesystem::path(pair.name).filename().string());  // or a variant's
}

Cause causeInRecords(const std::vector<RecordedPictures>& frames) {
  Cause unseen;
  for (const auto& [a, g] : frames) {
    if (a.record.scene != g.record.scene || a.shot.time_s != g.shot.time_s) continue;
    if (a.shot.state_hash != g.shot.state_hash) return causeAtShots(a, g);
    if (unseen.known()) continue;
    append(unseen.changes, differencesOf(a, g).world);
    if (!unseen.changes.empty())
      unseen.headline = "the scene changed, though no state did: " + joined(unseen.changes);
  }
  return unseen;
}

Cause causeOfDifference(const Comparison& c, const Gate& gate, RecordShelf& shelf) {
  const renderer::DecodedRaster actual = renderer::readPngRaster(c.pair.actual);
  const renderer::DecodedRaster golden = renderer::readPngRaster(c.pair.golden);
  const Cause by_text = causeByText(actual, golden);
  if (!by_text.changes.empty() && by_text.changes.front().part == "encoder") return by_text;
  const std::optional<RecordedPicture> a = shelf.ofActual(c.pair), g = shelf.ofGolden(c.pair);
  if (!a || !g) return by_text;
  Cause cause = causeAtShots(*a, *g);
  renderer::Raster looked_at = actual.raster;
  if (gate.mask != nullptr) gate.mask->apply(c.pair, looked_at, golden.raster);
  addPictureEvidence({looked_at, golden.raster, gate.toleranceOf(actual.raster.fullScale())}, {*a, *g},
                     cause);
  return cause;
}

}  // namespace carom::demos
