# What the build needs on Debian 12, in one place: sourced by demos/run.sh, tests/run.sh and tests/bench/run.sh.
# install_missing_packages [PACKAGE...] installs what is missing (root or sudo); without the right to, one line says what is missing.

carom_packages=(g++ cmake ninja-build pkg-config libeigen3-dev libosmesa6-dev libegl-dev libassimp-dev libpng-dev libqhull-dev
  libcairo2-dev fonts-dejavu-core libcli11-dev nlohmann-json3-dev libtinygltf-dev libgtest-dev)
# ISA-L packs frames five times as fast as zlib; it is for these processors, and the build does without.
case "$(uname -m)" in x86_64 | aarch64) carom_packages+=(libisal-dev) ;; esac
# What the benchmarks compare with; each can be missing.
benchmark_peers=(libfcl-dev libccd-dev libbullet-dev libode-dev)

install_missing_packages() {
  local wanted=("$@") missing=() package as_root=()
  [ $# -gt 0 ] || wanted=("${carom_packages[@]}")
  for package in "${wanted[@]}"; do
    [ "$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    # sudo counts when it asks for nothing, or when there is a person to answer.
    if ! command -v sudo >/dev/null || { [ ! -t 0 ] && ! sudo -n true 2>/dev/null; }; then
      echo "missing packages, and no right to install them: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "installing ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -qq &&
         "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } \
       >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    rm -f "$log"
    echo "could not install: ${missing[*]}" >&2
    return 1
  fi
  rm -f "$log"
}

# build_release TARGET...: configures the release preset and builds the targets.
build_release() { build_preset release "$@"; }

# build_preset PRESET TARGET...: configures the preset and builds the targets, in the checkout's root. Speaks only of
# phases unless something fails.
build_preset() {
  local preset=$1 log
  shift
  log=$(mktemp)
  echo "configuring build/$preset"
  cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; rm -f "$log"; echo "configuring failed" >&2; return 1; }
  echo "building $* with $(nproc) jobs"
  cmake --build --preset "$preset" -j"$(nproc)" --target "$@" >"$log" 2>&1 ||
    { grep -vE '^\[[0-9]+/[0-9]+\]' "$log" | head -n 60 >&2; rm -f "$log"; echo "building failed" >&2; return 1; }
  rm -f "$log"
}
