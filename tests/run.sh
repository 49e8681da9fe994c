#!/usr/bin/env bash
# Installs what is missing, builds everything, runs the tests. Arguments go to ctest (for example: -R Frame).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

install_missing_packages "${carom_packages[@]}" glslang-tools  # glslangValidator checks the shaders
build_release all
ctest --test-dir "$(build_folder release)" --output-on-failure -j2 "$@"
