#!/usr/bin/env bash
# One state hash everywhere: builds the program without its renderer by several compilers, at several levels, for several
# processors (Debian's cross compilers, run by qemu-user), simulates every shipped scene and 200 random worlds of the
# explorer with each, and prints a table of what equals the first cell's. hash_table.sh [CELL...]; without cells, those
# that can be built here; the cell `release` is the release build as it is. Scenes run for SCENE_S seconds (1), SEEDS random
# worlds (200) for SEED_S (0.25). hash_table.sh --states [CELL...] builds half of the program and looks at the states of the
# scenes alone (SEEDS worlds more, where it is set).
#
# A cell's libraries come from a folder made by mmdebstrap, once, from Debian 12's packages (13's for riscv64, which 12 has no
# release for); what is needed:
#   apt-get install clang mmdebstrap qemu-user g++-{aarch64,i686,powerpc64le,riscv64,s390x}-linux-gnu
# The cell wasm-O2, for --states, is WebAssembly by emscripten and node, in a system of its own (hashes/webassembly.sh; root).
# Exit 1: a cell differs; each difference is a line of build/hashes/CELL.differs. Exit 77: a cell's libraries cannot be had.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh
source tests/clean_system.sh

SCENE_S=${SCENE_S:-1} SEED_S=${SEED_S:-0.25} JOBS=${JOBS:-$(nproc)}
work=${CAROM_BUILD:-build}/hashes
mkdir -p "$work"
target=carom program=demos/carom random_worlds=200
if [ "${1-}" = --states ]; then
  target=state_hashes program=tests/hashes/state_hashes random_worlds=0
  shift
fi
SEEDS=${SEEDS:-$random_worlds}
work=$(realpath "$work")

# cell: compiler | flags | Debian's architecture | qemu-user's | Debian's release, where it is not bookworm
declare -A cells=(
  [release]="g++|-O3" [gcc-O3]="g++|-O3" [gcc-O2]="g++|-O2" [gcc-O0]="g++|-O0" [gcc-O3-avx2]="g++|-O3 -mavx2 -mfma"
  [clang-O3]="clang++|-O3" [clang-O2]="clang++|-O2" [clang-O0]="clang++|-O0" [clang-O3-avx2]="clang++|-O3 -mavx2 -mfma"
  [i686-O3]="i686-linux-gnu-g++|-O3 -msse2 -mfpmath=sse|i386|i386" [aarch64-O3]="aarch64-linux-gnu-g++|-O3|arm64|aarch64"
  [aarch64-O2]="aarch64-linux-gnu-g++|-O2|arm64|aarch64" [ppc64el-O3]="powerpc64le-linux-gnu-g++|-O3|ppc64el|ppc64le"
  [s390x-O3]="s390x-linux-gnu-g++|-O3|s390x|s390x"
  [riscv64-O3]="riscv64-linux-gnu-g++|-O3|riscv64|riscv64|trixie" [wasm-O2]="em++|-O2|wasm|node")
order=(gcc-O3 gcc-O2 gcc-O0 gcc-O3-avx2 clang-O3 clang-O2 clang-O0 clang-O3-avx2 i686-O3 aarch64-O3 aarch64-O2 ppc64el-O3
  s390x-O3 riscv64-O3)

# field NAME NUMBER: of a cell's description.
field() { cut -d'|' -f"$2" <<<"${cells[$1]}"; }

# system_root CELL: the folder with that architecture's libraries, made where it is not there.
system_root() {
  local architecture release root archive
  architecture=$(field "$1" 3) release=$(field "$1" 5)
  root=${CAROM_SYSTEM_ROOTS:-$work/roots}/$architecture
  if [ ! -d "$root/usr" ] && [ "$architecture" = wasm ]; then
    bash tests/hashes/webassembly.sh make "$root" || return 1
  elif [ ! -d "$root/usr" ]; then
    mkdir -p "$(dirname "$root")"
    # The main archive alone: that of security updates may not hold together while it changes.
    archive=$(main_archive)
    mmdebstrap --quiet --variant=extract --architectures="$architecture" --include=libc6-dev,libstdc++-12-dev,libassimp-dev,draco,libqhull-dev,libpng-dev,libtinygltf-dev,nlohmann-json3-dev,libcli11-dev,libeigen3-dev \
      "${release:-bookworm}" "$root" ${archive:+"$archive"} >&2 || { rm -rf "$root"; return 1; }
    [ -e "$root/lib" ] || ln -s usr/lib "$root/lib"  # later releases make it when they are installed
    # What names places from the root up means this one.
    find "$root"/usr/{lib,share} -path '*/cmake/draco/*.cmake' -o -path '*/cmake/assimp-*/*.cmake' | xargs sed -i "s|/usr/|$root/usr/|g"
    find "$root"/lib*/ "$root/usr/lib" -type l -lname '/*' | while read -r link; do
      ln -sfn "$root$(readlink "$link")" "$link"
    done
  fi
  echo "$root"
}

