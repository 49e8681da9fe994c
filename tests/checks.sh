#!/usr/bin/env bash
# What holds beside the tests of the release build. checks.sh [STAGE...] runs the stages that are named; without names, those
# of `bash tests/run.sh --all`:
#
#   format      clang-format changes nothing
#   lint        clang-tidy finds nothing in the engine (.clang-tidy)
#   clang       another compiler builds the engine, its tests and the scenes' reader without a warning; the tests pass
#   sanitizers  the same under the address and undefined-behaviour sanitizers
#   hashes      every shipped scene ends in one state by gcc, by clang and under those sanitizers
#   threads     the tests of several threads under the thread sanitizer
#
# and, by name only, since they take longer:
#
#   certified   the engine's and the physics' tests, every answer of V-Clip certified
#   coverage    the share of the engine's lines that its tests run
#
# CAROM_CHECKS_END_S: how many seconds may have passed since CAROM_CHECKS_BEGAN (seconds of the epoch; now) when the last
# stage is over. What would not be, by the seconds in `takes`, is named and not begun, and what is not over then is ended;
# neither is a failure. Exit 1: a stage found something.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

stages=(format lint clang sanitizers hashes threads)
# Seconds on two cores without a compiler cache.
declare -A takes=([format]=20 [lint]=260 [clang]=450 [sanitizers]=800 [hashes]=300 [threads]=300 [certified]=1800 [coverage]=1500)
scene_s=0.5  # simulated, of each scene
# These folders are being written anew and are not free of findings yet.
not_linted='^engine/(simulation|response)/'
engine_builds=(engine_tests state_hashes)

# say_unless_right COMMAND...: shows what it said only when it fails, without the lines of progress.
say_unless_right() {
  local log
  log=$(mktemp)
  "$@" >"$log" 2>&1 || { grep -vE '^\[[0-9]+/[0-9]+\]' "$log" | tail -n 100; rm -f "$log"; return 1; }
  rm -f "$log"
}

# build_engine PRESET TARGET...: in a folder of its own, without a renderer, warnings being errors.
build_engine() {
  local preset=$1 folder
  folder=$(build_folder "checks-$preset")
  shift
  # Sanitizers' builds are for one run: little optimised, lines alone for their reports.
  say_unless_right cmake --preset "$preset" -B "$folder" -DCAROM_RENDERER=OFF -DCAROM_WARNINGS_ARE_ERRORS=ON \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DNDEBUG" &&
    say_unless_right cmake --build "$folder" -j"$(nproc)" --target "$@"
}

# run_shared PROGRAM: a program of tests, its tests shared out between the processors.
run_shared() {
  local shard pids=() code=0
  for ((shard = 0; shard < $(nproc); ++shard)); do
    GTEST_TOTAL_SHARDS=$(nproc) GTEST_SHARD_INDEX=$shard say_unless_right "$1" --gtest_brief=1 &
    pids+=($!)
  done
  for shard in "${pids[@]}"; do wait "$shard" || code=1; done
  return $code
}

# engine_tests_of PRESET
engine_tests_of() {
  build_engine "$1" "${engine_builds[@]}" && run_shared "$(build_folder "checks-$1")/tests/engine_tests"
}

# Another version formats some lines in another way: the tree is that of Debian 12's.
format() {
  local formatter=clang-format
  ! command -v clang-format-14 >/dev/null || formatter=clang-format-14
  if ! "$formatter" --version | grep -q 'version 14\.'; then echo "format: only clang-format 14 can tell"; return 0; fi
  git ls-files '*.h' '*.cpp' | xargs "$formatter" --dry-run --Werror
}

lint() {
  say_unless_right cmake --preset release -B "$(build_folder release)" &&
    git ls-files 'engine/*.cpp' | grep -vE "$not_linted" |
    xargs -P "$(nproc)" -n 4 clang-tidy -p "$(build_folder release)" --quiet 2>/dev/null
}

clang() { engine_tests_of clang; }
sanitizers() { engine_tests_of asan+ubsan; }

# hashes_of FOLDER: a line a scene.
hashes_of() {
  printf '%s\n' assets/scenes/*.json | xargs -P "$(nproc)" -n 1 "$1/tests/state_hashes" "$scene_s" | sort
}

hashes() {
  local expected found preset code=0
  say_unless_right cmake --preset release -B "$(build_folder release)" &&
    say_unless_right cmake --build "$(build_folder release)" -j"$(nproc)" --target state_hashes || return 1
  expected=$(hashes_of "$(build_folder release)") || return 1
  [ "$(wc -l <<<"$expected")" -eq "$(printf '%s\n' assets/scenes/*.json | wc -l)" ] || { echo "not every scene has a hash"; return 1; }
  for preset in clang asan+ubsan; do
    build_engine "$preset" state_hashes || return 1
    found=$(hashes_of "$(build_folder "checks-$preset")") || return 1
    diff <(echo "$expected") <(echo "$found") | sed -n "s/^[<>]/$preset differs: &/p" || true
    [ "$expected" = "$found" ] || code=1
  done
  return $code
}

threads() {
  build_engine tsan threads_tests &&
    TSAN_OPTIONS="suppressions=$PWD/tests/thread_sanitizer.supp" run_shared \
      "$(build_folder checks-tsan)/tests/threads_tests"
}

certified() {
  build_engine debug engine_tests physics_tests &&
    say_unless_right ctest --test-dir "$(build_folder checks-debug)" --output-on-failure -j"$(nproc)" -L 'unit|physics'
}

coverage() {
  local folder
  folder=$(build_folder checks-coverage)
  say_unless_right cmake --preset debug -B "$folder" -DCAROM_RENDERER=OFF -DCAROM_PROGRAM=OFF \
    -DCMAKE_CXX_FLAGS_DEBUG="-O1 -DNDEBUG --coverage -fprofile-update=atomic" &&
    say_unless_right cmake --build "$folder" -j"$(nproc)" --target engine_tests no_allocation_tests physics_tests || return 1
  find "$folder" -name '*.gcda' -delete
  say_unless_right ctest --test-dir "$folder" --output-on-failure -j"$(nproc)" -E Architecture || return 1
  python3 tests/coverage.py "$folder"
}

if [ $# -gt 0 ]; then stages=("$@"); fi
for stage in "${stages[@]}"; do
  [ -n "${takes[$stage]-}" ] || { echo "no stage $stage; accepted: ${!takes[*]}" >&2; exit 2; }
done
install_missing_packages "${carom_packages[@]}" clang clang-format clang-tidy git

began=${CAROM_CHECKS_BEGAN:-$(date +%s)} failed=0
for stage in "${stages[@]}"; do
  now=$(date +%s)
  if [ -z "${CAROM_CHECKS_END_S-}" ]; then
    if "$stage"; then word=right; else word=WRONG failed=1; fi
    echo "$stage: $word, $(($(date +%s) - now)) s"
    continue
  fi
  left=$((began + CAROM_CHECKS_END_S - now)) code=0
  if [ "${takes[$stage]}" -gt "$left" ]; then
    echo "$stage: not begun, as $left s are left; bash tests/checks.sh $stage"
    continue
  fi
  env -u CAROM_CHECKS_END_S timeout --kill-after=10 "$left" bash tests/checks.sh "$stage" || code=$?
  case $code in
    0) ;;
    124 | 137) echo "$stage: not over after $left s; bash tests/checks.sh $stage" ;;
    *) failed=1 ;;
  esac
done
exit $failed
