// Inputs as strangers write them: scenes, recordings, meshes, PNG files and distance queries with a few
// things wrong go through their readers within this process and, one in fifty, through the program. Each must
// be read, or refused in one line and with a documented code, within 20 s and 2 GB; meant to be built with
// sanitizers. tests/fuzz.sh builds and runs it; the same seed and count give the same inputs.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include "tests/fuzz/corpus.h"
#include "tests/fuzz/program.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/watched_work.h"

namespace {
namespace fs = std::filesystem;
using namespace carom::fuzz;

struct Options {
  std::uint64_t count = 10000;
  std::uint64_t seed = 1;
  std::uint64_t one_in = 50;  ///< Of the inputs, through the program.
  std::uint64_t first = 0;
  int jobs = 2;
  fs::path program;  ///< Empty: readers only.
  fs::path models;
  fs::path keep = "fuzz-failures";
};

Options optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (i + 1 == argc) throw std::invalid_argument(name + " wants a value");
    const std::string value = argv[++i];
    if (name == "--count")
      options.count = std::stoull(value);
    else if (name == "--seed")
      options.seed = std::stoull(value);
    else if (name == "--first")
      options.first = std::stoull(value);
    else if (name == "--program-one-in")
      options.one_in = std::max<std::uint64_t>(std::stoull(value), 1);
    else if (name == "--jobs")
      options.jobs = std::stoi(value);
    else if (name == "--program")
      options.program = value;
    else if (name == "--models")
      options.models = value;
    else if (name == "--keep")
      options.keep = value;
    else
      throw std::invalid_argument("unknown option " + name);
  }
  return options;
}

/// A folder that goes with its process' end; a killed process leaves it to the next.
class Scratch {
 public:
  explicit Scratch(const Options& options)
      : path_(fs::temp_directory_path() / ("carom-fuzz-" + std::to_string(::getpid()))), options_(options) {
    fs::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string wrongWith(const Input& input, std::uint64_t index) const {
    const fs::path file =
        path_ / std::to_string(index % static_cast<std::uint64_t>(options_.jobs)) / input.name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << input.bytes;
    std::string wrong = carom::fuzz::wrongWith(input, file);
    const std::uint64_t turn = index / options_.one_in;
    if (wrong.empty() && !options_.program.empty() && (index * 7 + turn) % options_.one_in == 0)
      wrong = wrongWithProgram(options_.program, input, file, turn);
    fs::remove(file);
    return wrong;
  }

 private:
  fs::path path_;
  const Options& options_;
};

int run(const Options& options) {
  const Corpus corpus(options.models);
  const Scratch scratch(options);
  const std::uint64_t unchanged = corpus.unchangedCount();
  const auto inputAt = [&](std::uint64_t index) {
    return index < unchanged ? corpus.unchanged(index)
                             : corpus.mutated(options.first + index - unchanged, options.seed);
  };
  WatchedWork work;
  work.count = unchanged + options.count;
  work.processes = options.jobs;
  work.check = [&](std::uint64_t index) { return scratch.wrongWith(inputAt(index), index); };
  work.report = [&](std::uint64_t index, const std::string& wrong) {
    const Input input = inputAt(index);
    fs::create_directories(options.keep);
    const std::string number = index < unchanged ? "model-" + std::to_string(index)
                                                 : std::to_string(options.first + index - unchanged);
    const fs::path kept = options.keep / (number + "-" + input.name);
    std::ofstream(kept, std::ios::binary) << input.bytes;
    std::cout << nameOf(input.kind) << ' ' << kept.string() << ": " << wrong << std::endl;
  };
  const std::uint64_t failures = failuresOf(work);
  std::cout << "seed " << options.seed << ": " << unchanged << " files as they are and " << options.count
            << " changed ones, " << failures << " not taken as they should\n";
  return failures == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(optionsOf(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "fuzz: " << error.what() << '\n';
    return 2;
  }
}
