#!/usr/bin/env bash
# Explores: builds what it needs and runs random worlds and closest-feature queries against oracles (tests/explore/).
#   bash tests/explore.sh --seeds 100000      # so many seeds, on every core; --from S: beginning with that one
#   bash tests/explore.sh --seed S            # one seed in detail; its scene, and what fails, shrunk, in build/explored/
#   bash tests/explore.sh --scene FILE        # one scene file
# Other options: --help. Exit code 1 when something fails that tests/explore/open.txt does not cover.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

install_missing_packages
build_release explore
exec "$(build_folder release)/tests/explore" --jobs "$(nproc)" --open tests/explore/open.txt --cases tests/explore/cases "$@"
