#include "demos/record/recording.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "demos/format/json.h"
#include "demos/scene/scene.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace {

constexpr char kMagic[] = "CAROMREC";
constexpr std::size_t kMagicSize = 8;
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kSumSize = 8;
constexpr std::size_t kBlockHead = 5;            // its kind and its payload's size
constexpr std::size_t kLongestHeader = 1 << 16;  // two paths of the longest kind, several times over
constexpr std::size_t kFrameHead = 16;           // the frame's number, the step's, the state's hash
constexpr std::size_t kLargestBody = 1 + 7 * 8 + 6 * 8;
// What `simulate` takes.
constexpr int kHighestRate = 100000, kHighestFps = 1000, kLongest_s = 3600;
constexpr int kMostFrames = kHighestFps * kLongest_s;
constexpr unsigned kModeBits = 0x0f;
constexpr unsigned kPoseFollows = 0x10;
constexpr unsigned kVelocitiesFollow = 0x20;

void putWord(std::string& out, std::uint64_t word, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) out.push_back(static_cast<char>((word >> (8 * i)) & 0xff));
}

std::uint64_t word(const std::string& bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return value;
}

void putVector(std::string& out, const Vec3& v) {
  for (const double x : v) putWord(out, std::bit_cast<std::uint64_t>(x), 8);
}

void putPose(std::string& out, const Pose& X) {
  putVector(out, X.position);
  putWord(out, std::bit_cast<std::uint64_t>(X.rotation.w()), 8);
  putVector(out, X.rotation.vec());
}

/// Bits, not values: -0 and +0 draw alike but are not the same state.
bool samePoseBits(const Pose& a, const Pose& b) {
  std::string bits_a, bits_b;
  putPose(bits_a, a);
  putPose(bits_b, b);
  return bits_a == bits_b;
}

bool velocitiesAreZeroBits(const BodyState& s) {
  std::string bits;
  putVector(bits, s.linear_velocity);
  putVector(bits, s.angular_velocity);
  return bits.find_first_not_of('\0') == std::string::npos;
}

/// Takes values off the front of a payload; past its end everything is zero and `whole` is false.
struct PayloadCursor {
  const std::string& bytes;
  std::size_t at = 0;
  bool whole = true;

  std::uint64_t take(std::size_t count) {
    if (bytes.size() - at < count) {
      whole = false;
      return 0;
    }
    at += count;
    return word(bytes.substr(at - count, count));
  }
  double number() { return std::bit_cast<double>(take(8)); }
  Vec3 vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
};

/// What a body can be in, but for rounding in the length of the quaternion.
bool isState(const BodyState& state) {
  constexpr double kUnitTolerance = 1e-6;
  return state.X_WB.position.allFinite() && std::abs(state.X_WB.rotation.norm() - 1.0) < kUnitTolerance &&
         state.linear_velocity.allFinite() && state.angular_velocity.allFinite();
}

void takeBody(PayloadCursor& cursor, BodyState& state) {
  const auto flags = static_cast<unsigned>(cursor.take(1));
  const unsigned mode = flags & kModeBits;
  if (mode > static_cast<unsigned>(Mode::kKinematic)) cursor.whole = false;
  state.mode = static_cast<Mode>(mode);
  if ((flags & kPoseFollows) != 0) {
    state.X_WB.position = cursor.vector();
    const double w = cursor.number();
    const Vec3 v = cursor.vector();
    state.X_WB.rotation = Quat(w, v.x(), v.y(), v.z());
  }
  state.linear_velocity.setZero();
  state.angular_velocity.setZero();
  if ((flags & kVelocitiesFollow) == 0) return;
  state.linear_velocity = cursor.vector();
  state.angular_velocity = cursor.vector();
}

std::string headerText(const RecordingHeader& header) {
  return Json::object({{"scene", header.scene},
                       {"mesh", header.mesh},
                       {"sceneHash", hexText(header.scene_hash)},
                       {"seed", std::to_string(header.seed)},
                       {"stepsPerSecond", header.rate_hz},
                       {"fps", header.fps},
                       {"duration_s", header.duration_s},
                       {"bodies", header.bodies},
                       {"frames", header.frames}})
      .text();
}

int count(const Json& json, int most) {
  const double value = json.asNumber();
  if (!(value >= 0.0 && value <= most) || value != std::floor(value))
    json.fail(json.shown() + " is out of range; accepted: a whole number from 0 to " + std::to_string(most));
  return static_cast<int>(value);
}

double positive(const Json& json, int most) {
  const double value = json.asNumber();
  if (!(value > 0.0 && value <= most))
    json.fail(json.shown() + " is out of range; accepted: above 0 to " + std::to_string(most));
  return value;
}

RecordingHeader readHeader(const std::string& text, const std::string& origin) {
  const Json json = Json::parse(text, origin);
  RecordingHeader header;
  header.scene = json.at("scene").asString();
  header.mesh = json.at("mesh").asString();
  header.scene_hash = std::strtoull(json.at("sceneHash").asString().c_str(), nullptr, 16);
  header.seed = std::strtoull(json.at("seed").asString().c_str(), nullptr, 10);
  header.rate_hz = positive(json.at("stepsPerSecond"), kHighestRate);
  header.fps = positive(json.at("fps"), kHighestFps);
  header.duration_s = positive(json.at("duration_s"), kLongest_s);
  header.bodies = count(json.at("bodies"), kMostBodies);
  header.frames = count(json.at("frames"), kMostFrames);
  return header;
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header)
    : file_(path), header_(header) {
  std::string start(kMagic, kMagicSize);
  putWord(start, kVersion, 4);
  file_.write(start);
  block('H', headerText(header));
}

