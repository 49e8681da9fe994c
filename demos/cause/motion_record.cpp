#include "demos/cause/motion_record.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "demos/cause/packed_text.h"
#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "demos/format/json.h"

namespace carom::demos {
namespace {

constexpr int kFormat = 1;

Json factsJson(const Facts& facts) {
  Json json = Json::array();
  for (const auto& [name, text] : facts) {
    json.push(name);
    json.push(text);
  }
  return json;
}

Facts readFacts(const Json& json) {
  Facts facts;
  const std::vector<Json>& items = json.items();
  for (std::size_t i = 0; i + 1 < items.size(); i += 2)
    facts.emplace_back(items[i].asString(), items[i + 1].asString());
  return facts;
}

/// Numbers one after another with spaces between; what is read back stops at the first that is none.
template <typename Number>
std::vector<Number> numbersIn(const std::string& text) {
  std::istringstream in(text);
  std::vector<Number> numbers;
  for (Number n; in >> n;) numbers.push_back(n);
  return numbers;
}

/// Second differences: what moves evenly becomes zeros.
std::string differencesText(const std::vector<long long>& values) {
  std::string text;
  long long last = 0, last_step = 0;
  for (const long long value : values) {
    text += std::to_string((value - last) - last_step) + ' ';
    last_step = value - last;
    last = value;
  }
  return text;
}

std::vector<long long> undifferenced(const std::string& text, std::size_t count) {
  std::vector<long long> values = numbersIn<long long>(text);
  values.resize(count, 0);
  // Wraps where a damaged file's numbers are beyond all bounds.
  unsigned long long last = 0, step = 0;
  for (long long& value : values) {
    step += static_cast<unsigned long long>(value);
    last += step;
    value = static_cast<long long>(last);
  }
  return values;
}

/// The poses of all moments and shots, body by body and coordinate by coordinate.
Json posesJson(const std::vector<const std::vector<RoundedPose>*>& moments, std::size_t bodies) {
  Json json = Json::array();
  for (std::size_t b = 0; b < bodies; ++b) {
    std::string text;
    for (std::size_t c = 0; c < std::tuple_size_v<RoundedPose>; ++c) {
      std::vector<long long> values;
      for (const std::vector<RoundedPose>* poses : moments) values.push_back((*poses)[b][c]);
      text += differencesText(values) + ';';
    }
    json.push(text);
  }
  return json;
}

void readPoses(const Json& json, const std::vector<std::vector<RoundedPose>*>& moments, std::size_t bodies) {
  if (json.items().size() != bodies) json.fail("the poses of other bodies");
  for (std::vector<RoundedPose>* poses : moments) poses->assign(bodies, RoundedPose{});
  for (std::size_t b = 0; b < bodies; ++b) {
    std::istringstream in(json.items()[b].asString());
    std::string part;
    for (std::size_t c = 0; c < std::tuple_size_v<RoundedPose> && std::getline(in, part, ';'); ++c) {
      const std::vector<long long> values = undifferenced(part, moments.size());
      for (std::size_t m = 0; m < moments.size(); ++m) (*moments[m])[b][c] = values[m];
    }
  }
}

std::string touchesText(const std::vector<RecordedTouch>& touches) {
  std::string text;
  for (const RecordedTouch& t : touches)
    text += std::to_string(t.body_a) + ' ' + std::to_string(t.body_b) + ' ' +
            formatted("%.3g", t.impulse_Ns) + ' ';
  return text;
}

int bodyIndex(double value, std::size_t bodies) {
  return value >= 0.0 && value < static_cast<double>(bodies) ? static_cast<int>(value) : 0;
}

std::vector<RecordedTouch> readTouches(const std::string& text, std::size_t bodies) {
  const std::vector<double> n = numbersIn<double>(text);
  std::vector<RecordedTouch> touches;
  for (std::size_t i = 0; i + 2 < n.size(); i += 3)
    touches.push_back({bodyIndex(n[i], bodies), bodyIndex(n[i + 1], bodies), n[i + 2]});
  return touches;
}

/// Runs of pixels: how many, and of which body.
std::string runsText(const std::vector<std::int32_t>& bodies) {
  std::string text;
  for (std::size_t i = 0; i < bodies.size();) {
    std::size_t end = i;
    while (end < bodies.size() && bodies[end] == bodies[i]) ++end;
    text += std::to_string(end - i) + ' ' + std::to_string(bodies[i]) + ' ';
    i = end;
  }
  return text;
}

std::vector<std::int32_t> readRuns(const std::string& text, std::size_t pixels) {
  const std::vector<long long> n = numbersIn<long long>(text);
  std::vector<std::int32_t> bodies;
  for (std::size_t i = 0; i + 1 < n.size(); i += 2) {
    if (n[i] < 0 || static_cast<std::size_t>(n[i]) > pixels - bodies.size()) return {};
    bodies.insert(bodies.end(), static_cast<std::size_t>(n[i]), static_cast<std::int32_t>(n[i + 1]));
  }
  return bodies.size() == pixels ? bodies : std::vector<std::int32_t>{};
}

std::string cameraText(const renderer::Camera& c) {
  std::string text;
  for (const Vec3* v : {&c.eye, &c.target})
    for (const double x : *v) text += formatted("%.9g", x) + ' ';
  text += formatted("%.9g", c.fov_degrees);
  if (c.aperture_m > 0.0) text += ' ' + formatted("%.9g", c.aperture_m) + ' ' + formatted("%.9g", c.focus_m);
  return text;
}

renderer::Camera readCamera(const std::string& text) {
  std::vector<double> n = numbersIn<double>(text);
  n.resize(9, 0.0);
  return {Vec3(n[0], n[1], n[2]), Vec3(n[3], n[4], n[5]), n[6], n[7], n[8]};
}

Json bodyJson(const RecordedBody& body) {
  return Json::array({body.name, factsJson(body.motion), factsJson(body.stuff), factsJson(body.shape),
                      factsJson(body.look)});
}

RecordedBody readBody(const Json& json) {
  const std::vector<Json>& items = json.items();
  if (items.size() != 5) json.fail("accepted: a name and four lists");
  return {items[0].asString(), readFacts(items[1]), readFacts(items[2]), readFacts(items[3]),
          readFacts(items[4])};
}

/// How much of the record is kept: every so many of its moments and prints, so many collisions.
struct Thinning {
  std::size_t stride = 1;
  std::size_t strikes = 4000;
  bool pixels = true;
};

std::string recordText(const MotionRecord& r, const Thinning& kept) {
  Json bodies = Json::array();
  for (const RecordedBody& body : r.bodies) bodies.push(bodyJson(body));
  Json moments = Json::array(), touches = Json::array();
  std::vector<const std::vector<RoundedPose>*> poses;
  for (std::size_t i = 0; i < r.moments.size(); i += kept.stride) {
    moments.push(r.moments[i].step);
    moments.push(r.moments[i].time_s);
    touches.push(touchesText(r.moments[i].touches));
    poses.push_back(&r.moments[i].poses);
  }
  const std::size_t print_stride = std::max<std::size_t>(1, r.prints.size() * kept.stride / 16384);
  std::string prints;
  for (std::size_t i = 0; i < r.prints.size(); i += print_stride) prints += hexText(r.prints[i]).substr(8);
  std::string strikes;
  for (std::size_t i = 0; i < std::min(r.strikes.size(), kept.strikes); ++i) {
    const RecordedStrike& s = r.strikes[i];
    strikes += std::to_string(s.step) + ' ' + formatted("%.9g", s.time_s) + ' ' + std::to_string(s.body_a) +
               ' ' + std::to_string(s.body_b) + ' ' + formatted("%.4g", s.impulse_Ns) + ' ';
  }
  Json shots = Json::array();
  for (const RecordedShot& s : r.shots) {
    shots.push(Json::object({{"file", s.file},
                             {"time_s", s.time_s},
                             {"state", hexText(s.state_hash)},
                             {"camera", cameraText(s.camera)},
                             {"width", s.width},
                             {"height", s.height},
                             {"text", hexText(s.text_print)},
                             {"bodies", kept.pixels ? runsText(s.bodies) : ""}}));
    poses.push_back(&s.poses);
  }
  return Json::object({{"format", kFormat},
                       {"scene", r.scene},
                       {"world", factsJson(r.world)},
                       {"look", factsJson(r.look)},
                       {"sources", factsJson(r.sources)},
                       {"step_s", r.step_s},
                       {"lengthQuantum_m", r.length_quantum_m},
                       {"bodies", std::move(bodies)},
                       {"printStride", r.print_stride * static_cast<int>(print_stride)},
                       {"prints", prints},
                       {"moments", std::move(moments)},
                       {"touches", std::move(touches)},
                       {"strikes", strikes},
                       {"shots", std::move(shots)},
                       {"poses", posesJson(poses, r.bodies.size())}})
      .text();
}

int wholeNumber(const Json& json) {
  const double value = json.asNumber();
  if (!(value >= 0.0 && value <= 1e9)) json.fail(json.shown() + " is out of range");
  return static_cast<int>(value);
}

void readMoments(const Json& json, MotionRecord& record) {
  const std::vector<Json>&moments = json.at("moments").items(), &touches = json.at("touches").items();
  if (moments.size() != 2 * touches.size()) json.at("moments").fail("not as many as touches");
  for (std::size_t i = 0; i < touches.size(); ++i)
    record.moments.push_back({wholeNumber(moments[2 * i]),
                              moments[2 * i + 1].asNumber(),
                              {},
                              readTouches(touches[i].asString(), record.bodies.size())});
}

void readStrikes(const Json& json, MotionRecord& record) {
  const std::vector<double> n = numbersIn<double>(json.asString());
  for (std::size_t i = 0; i + 4 < n.size(); i += 5)
    record.strikes.push_back({static_cast<int>(std::clamp(n[i], 0.0, 1e9)), n[i + 1],
                              bodyIndex(n[i + 2], record.bodies.size()),
                              bodyIndex(n[i + 3], record.bodies.size()), n[i + 4]});
}

RecordedShot readShot(const Json& json) {
  RecordedShot shot;
  shot.file = json.at("file").asString();
  shot.time_s = json.at("time_s").asNumber();
  shot.state_hash = std::strtoull(json.at("state").asString().c_str(), nullptr, 16);
  // Records from before it was written have none.
  if (const Json* print = json.find("text"))
    shot.text_print = std::strtoull(print->asString().c_str(), nullptr, 16);
  shot.camera = readCamera(json.at("camera").asString());
  shot.width = std::min(wholeNumber(json.at("width")), 1 << 14);
  shot.height = std::min(wholeNumber(json.at("height")), 1 << 14);
  shot.bodies = readRuns(json.at("bodies").asString(),
                         static_cast<std::size_t>(shot.width) * static_cast<std::size_t>(shot.height));
  return shot;
}

}  // namespace

std::string textOf(const renderer::PngText& text, std::string_view key) {
  for (const auto& [name, value] : text)
    if (name == key) return value;
  return "";
}

std::uint64_t textPrint(const renderer::PngText& text) {
  constexpr std::string_view kNotShown[] = {"Software", "Build", "Renderer", "Pixels"};
  ContentHash hash;
  for (const auto& [key, value] : text)
    if (std::find(std::begin(kNotShown), std::end(kNotShown), key) == std::end(kNotShown))
      hash.add(key).add(value);
  return hash.value();
}

bool RecordedShot::isOf(const renderer::PngText& text) const {
  return hexText(state_hash) == textOf(text, "State") && (text_print == 0 || text_print == textPrint(text));
}

const RecordedShot* MotionRecord::shotOf(const std::string& file, const renderer::PngText& text) const {
  for (const RecordedShot& shot : shots)
    if (shot.file == file && shot.isOf(text)) return &shot;
  return nullptr;
}

RoundedPose roundedPose(const Pose& X_WB, double length_quantum_m) {
  RoundedPose rounded;
  for (int i = 0; i < 3; ++i)
    rounded[static_cast<std::size_t>(i)] = std::llround(X_WB.position[i] / length_quantum_m);
  const Quat& q = X_WB.rotation;
  const double turns[4] = {q.w(), q.x(), q.y(), q.z()};
  for (std::size_t i = 0; i < 4; ++i) rounded[3 + i] = std::llround(turns[i] / kTurnQuantum);
  return rounded;
}

Vec3 positionOf(const RoundedPose& pose, double length_quantum_m) {
  return length_quantum_m *
         Vec3(static_cast<double>(pose[0]), static_cast<double>(pose[1]), static_cast<double>(pose[2]));
}

std::vector<std::uint8_t> recordBytes(const MotionRecord& record, std::size_t most) {
  Thinning kept;
  while (record.moments.size() / kept.stride > 128) kept.stride *= 2;
  for (;;) {
    std::vector<std::uint8_t> bytes = packedText(recordText(record, kept));
    const bool can_thin = kept.stride < record.moments.size() || kept.strikes > 0 || kept.pixels;
    if (bytes.size() <= most || !can_thin) return bytes;
    if (kept.stride >= record.moments.size()) kept.pixels = false;
    kept.stride *= 2;
    kept.strikes /= 2;
  }
}

MotionRecord readRecord(const std::filesystem::path& path) {
  const Json json = Json::parse(unpackedText(path), path.string());
  if (json.at("format").asNumber() != kFormat)
    json.at("format").fail(json.at("format").shown() + "; accepted: " + std::to_string(kFormat));
  MotionRecord record;
  record.scene = json.at("scene").asString();
  record.world = readFacts(json.at("world"));
  record.look = readFacts(json.at("look"));
  record.sources = readFacts(json.at("sources"));
  record.step_s = json.at("step_s").asNumber();
  record.length_quantum_m = json.at("lengthQuantum_m").asNumber();
  for (const Json& body : json.at("bodies").items()) record.bodies.push_back(readBody(body));
  record.print_stride = std::max(1, wholeNumber(json.at("printStride")));
  const std::string& prints = json.at("prints").asString();
  for (std::size_t i = 0; i + 8 <= prints.size(); i += 8)
    record.prints.push_back(
        static_cast<std::uint32_t>(std::strtoul(prints.substr(i, 8).c_str(), nullptr, 16)));
  readMoments(json, record);
  readStrikes(json.at("strikes"), record);
  for (const Json& shot : json.at("shots").items()) record.shots.push_back(readShot(shot));
  std::vector<std::vector<RoundedPose>*> poses;
  for (RecordedMoment& moment : record.moments) poses.push_back(&moment.poses);
  for (RecordedShot& shot : record.shots) poses.push_back(&shot.poses);
  readPoses(json.at("poses"), poses, record.bodies.size());
  return record;
}

}  // namespace carom::demos
