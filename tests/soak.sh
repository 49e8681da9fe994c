#!/usr/bin/env bash
# One world of bodies that a piston throws up again and again (tests/explore/soak/soak.json), for a simulated day: every step
# held against the explorer's oracles, the memory looked at all the while. soak.sh [--hours 24] [--scene FILE]
# Exit code 1: an oracle finds something, or the memory grows.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

install_missing_packages
build_release soak
exec "$(build_folder release)/tests/soak" "$@"
