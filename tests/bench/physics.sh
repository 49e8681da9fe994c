#!/usr/bin/env bash
# The table of closed forms: installs what is missing, builds, and runs `physics` with the arguments given (rows, --all,
# --list; none: every row but the long ones). Exit code 1 when a goal of ours is missed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source demos/packages.sh

install_missing_packages "${carom_packages[@]}" libbenchmark-dev
install_missing_packages "${benchmark_peers[@]}" || echo "comparing with the peers that are there" >&2
build_preset bench physics
build/bench/tests/bench/physics "$@"
