#pragma once
// A recording: the motion of a scene as `simulate -o` writes it and `render --from` draws it. Little-endian
// and exact to the bit:
//   "CAROMREC", version (u32), then blocks: kind (u8), size (u32), payload, checksum (u64)
//   H  JSON: the scene's identity, rates, numbers of bodies and frames
//   F  frame, step (u32), state hash (u64), then per body: a byte with its mode and what follows (pose if it
//      moved since the last frame, velocities if not zero), so that a body at rest costs one byte
//   E  the number of frames, in 4 bytes
// A checksum covers everything since the version, so that a block that is lost, repeated or moved shows.
// Tested in tests/demos/record/recording_test.cpp.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "demos/format/content_hash.h"
#include "demos/system/atomic_file.h"
#include "engine/simulation/world.h"

namespace carom::demos {

struct RecordingHeader {
  std::string scene;  ///< A shipped scene's name, or the absolute path of its file.
  std::string mesh;   ///< The absolute path of the mesh in place of the scene's own, or empty.
  std::uint64_t scene_hash = 0;
  std::uint64_t seed = 0;
  double rate_hz = 0.0;
  double fps = 0.0;
  double duration_s = 0.0;
  int bodies = 0;
  int frames = 0;
};

/// The bodies at the instant of a frame, and the world they were taken from.
struct FrameState {
  std::span<const BodyState> bodies;
  int step = 0;
  std::uint64_t state_hash = 0;
};

class RecordingWriter {
 public:
  /// Throws CannotWrite, as do the others; until `commit` there is no file of that name.
  RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header);
  /// Frames are added in order, from 0.
  void add(const FrameState& state);
  void commit();

 private:
  void block(char kind, const std::string& payload);

  AtomicFile file_;
  ContentHash sum_;
  RecordingHeader header_;
  std::vector<BodyState> last_;
  int frames_ = 0;
};

class RecordingReader {
 public:
  /// Reads the whole file once and throws InputError, naming it, unless all of it is there and undamaged.
  explicit RecordingReader(const std::filesystem::path& path);

  const RecordingHeader& header() const { return header_; }
  /// The state at `frame`, which must not be before the last one asked for; valid until the next call.
  FrameState advanceTo(int frame);

 private:
  struct Block {
    char kind = 0;
    std::string payload;
  };
  void start();
  /// Whose payload is at most so long.
  Block nextBlock(std::size_t longest);
  std::size_t longestFrame() const;
  void check();
  void readFrame(const std::string& payload);
  std::string take(std::size_t count);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  std::ifstream file_;
  std::uintmax_t left_ = 0;  // bytes of the file not read yet
  ContentHash sum_;
  RecordingHeader header_;
  std::vector<BodyState> states_;
  int frame_ = -1;
  int step_ = 0;
  std::uint64_t state_hash_ = 0;
};

}  // namespace carom::demos
