#!/usr/bin/env bash
# Builds the program with the address and undefined-behaviour sanitizers and feeds it inputs as strangers write them
# (tests/fuzz/fuzz.cpp): fuzz.sh --count 100000 --seed 1 [--models FOLDER]. What is not taken as it should be is kept
# in fuzz-failures/, and the exit code is 1. A folder of more meshes, each read as it is before it is changed, is for
# example /usr/share/assimp/models of the Debian package assimp-testmodels, which is taken where it is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

install_missing_packages
build_preset asan+ubsan fuzz carom

models=/usr/share/assimp/models
more=()
[[ " $* " == *" --models "* || ! -d $models ]] || more=(--models "$models")
# Readers may be refused memory; that is an answer, not an end.
export ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=0:${ASAN_OPTIONS-}"
build=$(build_folder asan+ubsan)
exec "$build/tests/fuzz" --program "$build/demos/carom" "${more[@]}" "$@"
