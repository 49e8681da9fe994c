// `carom gallery`: scenes as one folder that opens in a browser: an index with moving pictures and a page for
// each.
#include "demos/command/command.h"

#include <algorithm>
#include <iostream>
#include <string>

#include <unistd.h>

#include "demos/asset/asset_path.h"
#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "demos/format/printable.h"
#include "demos/format/progress.h"
#include "demos/frames/folder_claim.h"
#include "demos/gallery/gallery_index.h"
#include "demos/gallery/gallery_run.h"
#include "demos/gallery/gallery_scene.h"
#include "demos/system/atomic_file.h"
#include "demos/system/interrupt.h"
#include "demos/system/machine_load.h"

namespace carom::demos {
namespace {

std::int64_t bytesOf(const std::vector<GalleryEntry>& entries) {
  std::int64_t bytes = 0;
  for (const GalleryEntry& entry : entries)
    for (const GalleryFile& file : entry.files) bytes += file.bytes;
  return bytes;
}

void printFailures(const std::vector<GalleryFailure>& failures) {
  for (const GalleryFailure& failure : failures)
    std::cerr << printable(failure.name + ": " + failure.line) << '\n';
}

void printReport(const GalleryOutcome& outcome, const std::filesystem::path& index) {
  const std::string size = formatted("%.1f MB", static_cast<double>(bytesOf(outcome.entries)) / 1e6);
  std::cout << printable(index.string()) << "  " << outcome.entries.size()
            << (outcome.entries.size() == 1 ? " scene  " : " scenes  ") << size << "  ("
            << outcome.entries.size() - static_cast<std::size_t>(outcome.kept) << " made, " << outcome.kept
            << " kept)\n";
}

}  // namespace

ExitCode gallery(const GalleryOptions& options) {
  const GalleryShape shape{options.output, options.width, options.height, options.fps, options.gl};
  catchInterrupts();
  if (options.part) {
    SceneChoice choice;
    choice.scene = options.scenes.at(0);
    std::cout << makeGalleryScene(choice, shape).json().text() << '\n';
    return ExitCode::kOk;
  }
  GalleryPlan plan{options.scenes, shape, options.jobs > 0 ? options.jobs : processors()};
  if (plan.scenes.empty())
    for (const std::filesystem::path& scene : shippedScenes()) plan.scenes.push_back(scene.stem().string());
  // Two at a time would each remove what the other makes.
  const FolderClaim claim({options.output, "gallery", ContentHash().add(std::to_string(::getpid())).value()});
  GalleryOutcome outcome;
  {
    const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
    Progress progress({"scene", static_cast<int>(plan.scenes.size())}, style, std::cerr, steadySeconds);
    outcome = runGallery(plan, [&progress](int count) { progress.done(count); });
  }
  const std::filesystem::path index = options.output / kGalleryIndex;
  AtomicFile file(index);
  file.write(galleryIndex(outcome.entries));
  file.commit();
  printFailures(outcome.failures);
  if (!options.telling.quiet) printReport(outcome, index);
  int code = 0;
  for (const GalleryFailure& failure : outcome.failures) code = std::max(code, failure.code);
  return static_cast<ExitCode>(code);
}

}  // namespace carom::demos