void RecordingWriter::block(char kind, const std::string& payload) {
  std::string bytes(1, kind);
  putWord(bytes, payload.size(), 4);
  bytes += payload;
  sum_.add(bytes);
  putWord(bytes, sum_.value(), kSumSize);
  file_.write(bytes);
}

void RecordingWriter::add(const FrameState& state) {
  REQUIRE(static_cast<int>(state.bodies.size()) == header_.bodies, state.bodies.size(), header_.bodies);
  std::string payload;
  putWord(payload, static_cast<std::uint64_t>(frames_), 4);
  putWord(payload, static_cast<std::uint64_t>(state.step), 4);
  putWord(payload, state.state_hash, 8);
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyState& body = state.bodies[i];
    const bool moved = last_.empty() || !samePoseBits(body.X_WB, last_[i].X_WB);
    const bool moves = !velocitiesAreZeroBits(body);
    putWord(payload,
            static_cast<unsigned>(body.mode) | (moved ? kPoseFollows : 0u) | (moves ? kVelocitiesFollow : 0u),
            1);
    if (moved) putPose(payload, body.X_WB);
    if (!moves) continue;
    putVector(payload, body.linear_velocity);
    putVector(payload, body.angular_velocity);
  }
  block('F', payload);
  last_.assign(state.bodies.begin(), state.bodies.end());
  ++frames_;
}

void RecordingWriter::commit() {
  REQUIRE(frames_ == header_.frames, frames_, header_.frames);
  std::string count;
  putWord(count, static_cast<std::uint64_t>(frames_), 4);
  block('E', count);
  file_.commit();
}

RecordingReader::RecordingReader(const std::filesystem::path& path) : path_(path) {
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed))
    throw InputError("cannot read " + path.string() + ": it is a folder");
  file_ = openInputFile(path_);
  start();
  check();
  start();
}

void RecordingReader::fail(const std::string& what) const {
  const std::string after = frame_ >= 0 ? " after frame " + std::to_string(frame_) : "";
  throw InputError(path_.string() + ": " + what + after);
}

std::string RecordingReader::take(std::size_t count) {
  if (left_ < count) fail("the recording is truncated");
  std::string bytes(count, '\0');
  if (!file_.read(bytes.data(), static_cast<std::streamsize>(count))) fail("the recording is truncated");
  left_ -= count;
  return bytes;
}

// The file is opened once: another of its name may take its place while it is checked.
void RecordingReader::start() {
  file_.clear();
  file_.seekg(0, std::ios::end);
  left_ = static_cast<std::uintmax_t>(std::max<std::streamoff>(file_.tellg(), 0));
  file_.seekg(0);
  sum_ = ContentHash();
  frame_ = -1;
  if (left_ < kMagicSize || take(kMagicSize) != kMagic)
    fail("no recording: accepted: a file that simulate -o wrote");
  const std::uint64_t version = word(take(4));
  if (version != kVersion)
    fail("a recording of version " + std::to_string(version) + ": accepted: version " +
         std::to_string(kVersion));
  const Block header = nextBlock(kLongestHeader);
  if (header.kind != 'H') fail("the recording is damaged");
  header_ = readHeader(header.payload, path_.string());
  // A body takes at least a byte in every frame.
  const std::uintmax_t least =
      kBlockHead + kFrameHead + static_cast<std::uintmax_t>(header_.bodies) + kSumSize;
  if (static_cast<std::uintmax_t>(header_.frames) > left_ / least) fail("the recording is truncated");
  states_.assign(static_cast<std::size_t>(header_.bodies), BodyState{});
}

RecordingReader::Block RecordingReader::nextBlock(std::size_t longest) {
  const std::string head = take(kBlockHead);
  const auto size = static_cast<std::size_t>(word(head.substr(1)));
  if (size > left_) fail("the recording is truncated");
  if (size > longest) fail("the recording is damaged");
  const std::string payload = take(size);
  sum_.add(head + payload);
  if (word(take(kSumSize)) != sum_.value()) fail("the recording is damaged");
  return {head[0], payload};
}

std::size_t RecordingReader::longestFrame() const {
  return kFrameHead + kLargestBody * states_.size();
}

void RecordingReader::readFrame(const std::string& payload) {
  PayloadCursor cursor{payload};
  const auto frame = static_cast<int>(cursor.take(4));
  step_ = static_cast<int>(cursor.take(4));
  state_hash_ = cursor.take(8);
  bool sound = true;
  for (BodyState& state : states_) {
    takeBody(cursor, state);
    sound = sound && isState(state);
  }
  if (!sound || step_ < 0 || !cursor.whole || cursor.at != payload.size() || frame != frame_ + 1)
    fail("the recording is damaged");
  frame_ = frame;
}

void RecordingReader::check() {
  for (int k = 0; k < header_.frames; ++k) {
    const Block block = nextBlock(longestFrame());
    if (block.kind != 'F') fail("the recording is damaged");
    readFrame(block.payload);
  }
  const Block end = nextBlock(longestFrame());
  if (end.kind != 'E' || left_ != 0) fail("the recording is damaged");
}

FrameState RecordingReader::advanceTo(int frame) {
  REQUIRE(frame >= frame_ && frame < header_.frames, frame, frame_, header_.frames);
  while (frame_ < frame) readFrame(nextBlock(longestFrame()).payload);
  return {states_, step_, state_hash_};
}

}  // namespace carom::demos
