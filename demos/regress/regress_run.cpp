#include "demos/regress/regress_run.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "demos/asset/asset_path.h"
#include "demos/cause/motion_record.h"
#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"
#include "demos/system/own_process.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr auto kLook = std::chrono::milliseconds(10);  // between two looks at what runs

/// The files of a scene in the output folder.
struct Files {
  fs::path frames, out, err, report, junit;
};
Files filesOf(const fs::path& output, const std::string& name) {
  const fs::path folder = output / name;
  return {folder / "frames", folder / "compare.json", folder / "errors.txt", folder / "report.html",
          folder / "junit.xml"};
}

/// Whether a file among the frames is of an earlier run: what `render` writes there.
bool isDrawn(const fs::path& file) {
  const std::string name = file.filename().string();
  return (name.starts_with("frame_") && name.ends_with(".png")) || name == kRecordName ||
         (name.starts_with("manifest") && name.ends_with(".json"));
}

/// Makes the folder of a scene, without what an earlier run wrote there; what others put there stays.
void clearFiles(const Files& files) {
  std::error_code failed;
  fs::create_directories(files.frames, failed);
  std::vector<fs::path> former{files.out, files.err, files.report, files.junit};
  if (!failed)
    for (const fs::directory_entry& entry : fs::directory_iterator(files.frames, failed))
      if (isDrawn(entry.path())) former.push_back(entry.path());
  for (const fs::path& file : former)
    if (!failed) fs::remove(file, failed);
  if (failed) throw CannotWrite("cannot write '" + files.frames.string() + "': " + failed.message());
}

std::vector<std::string> renderWords(const SuiteScene& scene, const Files& files) {
  std::vector<std::string> words = {"render", scene.scene, "-q"};
  words.insert(words.end(), scene.render.begin(), scene.render.end());
  words.insert(words.end(), {"-o", (files.frames / "frame_%04d.png").string()});
  return words;
}

std::vector<std::string> compareWords(const SuiteScene& scene, const Files& files, bool update) {
  std::vector<std::string> words = {"compare", files.frames.string(), scene.golden.string(), "-q"};
  words.insert(words.end(), scene.compare.begin(), scene.compare.end());
  words.insert(words.end(), {"--json", "--report", files.report.string(), "--junit", files.junit.string()});
  if (update) words.emplace_back("--update");
  return words;
}

std::string firstLine(const fs::path& file) {
  const std::string text = readTextFile(file);
  return text.substr(0, text.find('\n'));
}

/// The <testsuite> of a JUnit file.
std::string suiteElement(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return "";
  const std::string text = readTextFile(file);
  const std::size_t from = text.find("  <testsuite "), end = text.find("</testsuites>");
  return from == std::string::npos || end == std::string::npos ? "" : text.substr(from, end - from);
}

/// A scene under way: first drawn, then compared.
struct Running {
  std::size_t index;
  bool drawing;
  OwnProcess child;
};

}  // namespace

std::vector<SceneOutcome> runSuite(const RegressSuite& suite, const RegressPlan& plan,
                                   const std::function<void(int)>& done) {
  std::vector<SceneOutcome> outcomes(suite.scenes.size());
  std::vector<Running> running;
  std::size_t next = 0;
  int finished = 0;
  const auto begin = [&](std::size_t i) {
    const SuiteScene& scene = suite.scenes[i];
    const Files files = filesOf(plan.output, scene.name);
    clearFiles(files);
    outcomes[i].name = scene.name;
    running.push_back({i, true, OwnProcess(renderWords(scene, files), files.out, files.err)});
  };
  while (next < suite.scenes.size() || !running.empty()) {
    throwIfInterrupted();
    while (next < suite.scenes.size() && running.size() < static_cast<std::size_t>(plan.jobs)) begin(next++);
    for (Running& run : running) {
      const std::optional<int> code = run.child.ended();
      if (!code) continue;
      const SuiteScene& scene = suite.scenes[run.index];
      const Files files = filesOf(plan.output, scene.name);
      SceneOutcome& outcome = outcomes[run.index];
      outcome.code = *code;
      if (run.drawing && *code == 0) {
        run.drawing = false;
        run.child = OwnProcess(compareWords(scene, files, plan.update), files.out, files.err);
        continue;
      }
      std::error_code ignored;
      if (*code != 0) outcome.problem = firstLine(files.err);
      if (!run.drawing) {
        const std::string text = readTextFile(files.out);
        if (!text.empty()) outcome.comparison = Json::parse(text, files.out.string());
        outcome.junit = suiteElement(files.junit);
        if (fs::exists(files.report, ignored)) outcome.report = fs::path(scene.name) / "report.html";
      }
      run.index = suite.scenes.size();  // done
      done(++finished);
    }
    std::erase_if(running, [&](const Running& run) { return run.index == suite.scenes.size(); });
    std::this_thread::sleep_for(kLook);
  }
  return outcomes;
}

}  // namespace carom::demos
