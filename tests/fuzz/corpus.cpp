#include "tests/fuzz/corpus.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <unistd.h>

#include "demos/format/json.h"
#include "demos/language/scene_file.h"
#include "demos/record/recording.h"
#include "demos/scene/scene_world.h"
#include "tests/fuzz/mutation.h"

namespace carom::fuzz {
namespace fs = std::filesystem;
namespace {

// Of files that are changed: larger ones are slow to read and no stranger inside.
constexpr std::uintmax_t kLargest = 200000;
// Of twenty inputs.
constexpr Kind kTurns[20] = {Kind::kScene,     Kind::kScene, Kind::kScene,     Kind::kScene,
                             Kind::kScene,     Kind::kScene, Kind::kScene,     Kind::kScene,
                             Kind::kScene,     Kind::kWords, Kind::kRecording, Kind::kRecording,
                             Kind::kRecording, Kind::kMesh,  Kind::kMesh,      Kind::kMesh,
                             Kind::kPng,       Kind::kPng,   Kind::kQueries,   Kind::kQueries};

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Sorted, so that an index means the same file everywhere.
std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string recordingOf(const fs::path& scene_file, int frames) {
  const demos::Scene scene = demos::readSceneFile(scene_file);
  demos::SceneWorld made = demos::makeSceneWorld(scene, std::nullopt);
  demos::RecordingHeader header;
  header.scene = scene.name;
  header.scene_hash = demos::sceneHash(scene, std::nullopt);
  header.seed = scene.seed;
  header.rate_hz = scene.rate_hz;
  header.fps = scene.rate_hz / 8.0;
  header.duration_s = frames / header.fps;
  header.bodies = static_cast<int>(made.world.bodies().size());
  header.frames = frames;
  const fs::path file = fs::temp_directory_path() / ("carom-fuzz-" + std::to_string(::getpid()) + ".carom");
  demos::RecordingWriter writer(file, header);
  for (int frame = 0; frame < frames; ++frame) {
    writer.add({made.world.states(), made.world.stepCount(), made.world.stateHash()});
    for (int step = 0; step < 8; ++step) made.world.step();
  }
  writer.commit();
  const std::string bytes = bytesOf(file);
  fs::remove(file);
  return bytes;
}

std::vector<Input> queryFiles(const fs::path& meshes) {
  std::string lines;
  const auto mesh = [&meshes](const char* name) { return demos::Json((meshes / name).string()).text(); };
  for (const char* other : {"dodecahedron.ply", "wedge.stl", "prism.ply"})
    lines += "{\"a\": " + mesh("gem.obj") + ", \"b\": " + mesh(other) +
             ", \"poseA\": {\"position\": [0.1, 0.2, 0.3]}, \"poseB\": {\"position\": [1.5, 0, 0], "
             "\"rotation\": [0.5, 0.5, 0.5, 0.5]}}\n";
  return {{Kind::kQueries, "queries.jsonl", lines}};
}

/// Command lines, a word a line.
std::vector<Input> commandLines() {
  std::vector<Input> lines;
  for (const char* words :
       {"render\nsliding\n-o\nout/frame_%04d.png\n--size\n320x180\n--fps\n2\n--camera\nclose\n--frames\n0-5",
        "render\n--from\nrun.carom\n--overlay\ncontacts,paths\n--aov\ndepth,body\n--shard\n1/"
        "3\n--workers\n2\n--at\n0.5,1",
        "simulate\nresting\n--duration\n1.5\n--seed\n7\n--set\nbodies[0].mass=2\n--csv\nout.csv\n--"
        "threads\n2\n-q",
        "export\nrun.carom\n--csv\nout.csv\n--npy\nout.npy", "check\nmy.json\n--mesh\ngem.obj\n--hull",
        "distance\na.obj\nb.obj\n--pose-a\n0,0,1\n--pose-b\n1,2,3,0.5,0.5,0.5,0.5\n--cold",
        "compare\na\nb\n--tolerance\n3\n--allow-pixels\n5\n--mask\nm.png\n--report\nnone\n--junit\nj.xml",
        "budget\nsliding\n--budget\n5ms\n--percentile\n95\n--replays\n3\n--clock\ncpu",
        "regress\nout\n--jobs\n2", "help\nrender", "--version", "doctor\n--gl\negl"})
    lines.push_back({Kind::kWords, "words.txt", words});
  return lines;
}

}  // namespace

const char* nameOf(Kind kind) {
  constexpr const char* kNames[kKinds] = {"scene", "recording", "mesh", "png", "queries", "words"};
  return kNames[static_cast<int>(kind)];
}

Corpus::Corpus(const fs::path& models) {
  const fs::path source = CAROM_SOURCE_DIR;
  const auto add = [this](Kind kind, const fs::path& file) {
    if (fs::file_size(file) <= kLargest)
      sound_[static_cast<int>(kind)].push_back({kind, file.filename().string(), bytesOf(file)});
  };
  for (const fs::path& file : filesBelow(source / "assets/scenes"))
    if (file.extension() == ".json") add(Kind::kScene, file);
  for (const fs::path& file : filesBelow(source / "assets/meshes")) add(Kind::kMesh, file);
  for (const fs::path& file : filesBelow(source / "tests/golden"))
    if (file.filename() == "frame_0000.png") add(Kind::kPng, file);
  for (const char* scene : {"cradle", "sliding", "rolling-race"})
    sound_[static_cast<int>(Kind::kRecording)].push_back(
        {Kind::kRecording, "run.carom",
         recordingOf(source / "assets/scenes" / (scene + std::string(".json")), 4)});
  sound_[static_cast<int>(Kind::kQueries)] = queryFiles(source / "assets/meshes");
  sound_[static_cast<int>(Kind::kWords)] = commandLines();
  if (!models.empty()) models_ = filesBelow(models);
  for (const fs::path& file : models_) add(Kind::kMesh, file);
  for (const std::vector<Input>& of_kind : sound_)
    if (of_kind.empty()) throw std::runtime_error("no sound files to change");
}

Input Corpus::unchanged(std::size_t index) const {
  return {Kind::kMesh, models_[index].filename().string(), bytesOf(models_[index])};
}

Input Corpus::mutated(std::uint64_t index, std::uint64_t seed) const {
  Random random(seed * 1000003 + index);
  const Kind kind = kTurns[index % std::size(kTurns)];
  const std::vector<Input>& sound = sound_[static_cast<int>(kind)];
  Input input = sound[random.below(sound.size())];
  const std::string& other = sound[random.below(sound.size())].bytes;
  if (kind == Kind::kRecording)
    input.bytes = mutatedRecording(input.bytes, other, random);
  else if (kind == Kind::kPng || kind == Kind::kWords || (kind == Kind::kMesh && random.oneIn(2)))
    input.bytes = mutatedBytes(input.bytes, other, random);
  else
    input.bytes = mutatedText(input.bytes, other, random);
  return input;
}

}  // namespace carom::fuzz
