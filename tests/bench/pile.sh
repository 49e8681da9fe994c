#!/usr/bin/env bash
# What piles cost while they move, from release to quiet: installs what is missing, builds, and runs `piles` with the
# arguments given (rows, --all, --list; none: every row but the long ones), then with --all what 20 000 bodies at rest cost
# while 60 fly (resting.sh). Exit code 1 when a body of ours is stopped in more than 0.1 % of its steps.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source demos/packages.sh

install_missing_packages "${carom_packages[@]}" libbenchmark-dev
install_missing_packages "${benchmark_peers[@]}" || echo "comparing with the peers that are there" >&2
build_preset bench piles
code=0
build/bench/tests/bench/piles "$@" || code=$?
if [ "${1-}" = --all ]; then bash tests/bench/resting.sh 20000; fi
exit "$code"
