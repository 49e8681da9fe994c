#!/usr/bin/env bash
# The main job: installs what is missing, builds the carom program, renders every shipped scene to frames/<scene>/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

started=$SECONDS
install_missing_packages
build_release carom
built=$SECONDS

carom=build/release/demos/carom
frames=0
for path in assets/scenes/*.json; do
  scene=$(basename "$path" .json)
  echo "rendering $scene"
  report=$("$carom" render "$scene")
  echo "  $report"
  written=${report#*.png  }
  frames=$((frames + ${written%% *}))
done

echo "$frames frames in $PWD/frames/<scene>/frame_%04d.png, timings in each manifest.json"
echo "set-up and build $((built - started)) s, rendering $((SECONDS - built)) s"
