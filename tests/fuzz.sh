#!/usr/bin/env bash
# Feeds the readers inputs as strangers write them, built with the address and undefined-behaviour sanitizers.
#   fuzz.sh --count 100000 --seed 1 [--models FOLDER]   our own changes (tests/fuzz/fuzz.cpp), also through the program;
#                                                       what is not taken as it should be is kept in fuzz-failures/
#   fuzz.sh --libfuzzer [SECONDS [KIND...]]             libFuzzer (clang) on each reader for so long (600 s), from the
#                                                       seeds in tests/fuzz/seeds/; finds are kept in fuzz-failures/KIND-*
# KIND: scene, recording, mesh, png, queries, words (of the command line). The exit code is 1 where there is a find. A folder
# of more meshes, each read as it is before it is changed, is for example /usr/share/assimp/models of the Debian package
# assimp-testmodels, which is taken where it is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

# Readers may be refused memory; that is an answer, not an end.
export ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=0:${ASAN_OPTIONS-}"

# fuzz_by_libfuzzer SECONDS KIND...
fuzz_by_libfuzzer() {
  local seconds=$1 build kind code=0
  shift
  build=$(build_folder libfuzzer)
  install_missing_packages "${carom_packages[@]}" clang
  build_preset libfuzzer "${@/#/fuzz_}"
  mkdir -p fuzz-failures
  for kind in "$@"; do
    mkdir -p "$build/found/$kind"
    echo "$kind, for $seconds s"
    "$build/tests/fuzz_$kind" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -max_len=20000 -print_final_stats=1 \
      -artifact_prefix="fuzz-failures/$kind-" "$build/found/$kind" "tests/fuzz/seeds/$kind" >"$build/found/$kind.log" 2>&1 ||
      { grep -E 'ERROR|SUMMARY|^[a-z]+: |Test unit' "$build/found/$kind.log" >&2; code=1; }
    grep -E 'number_of_executed_units|DONE' "$build/found/$kind.log" || true
  done
  return $code
}

if [ "${1-}" = --libfuzzer ]; then
  seconds=${2:-600}
  kinds=("${@:3}")
  [ ${#kinds[@]} -gt 0 ] || kinds=(scene recording mesh png queries words)
  fuzz_by_libfuzzer "$seconds" "${kinds[@]}"
  exit
fi

install_missing_packages
build_preset asan+ubsan fuzz carom

models=/usr/share/assimp/models
more=()
[[ " $* " == *" --models "* || ! -d $models ]] || more=(--models "$models")
build=$(build_folder asan+ubsan)
exec "$build/tests/fuzz" --program "$build/demos/carom" "${more[@]}" "$@"