# build CELL: the program of that cell; says nothing unless it fails.
build() {
  local folder=$work/$1 debian root more=()
  if [ "$1" = release ]; then build_release "$target" >&2; return; fi
  debian=$(field "$1" 3)
  if [ -n "$debian" ]; then
    root=$(system_root "$1") || { echo "the libraries of $1 cannot be had" >&2; exit 77; }
    if [ "$debian" = wasm ]; then
      [ "$target" = state_hashes ] || { echo "$1 is for --states" >&2; return 1; }
      bash tests/hashes/webassembly.sh build "$root" "$folder" "$(field "$1" 2)" >"$folder.log" 2>&1 || { tail -n 20 "$folder.log" >&2; return 1; }
      return
    fi
    more=(-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR="$(field "$1" 4)" -DCMAKE_SYSROOT="$root"
      -DCMAKE_FIND_ROOT_PATH="$root" -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY
      -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER)
    # Libraries of a newer release than the compiler's find what they need where they run.
    [ -z "$(field "$1" 5)" ] || more+=(-DCMAKE_EXE_LINKER_FLAGS=-Wl,--allow-shlib-undefined)
    export PKG_CONFIG_SYSROOT_DIR=$root PKG_CONFIG_LIBDIR
    PKG_CONFIG_LIBDIR=$(find "$root/usr" -name pkgconfig -type d | paste -sd:)
  else
    unset PKG_CONFIG_SYSROOT_DIR PKG_CONFIG_LIBDIR
  fi
  { cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$(field "$1" 1)" \
      -DCMAKE_CXX_FLAGS_RELEASE="$(field "$1" 2) -DNDEBUG" -DCAROM_RENDERER=OFF -DCAROM_BUILD_TESTS=OFF -DCMAKE_UNITY_BUILD=ON "${more[@]}" &&
    cmake --build "$folder" --target "$target" -j"$JOBS"; } >"$folder.log" 2>&1 || { tail -n 20 "$folder.log" >&2; return 1; }
}

# run_cell CELL ARGUMENTS...: its program.
run_cell() {
  local cell=$1 folder=$work/$1
  shift
  [ "$cell" != release ] || folder=$release
  if [ -z "$(field "$cell" 3)" ]; then
    "$folder/$program" "$@"
  elif [ "$(field "$cell" 3)" = wasm ]; then
    bash tests/hashes/webassembly.sh run "$(system_root "$cell")" "$folder/$program.js" "$@"
  else
    "qemu-$(field "$cell" 4)" -L "$(system_root "$cell")" "$folder/$program" "$@"
  fi
}

# hash_world CELL SCENE SECONDS: "name hash of the state, hash of the recording"; the way it failed where it did.
hash_world() {
  local name hash record=$work/$1.recordings
  name=$(basename "$2" .json)
  if [ "$target" = state_hashes ]; then echo "$(run_cell "$1" "$3" "$2" 2>/dev/null || echo "$name failed by $1") -"; return; fi
  hash=$(run_cell "$1" simulate "$2" --duration "$3" --fps 20 -q -o "$record/$name.carom" 2>/dev/null | head -n 1) || true
  echo "$name ${hash:-refused} $(cat "$record/$name.carom" 2>/dev/null | sha256sum | cut -c1-16)"
}

# hash_worlds CELL: a line a world, into CELL.hashes.
hash_worlds() {
  mkdir -p "$work/$1.recordings"
  { for scene in assets/scenes/*.json; do echo "$PWD/$scene $SCENE_S"; done
    [ "$SEEDS" -eq 0 ] || find "$work/worlds" -name '*.json' | sort -V | sed "s/\$/ $SEED_S/"; } |
    xargs -d '\n' -P "$JOBS" -n 1 bash -c 'hash_world "$0" "${1% *}" "${1##* }"' "$1" | sort >"$work/$1.hashes"
}
export -f hash_world run_cell field system_root main_archive
release=$(realpath -m "$(build_folder release)")
export work release target program

wanted=("$@")
if [ ${#wanted[@]} -eq 0 ]; then
  for cell in "${order[@]}"; do
    debian=$(field "$cell" 3)
    command -v "$(field "$cell" 1)" >/dev/null || continue
    [ -z "$debian" ] || command -v "qemu-$(field "$cell" 4)" >/dev/null || continue
    wanted+=("$cell")
  done
fi
for cell in "${wanted[@]}"; do
  [ -n "${cells[$cell]-}" ] || { echo "no cell $cell; accepted: release ${order[*]}" >&2; exit 2; }
done
# The shell's functions see an associative array only as text.
cells_text=$(declare -p cells)
export cells_text
field() { eval "$cells_text"; cut -d'|' -f"$2" <<<"${cells[$1]}"; }
export -f field

rm -rf "$work/worlds"
if [ "$SEEDS" -gt 0 ]; then
  build_release explore >&2
  "$(build_folder release)/tests/explore" --write "$work/worlds" --seeds "$SEEDS"
fi

first=${wanted[0]} code=0
echo "| cell | worlds | same states | same recordings | reads the first cell's |"
echo "|---|---|---|---|---|"
for cell in "${wanted[@]}"; do
  if ! build "$cell"; then echo "| $cell | not built | | | |"; code=1; continue; fi
  hash_worlds "$cell"
  join "$work/$first.hashes" "$work/$cell.hashes" | awk '$2 != $4 || $3 != $5' >"$work/$cell.differs"
  states=$(join "$work/$first.hashes" "$work/$cell.hashes" | awk '$2 == $4' | wc -l)
  recordings=$(join "$work/$first.hashes" "$work/$cell.hashes" | awk '$3 == $5' | wc -l)
  if [ "$target" = state_hashes ]; then
    echo "| $cell | $(wc -l <"$work/$cell.hashes") | $states | | |"
    [ ! -s "$work/$cell.differs" ] || code=1
    continue
  fi
  sum=$({ run_cell "$cell" export "$work/$first.recordings/imported-meshes.carom" -q --csv /dev/stdout || true; } | sha256sum | cut -c1-16)
  [ "$cell" != "$first" ] || first_sum=$sum
  echo "| $cell | $(wc -l <"$work/$cell.hashes") | $states | $recordings | $([ "$sum" = "$first_sum" ] && echo yes || echo no) |"
  [ ! -s "$work/$cell.differs" ] && [ "$sum" = "$first_sum" ] || code=1
done
exit $code
