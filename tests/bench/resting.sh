#!/usr/bin/env bash
# What a world at rest costs: installs what is missing, builds, and runs `resting` with the arguments given (none: 1000,
# 8000 and 20 000 at rest). Prints a table in Markdown, headed by date, machine and commit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source demos/packages.sh

install_missing_packages "${carom_packages[@]}" libbenchmark-dev
install_missing_packages "${benchmark_peers[@]}" || echo "comparing with the peers that are there" >&2
build_preset bench resting >&2

echo "## Sixty in flight over many at rest"
echo "$(date -u +%F), $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2- | sed 's/^ *//'), $(git rev-parse --short HEAD)"
echo
build/bench/tests/bench/resting "$@"
