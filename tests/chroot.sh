#!/usr/bin/env bash
# The steps of demos/package/Containerfile in clean systems that mmdebstrap makes (root; apt-get install mmdebstrap), then
# what a developer does: chroot.sh [SUITE [PACKAGES]], SUITE a release such as bookworm, trixie or sid.
#   build     a system for building, with both commands (demos/run.sh, tests/run.sh where TESTS=1) and the packages, in
#             which lintian finds no error
#   use       another: installs them, draws a scene, builds tests/package_example by CMake and by pkg-config, tests it, and
#             removes them: nothing of Carom is left
# PACKAGES, a folder of packages of the same release, takes the place of building them. Systems go to CHROOTS (a temporary
# folder, removed at the end).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tests/clean_system.sh

suite=${1:-bookworm} packages=${2-}
if [ -n "${CHROOTS-}" ]; then systems=$(realpath -m "$CHROOTS"); else systems=$(mktemp -d); trap 'rm -rf "$systems"' EXIT; fi
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8

inside() { inside_system "$systems/$1" "$2"; }
# steps STAGE: the RUN lines of the Containerfile's first or second stage.
steps() { awk -v stage="$1" '/^FROM/ { at++ } at == stage && sub(/^RUN /, "")' demos/package/Containerfile; }
run_steps() { steps "$2" | while read -r step; do echo "[$1] $step"; inside "$1" "cd ${3:-/}; $step" </dev/null; done; }

if [ -z "$packages" ]; then
  make_clean_system "$systems/build" "$suite"
  mkdir "$systems/build/src"
  git archive HEAD | tar -x -C "$systems/build/src"
  run_steps build 1 /src
  [ -z "${TESTS-}" ] || inside build "cd /src && bash tests/run.sh"
  inside build "apt-get install -y --no-install-recommends lintian && lintian --fail-on error /packages/*.deb"
  packages=$systems/build/packages
fi

make_clean_system "$systems/use" "$suite"
mkdir "$systems/use/packages"
cp "$packages"/*.deb "$systems/use/packages"
run_steps use 2
cp -r tests/package_example "$systems/use/root/example"
echo "[use] draws, builds and tests"
inside use "cd /root && carom render bouncing-ball -q --frames 0-5 && ls frames/bouncing-ball/frame_0005.png
  apt-get install -y --no-install-recommends /packages/libcarom-dev_*.deb g++ cmake make
  cmake -S example -B example/build && cmake --build example/build && ctest --test-dir example/build --output-on-failure
  g++ -O1 example/falling_ball.cpp -o falling_ball \$(pkg-config --cflags --libs carom-renderer) && ./falling_ball
  test -s /usr/share/man/man1/carom.1.gz -o -e /etc/dpkg/dpkg.cfg.d/docker
  rm -r frames example falling_ball .cache  # the shaders that a user keeps"
inside use "apt-get purge -y carom libcarom-dev && rm -r /packages"
left=$(find "$systems/use" -xdev -path "$systems/use/var" -prune -o -iname '*carom*' -print)
[ -z "$left" ] || { echo "left of it: $left" >&2; exit 1; }
echo "$suite: installed, used and removed"
