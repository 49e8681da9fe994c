#!/usr/bin/env bash
# What holds beside the tests of the release build. checks.sh [STAGE...] runs the stages that are named; without names, those
# of `bash tests/run.sh --all`:
#
#   format      clang-format changes nothing
#   lint        clang-tidy finds nothing in the engine (.clang-tidy)
#   threads     the tests of several threads under the thread sanitizer
#   hashes      every shipped scene ends in one state by gcc, and by clang under the address and undefined-behaviour sanitizers
#   clang       the engine's and the physics' tests pass as clang optimises them, every answer of V-Clip certified, and run
#               nine tenths of the engine's lines
#   processors  every shipped scene ends in that state on aarch64 too, by Debian's cross compiler and qemu
#   sanitizers  the engine's tests pass under those sanitizers
#
# The tests that repeat one thing by the hundred thousand are left out of `clang` and `sanitizers`, which slow them down.
#
# CAROM_CHECKS_END_S: how many seconds may have passed since CAROM_CHECKS_BEGAN (seconds of the epoch; now) when the last
# stage is over. What would not be, by the seconds in `takes`, is named and not begun, and what is not over then is ended;
# neither is a failure, nor is a stage whose tools cannot be had or do not run here. Exit 1: a stage found something.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

# What is cheap and tells most comes first; the hashes leave the sanitizers half of their build.
stages=(format lint threads hashes clang processors sanitizers)
# Seconds on two cores without a compiler cache.
declare -A takes=([format]=20 [lint]=120 [threads]=200 [hashes]=300 [clang]=520 [processors]=300 [sanitizers]=500)
scene_s=0.5  # simulated, of each scene

left_out=77  # what a stage returns that cannot be run here
# is_had PROGRAM
is_had() {
  command -v "$1" >/dev/null || { echo "there is no $1 here"; return 1; }
}

# llvm_14 PROGRAM: its name here. Another version formats some lines in another way and finds other things: the tree is held
# to that of Debian 12.
llvm_14() {
  local name
  for name in "$1-14" "$1"; do
    if "$name" --version 2>/dev/null | grep -q 'version 14\.'; then echo "$name"; return 0; fi
  done
  echo "only $1 14 can tell" >&2
  return 1
}

# say_unless_right COMMAND...: shows what it said only when it fails, without the lines of progress.
say_unless_right() {
  local log
  log=$(mktemp)
  "$@" >"$log" 2>&1 || { grep -vE '^\[[0-9]+/[0-9]+\]' "$log" | tail -n 100; rm -f "$log"; return 1; }
  rm -f "$log"
}

# configure_engine PRESET: in a folder of its own, without a renderer, warnings being errors. Sanitizers' builds are for one
# run: by clang, which takes two thirds of gcc's time for them, lines alone for their reports. The engine is
# compiled several files at a time, so that what they include is read once. What clang optimises asserts, and so certifies.
configure_engine() {
  local own=()
  case $1 in
    *san) own=(-DCMAKE_CXX_COMPILER=clang++) ;;
    clang)
      own=(-DCAROM_PROGRAM=OFF -DCMAKE_CXX_FLAGS_RELEASE=-O3 -DCMAKE_EXE_LINKER_FLAGS=-fprofile-instr-generate
        -DCAROM_ENGINE_OPTIONS="-fprofile-instr-generate;-fcoverage-mapping;-fprofile-list=$PWD/tests/coverage.list")
      ;;
  esac
  say_unless_right cmake --preset "$1" -B "$(build_folder "checks-$1")" "${own[@]}" -DCAROM_RENDERER=OFF \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g1 -DNDEBUG"
}

# build_engine PRESET TARGET...
build_engine() {
  local preset=$1
  shift
  configure_engine "$preset" &&
    say_unless_right cmake --build "$(build_folder "checks-$preset")" -j"$(nproc)" --target "$@"
}

# sanitizers_run NAMES: whether a program that does nothing runs under them, several times. Some kernels lay a program's memory
# out at random in ways that they do not know, and some containers do not let them look at it.
sanitizers_run() {
  local probe
  is_had clang++ || return 1
  probe=$(mktemp)
  if clang++ -fsanitize="$1" -x c++ - -o "$probe" <<<'int main() {}' >/dev/null 2>&1 &&
    for _ in {1..20}; do "$probe" >/dev/null 2>&1 || break; done && "$probe" >/dev/null 2>&1; then
    rm -f "$probe"
    return 0
  fi
  rm -f "$probe"
  echo "the $1 sanitizer does not run here"
  return 1
}

# run_shared PROGRAM [FILTER]: a program of tests, its tests shared out between the processors.
run_shared() {
  local shard pids=() code=0
  for ((shard = 0; shard < $(nproc); ++shard)); do
    GTEST_TOTAL_SHARDS=$(nproc) GTEST_SHARD_INDEX=$shard say_unless_right "$1" --gtest_brief=1 --gtest_filter="${2-*}" &
    pids+=($!)
  done
  for shard in "${pids[@]}"; do wait "$shard" || code=1; done
  return $code
}

