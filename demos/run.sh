#!/usr/bin/env bash
# The main job: installs what is missing, builds the carom program, renders the paper's scenes to frames/<scene>/; with
# scenes' names those, with --all every shipped scene.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

case "${1-}" in
  "") scenes=(bouncing-ball contact-vertex-face contact-vertex-vertex contact-vertex-edge contact-edge-edge multi-contact
    sliding resting imported-meshes drop-mesh fifty-bodies crates-in-a-pool) ;;
  --all) scenes=(); for path in assets/scenes/*.json; do scenes+=("$(basename "$path" .json)"); done ;;
  *) scenes=("$@") ;;
esac

started=$SECONDS
install_missing_packages
build_release carom
built=$SECONDS

carom=$(build_folder release)/demos/carom
out=${CAROM_BUILD:+$CAROM_BUILD/}frames
frames=0
for scene in "${scenes[@]}"; do
  echo "rendering $scene"
  report=$("$carom" render "$scene" -o "$out/$scene/frame_%04d.png")
  echo "  $report"
  written=${report#*.png  }
  frames=$((frames + ${written%% *}))
done

echo "$frames frames in $(realpath "$out")/<scene>/frame_%04d.png, timings in each manifest.json"
echo "set-up and build $((built - started)) s, rendering $((SECONDS - built)) s"
