# What the build needs, by Debian's and Ubuntu's names, in one place: sourced by demos/run.sh, tests/run.sh and
# tests/bench/run.sh. install_missing_packages [PACKAGE...] installs what is missing (root or sudo); without the right to,
# one line says what is missing. Where there is no apt-get, configuring says what is missing. CAROM_BUILD names another
# folder than build/ for what is built, when the checkout cannot be written to.

# "a,b|c": a and b, or where the distribution has not both of them, c.
carom_packages=(g++ cmake ninja-build pkg-config libeigen3-dev libgl-dev libegl-dev libassimp-dev libpng-dev libqhull-dev
  libjpeg-dev libcairo2-dev fonts-dejavu-core libcli11-dev nlohmann-json3-dev libtinygltf-dev libgtest-dev python3
  "libosmesa6|libegl1,libegl-mesa0,libgl1-mesa-dri")  # Mesa has had no OSMesa since 25.1
# ISA-L packs frames five times as fast as zlib; it is for these processors, and the build does without.
case "$(uname -m)" in x86_64 | aarch64) carom_packages+=(libisal-dev) ;; esac
# What the benchmarks compare with; each can be missing.
benchmark_peers=(libfcl-dev libccd-dev libbullet-dev libode-dev)

# are_installed PACKAGE...
are_installed() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || return 1
  done
}

# are_offered PACKAGE...: whether apt knows a version of each.
are_offered() {
  local package
  for package in "$@"; do
    apt-cache policy "$package" 2>/dev/null | grep -q 'Candidate: [^(]' || return 1
  done
}

# needed_of "a,b|c": the packages of the first choice that is offered; nothing when one of them is installed.
needed_of() {
  local choice choices packages
  IFS='|' read -ra choices <<<"$1"
  for choice in "${choices[@]}"; do
    IFS=, read -ra packages <<<"$choice"
    if are_installed "${packages[@]}"; then return 0; fi
  done
  for choice in "${choices[@]}"; do
    IFS=, read -ra packages <<<"$choice"
    if are_offered "${packages[@]}"; then break; fi
  done
  echo "${packages[@]}"
}

install_missing_packages() {
  local wanted=("$@") missing=() entry as_root=()
  [ $# -gt 0 ] || wanted=("${carom_packages[@]}")
  command -v apt-get >/dev/null || return 0
  for entry in "${wanted[@]}"; do [ -z "$(needed_of "$entry")" ] || missing+=("$entry"); done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    # sudo counts when it asks for nothing, or when there is a person to answer.
    if ! command -v sudo >/dev/null || { [ ! -t 0 ] && ! sudo -n true 2>/dev/null; }; then
      echo "missing packages, and no right to install them: apt-get install $(for entry in "${missing[@]}"; do needed_of "$entry"; done | xargs)" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  local log packages=()
  log=$(mktemp)
  "${as_root[@]}" apt-get update -qq >"$log" 2>&1 || true  # what is offered may be known all the same
  for entry in "${missing[@]}"; do packages+=($(needed_of "$entry")); done
  echo "installing ${packages[*]}"
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" \
       >>"$log" 2>&1; then
    tail -n 20 "$log" >&2
    rm -f "$log"
    echo "could not install: ${packages[*]}" >&2
    return 1
  fi
  rm -f "$log"
}

# install_what_is_had PACKAGE...: one that cannot be had does not keep the others away, and is no failure.
install_what_is_had() {
  local told package
  if told=$(install_missing_packages "$@" 2>&1); then return 0; fi
  case $told in missing\ packages*) echo "$told" >&2; return 0 ;; esac
  for package in "$@"; do install_missing_packages "$package" >/dev/null 2>&1 || echo "could not install: $package" >&2; done
}

# build_folder PRESET: where that preset is built.
build_folder() { echo "${CAROM_BUILD:-build}/$1"; }

# build_release TARGET...: configures the release preset and builds the targets.
build_release() { build_preset release "$@"; }

# build_preset PRESET TARGET...: configures the preset and builds the targets, in the checkout's root. Speaks only of
# phases unless something fails. Warnings are errors where CAROM_WARNINGS_ARE_ERRORS says so. A folder that a developer has
# configured by the preset alone, which precompiles no headers, stays as it is.
build_preset() {
  local preset=$1 folder log
  local own=(-DCAROM_WARNINGS_ARE_ERRORS="${CAROM_WARNINGS_ARE_ERRORS:-OFF}" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=OFF)
  folder=$(build_folder "$preset")
  ! grep -qs '^CMAKE_DISABLE_PRECOMPILE_HEADERS:[A-Z]*=ON' "$folder/CMakeCache.txt" || own=()
  shift
  log=$(mktemp)
  echo "configuring $folder"
  cmake --preset "$preset" -B "$folder" "${own[@]}" >"$log" 2>&1 || { cat "$log" >&2; rm -f "$log"; echo "configuring failed" >&2; return 1; }
  echo "building $* with $(nproc) jobs"
  cmake --build "$folder" -j"$(nproc)" --target "$@" >"$log" 2>&1 ||
    { grep -vE '^\[[0-9]+/[0-9]+\]' "$log" | head -n 60 >&2; rm -f "$log"; echo "building failed" >&2; return 1; }
  rm -f "$log"
}