# What is repeated by the hundred thousand: half an hour under the sanitizers, some minutes where each answer is certified.
often_repeated="VClip/RandomPairs.*:*AnySeed*:*AMillion*:*HundredThousand*:*/gons:*/nearly_parallel:*/concentric:Threads.*"
often_repeated+=":RoundedMass.OfAnyHull*:PointCollision.WithCurvedSlip*:CapCover.*:*200Gons*:ConvexHull.OfASphereFiner*"

# tests_of PRESET FILTER PROGRAM...: builds those programs of tests and runs the tests that the filter lets through.
tests_of() {
  local preset=$1 filter=$2 program
  shift 2
  build_engine "$preset" "$@" || return 1
  for program in "$@"; do run_shared "$(build_folder "checks-$preset")/tests/$program" "$filter" || return 1; done
}

format() {
  local formatter
  formatter=$(llvm_14 clang-format) || return $left_out
  find engine renderer demos tests -name '*.h' -o -name '*.cpp' | xargs "$formatter" --dry-run --Werror
}

# Reads what the sanitizers' build compiles, which is several files at a time.
lint() {
  local linter folder found
  linter=$(llvm_14 clang-tidy) && is_had clang++ || return $left_out
  build_engine asan+ubsan carom_foundation || return 1  # with the headers that it precompiles
  folder=$(realpath "$(build_folder checks-asan+ubsan)")
  found=$(grep -F -e "\"file\": \"$PWD/engine/" -e "\"file\": \"$folder/engine/" "$folder/compile_commands.json" |
    sed -E 's/^ *"file": "(.*)",?$/\1/' |
    xargs -d '\n' -P "$(nproc)" -n 1 "$linter" -p "$folder" --quiet 2>&1) && return 0
  grep -E '(error|warning): ' <<<"$found" | sort -u || tail -n 20 <<<"$found"
  return 1
}

threads() {
  sanitizers_run thread || return $left_out
  build_engine tsan threads_tests &&
    TSAN_OPTIONS="suppressions=$PWD/tests/thread_sanitizer.supp" run_shared \
      "$(build_folder checks-tsan)/tests/threads_tests"
}

sanitizers() {
  sanitizers_run address,undefined || return $left_out
  tests_of asan+ubsan "-$often_repeated" engine_tests
}

# hashes_of FOLDER: a line a scene.
hashes_of() {
  printf '%s\n' assets/scenes/*.json | xargs -P "$(nproc)" -n 1 "$1/tests/hashes/state_hashes" "$scene_s" | sort
}

# hashes_agree PRESET: with those of the release build.
hashes_agree() {
  local expected found
  say_unless_right build_release state_hashes && build_engine "$1" state_hashes || return 1
  expected=$(hashes_of "$(build_folder release)") && found=$(hashes_of "$(build_folder "checks-$1")") || return 1
  [ "$(wc -l <<<"$expected")" -eq "$(printf '%s\n' assets/scenes/*.json | wc -l)" ] || { echo "not every scene has a hash"; return 1; }
  [ "$expected" != "$found" ] || return 0
  diff <(echo "$expected") <(echo "$found") | sed -n "s/^[<>]/$1 differs: &/p"
  return 1
}

hashes() {
  sanitizers_run address,undefined || return $left_out
  hashes_agree asan+ubsan
}

clang() {
  is_had clang++ && is_had llvm-cov-14 || return $left_out
  local programs profiles
  profiles=$(realpath -m "$(build_folder checks-clang)/profiles")
  programs=("$(build_folder checks-clang)"/tests/{engine,physics}_tests)
  rm -rf "$profiles"
  LLVM_PROFILE_FILE=$profiles/%p.profraw tests_of clang "-$often_repeated" engine_tests physics_tests || return 1
  python3 tests/coverage.py "$profiles" "${programs[@]}"
}

processors() {
  install_what_is_had g++-aarch64-linux-gnu qemu-user mmdebstrap
  is_had aarch64-linux-gnu-g++ && is_had qemu-aarch64 && is_had mmdebstrap || return $left_out
  SCENE_S=$scene_s bash tests/hash_table.sh --states release aarch64-O3
}

if [ $# -gt 0 ]; then stages=("$@"); fi
for stage in "${stages[@]}"; do
  [ -n "${takes[$stage]-}" ] || { echo "no stage $stage; accepted: ${!takes[*]}" >&2; exit 2; }
done
install_what_is_had "${carom_packages[@]}" clang clang-format clang-tidy llvm-14

began=${CAROM_CHECKS_BEGAN:-$(date +%s)} failed=0
for stage in "${stages[@]}"; do
  now=$(date +%s)
  if [ -z "${CAROM_CHECKS_END_S-}" ]; then
    code=0
    "$stage" || code=$?
    case $code in
      0) word=right ;;
      $left_out) word="left out" ;;
      *) word=WRONG failed=1 ;;
    esac
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
