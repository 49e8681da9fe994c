#include "tests/fuzz/readers.h"

#include <exception>
#include <iostream>
#include <sstream>
#include <vector>

#include "demos/cli/command_options.h"
#include "demos/command/distance_query.h"
#include "demos/language/scene_file.h"
#include "demos/record/recording.h"
#include "demos/scene/scene_world.h"
#include "demos/scene/shape_solid.h"
#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "engine/solid/solid.h"
#include "renderer/image/png.h"

namespace carom::fuzz {
namespace fs = std::filesystem;
namespace {

void readScene(const fs::path& file) {
  const demos::Scene scene = demos::readSceneFile(file);
  const demos::SceneWorld made = demos::makeSceneWorld(scene, std::nullopt);
  demos::sceneHash(scene, std::nullopt);
}

void readRecording(const fs::path& file) {
  demos::RecordingReader reader(file);
  for (int frame = 0; frame < reader.header().frames; ++frame) reader.advanceTo(frame);
}

void readMesh(const fs::path& file) {
  demos::MeshSolid mesh = demos::meshSolid(file);
  const Solid solid(std::move(mesh.parts), std::move(mesh.surface));
  demos::meshHull(file);
}

void readPng(const fs::path& file) {
  renderer::readPng(file);
  renderer::readPngRaster(file);
}

/// What is wrong with an exception, if anything.
std::string wrongWith(const std::exception_ptr& thrown) {
  const demos::Failure failure = demos::failureOf(thrown);
  if (failure.is_bug || failure.code < 2 || failure.code > 5)
    return "ends with " + std::to_string(failure.code) + ": " + failure.line;
  if (failure.line.empty() || failure.line.find('\n') != std::string::npos)
    return "says no line: " + failure.line;
  return "";
}

std::string wrongWithLines(const std::string& text) {
  demos::DistanceAnswers answers(demos::DistanceAnswers::Start::kTracked);
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      answers.answer(demos::readDistanceQuery(demos::Json::parse(line, "queries.jsonl", number))).text();
    } catch (...) {
      if (const std::string wrong = wrongWith(std::current_exception()); !wrong.empty()) return wrong;
    }
  }
  return "";
}

/// A line is a word of the command line, which is read and not carried out.
void readWords(const std::string& text) {
  std::vector<std::string> words{"carom"};
  std::istringstream lines(text);
  for (std::string word; std::getline(lines, word);) words.push_back(word.c_str());  // None holds a 0.
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::ostringstream told;
  std::streambuf* const before = std::cout.rdbuf(told.rdbuf());
  try {
    demos::CommandLine line;
    demos::readCommandLine(line, static_cast<int>(words.size()), argv.data());
  } catch (...) {
    std::cout.rdbuf(before);
    throw;
  }
  std::cout.rdbuf(before);
}

}  // namespace

std::string wrongWith(const Input& input, const fs::path& file) {
  try {
    switch (input.kind) {
      case Kind::kScene:
        readScene(file);
        break;
      case Kind::kRecording:
        readRecording(file);
        break;
      case Kind::kMesh:
        readMesh(file);
        break;
      case Kind::kPng:
        readPng(file);
        break;
      case Kind::kQueries:
        return wrongWithLines(input.bytes);
      case Kind::kWords:
        readWords(input.bytes);
        break;
    }
  } catch (...) {
    return wrongWith(std::current_exception());
  }
  return "";
}

}  // namespace carom::fuzz
