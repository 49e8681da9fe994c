#!/usr/bin/env bash
# Installs what is missing, builds everything, runs the tests but those of tests/long_tests.txt. With arguments, which go to
# ctest (for example: -R Frame), the tests that they choose, long ones too. With --all: every test, with the tools without which
# some are skipped, and after the tests what checks.sh lists, as far as an hour is enough for it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

CAROM_CHECKS_BEGAN=$(date +%s)
all=false
if [ "${1-}" = --all ]; then all=true; shift; fi
install_missing_packages "${carom_packages[@]}" glslang-tools  # glslangValidator checks the shaders
install_missing_packages libosmesa6 || echo "tests of both ways to GL find one" >&2
if $all; then
  # What cannot be had leaves its tests skipped.
  install_what_is_had openimageio-tools chromium python3-numpy doxygen pngcheck zsh fish groff
  command -v npm >/dev/null || install_what_is_had npm
  if command -v npm >/dev/null; then
    timeout 100 npm install --silent --no-audit --no-fund --prefix "$(build_folder npm)" gltf-validator >/dev/null 2>&1 ||
      echo "without gltf-validator its test is skipped" >&2
    NODE_PATH="$(realpath -m "$(build_folder npm)/node_modules")${NODE_PATH:+:$NODE_PATH}"
    export NODE_PATH
  fi
fi
build_release all
left_out=()
if ! $all && [ $# -eq 0 ]; then left_out=(-E "^($(grep -v '^#' tests/long_tests.txt | paste -sd '|'))"); fi
code=0
ctest --test-dir "$(build_folder release)" --output-on-failure -j2 "${left_out[@]}" "$@" || code=$?
if $all; then
  export CAROM_CHECKS_BEGAN CAROM_CHECKS_END_S=${CAROM_CHECKS_END_S:-3450}
  bash tests/checks.sh || code=$?
fi
exit $code
