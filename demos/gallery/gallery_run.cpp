#include "demos/gallery/gallery_run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <sstream>
#include <thread>

#include "demos/asset/asset_path.h"
#include "demos/system/atomic_file.h"
#include "demos/system/exit_code.h"
#include "demos/system/interrupt.h"
#include "demos/system/own_process.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr auto kLook = std::chrono::milliseconds(10);  // between two looks at what runs

std::string nameOfScene(const std::string& scene) {
  return findScene(scene).stem().string();
}

/// Where the processes' output goes while they run; gone with this.
class WorkFolder {
 public:
  explicit WorkFolder(const fs::path& gallery) : path_(gallery / ".making") {
    std::error_code failed;
    fs::create_directories(path_, failed);
    if (failed) throw CannotWrite("cannot write '" + path_.string() + "': " + failed.message());
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  fs::path out(const std::string& name) const { return path_ / (name + ".json"); }
  fs::path err(const std::string& name) const { return path_ / (name + ".txt"); }

 private:
  fs::path path_;
};

/// The entries of an earlier run; none where there is no such file, or it cannot be read.
std::map<std::string, GalleryEntry> formerEntries(const fs::path& folder) {
  std::map<std::string, GalleryEntry> former;
  const fs::path file = folder / kGalleryFile;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return former;
  try {
    const Json json = Json::parse(readTextFile(file), file.string());
    for (const Json& item : json.at("scenes").items()) {
      GalleryEntry entry = galleryEntry(item);
      former[entry.name] = std::move(entry);
    }
  } catch (const InputError&) {
    former.clear();  // of another version, or damaged: all is made anew
  }
  return former;
}

/// An index page that no gallery has written is somebody else's.
void requireOwnIndex(const fs::path& folder) {
  const fs::path index = folder / kGalleryIndex;
  std::error_code ignored;
  if (fs::exists(index, ignored) && !fs::exists(folder / kGalleryFile, ignored))
    throw CannotWrite("cannot write " + index.string() + ": it is there already, and no " + kGalleryFile +
                      " beside it says that it is a gallery's; accepted: another folder");
}

using Entries = std::vector<std::optional<GalleryEntry>>;

/// What is in the folder: what is made, and of the run before what is not made anew or removed yet.
void note(const Entries& entries, const std::map<std::string, GalleryEntry>& former, const fs::path& folder) {
  Json scenes = Json::array();
  for (const std::optional<GalleryEntry>& entry : entries)
    if (entry) scenes.push(entry->json());
  for (const auto& [name, entry] : former) scenes.push(entry.json());
  AtomicFile file(folder / kGalleryFile);
  file.write(Json::object({{"format", 1}, {"scenes", std::move(scenes)}}).text(2) + "\n");
  file.commit();
}

std::vector<std::string> wordsOf(const std::string& scene, const GalleryShape& shape) {
  std::ostringstream size, fps;
  size << shape.width << 'x' << shape.height;
  fps.precision(17);
  fps << shape.fps;
  return {"gallery", "--part", "-o", shape.folder.string(), "--size", size.str(), "--fps", fps.str(), "--gl",
          shape.gl,  "--",     scene};
}

std::string lastLine(const fs::path& file) {
  std::istringstream in(readTextFile(file));
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

/// A scene under way.
struct Running {
  std::size_t index;
  OwnProcess process;
};

/// One run with what it knows so far.
class Making {
 public:
  Making(const GalleryPlan& plan, const std::function<void(int)>& done)
      : plan_(plan),
        done_(done),
        work_(plan.shape.folder),
        former_(formerEntries(plan.shape.folder)),
        entries_(plan.scenes.size()) {}

  GalleryOutcome run(const std::vector<std::string>& names) {
    keep(names);
    std::vector<Running> running;
    std::size_t next = 0;
    while (next < plan_.scenes.size() || !running.empty()) {
      throwIfInterrupted();
      while (next < plan_.scenes.size() && running.size() < static_cast<std::size_t>(plan_.jobs)) {
        const std::size_t i = next++;
        if (!entries_[i])
          running.push_back({i, OwnProcess(wordsOf(plan_.scenes[i], plan_.shape), work_.out(names[i]),
                                           work_.err(names[i]))});
      }
      for (Running& one : running)
        if (const std::optional<int> code = one.process.ended()) {
          finish(one.index, names[one.index], *code);
          one.index = plan_.scenes.size();  // done
        }
      std::erase_if(running, [&](const Running& one) { return one.index == plan_.scenes.size(); });
      if (!running.empty()) std::this_thread::sleep_for(kLook);
    }
    for (const auto& [name, entry] : former_) removeFiles(entry, plan_.shape.folder);
    note(entries_, {}, plan_.shape.folder);
    for (std::optional<GalleryEntry>& entry : entries_)
      if (entry) outcome_.entries.push_back(std::move(*entry));
    return std::move(outcome_);
  }

 private:
  void keep(const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto known = former_.find(names[i]);
      if (known == former_.end() || !isWhole(known->second, plan_.shape.folder)) continue;
      try {
        SceneChoice choice;
        choice.scene = plan_.scenes[i];
        if (known->second.identity != galleryIdentity(chosenScene(choice), plan_.shape)) continue;
      } catch (const InputError&) {
        continue;  // its own process will say what is wrong
      }
      entries_[i] = std::move(known->second);
      former_.erase(known);
      ++outcome_.kept;
    }
    finished_ = outcome_.kept;
    done_(finished_);
  }

  void finish(std::size_t index, const std::string& name, int code) {
    if (code == 0) {
      entries_[index] = galleryEntry(Json::parse(readTextFile(work_.out(name)), name));
      former_.erase(name);
      note(entries_, former_, plan_.shape.folder);
    } else {
      outcome_.failures.push_back({name, code, lastLine(work_.err(name))});
    }
    done_(++finished_);
  }

  const GalleryPlan& plan_;
  const std::function<void(int)>& done_;
  WorkFolder work_;
  std::map<std::string, GalleryEntry> former_;  ///< Of the run before, not kept or made anew.
  Entries entries_;
  GalleryOutcome outcome_;
  int finished_ = 0;
};

}  // namespace

GalleryOutcome runGallery(const GalleryPlan& plan, const std::function<void(int)>& done) {
  std::vector<std::string> names;
  for (const std::string& scene : plan.scenes) {
    names.push_back(nameOfScene(scene));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw UsageError("gallery: two scenes are called \"" + names.back() +
                       "\"; accepted: scenes of different names");
  }
  requireOwnIndex(plan.shape.folder);
  return Making(plan, done).run(names);
}

}  // namespace carom::demos
