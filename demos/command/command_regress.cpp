// `carom regress`: a suite of scenes drawn, compared and told of in one page.
#include "demos/command/command.h"

#include <iostream>

#include "demos/format/printable.h"
#include "demos/format/progress.h"
#include "demos/regress/regress_index.h"
#include "demos/scene/written_files.h"
#include "demos/system/atomic_file.h"
#include "demos/system/interrupt.h"
#include "demos/system/machine_load.h"

namespace carom::demos {
namespace {

void writeText(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

/// A scene's folder of the output is emptied before it is drawn: no golden frame may lie in it.
void requireApart(const RegressOptions& options, const RegressSuite& suite) {
  std::vector<NamedFile> written, read = {{"the suite", suite.file}};
  if (!options.junit.empty()) written.push_back({"--junit", options.junit});
  for (const SuiteScene& scene : suite.scenes) {
    written.push_back({"-o", options.output / scene.name});
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::weakly_canonical(scene.golden, ignored);
    for (; folder.has_relative_path(); folder = folder.parent_path()) read.push_back({"the suite", folder});
  }
  requireNotRead(written, read);
}

}  // namespace

ExitCode regress(const RegressOptions& options) {
  const RegressSuite suite = readSuite(options.suite);
  requireApart(options, suite);
  catchInterrupts();
  std::vector<SceneOutcome> outcomes;
  {
    const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
    Progress progress({"scene", static_cast<int>(suite.scenes.size())}, style, std::cerr, steadySeconds);
    const RegressPlan plan{options.output, options.jobs > 0 ? options.jobs : processors(), options.update};
    outcomes = runSuite(suite, plan, [&progress](int count) { progress.done(count); });
  }
  const std::filesystem::path index = options.output / "index.html";
  writeText(index, indexPage(outcomes, suite.file.string()));
  if (!options.junit.empty()) writeText(options.junit, suiteJunit(outcomes));
  if (options.json) {
    std::cout << suiteJson(outcomes).text(2) << '\n';
  } else {
    for (const SceneOutcome& o : outcomes)
      if (o.code != 0) std::cout << printable(o.name + "  " + sceneLine(o)) << '\n';
    std::cout << suiteSummary(outcomes) << "; index: " << printable(index.string()) << '\n';
  }
  // A scene that could not be judged outweighs those that differ.
  int code = 0;
  for (const SceneOutcome& o : outcomes)
    if (o.code > code) code = o.code;
  return static_cast<ExitCode>(code);
}

}  // namespace carom::demos
