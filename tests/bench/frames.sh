#!/usr/bin/env bash
# Frames a second of `carom render`, end to end (physics, drawing, PNG files), for 1, 2, ... workers beside each other:
#   bash tests/bench/frames.sh [carom program] [most workers] [runs]
# Prints the best of the runs of each case with the program's own report: wall-clock milliseconds a frame by phase;
# those of drawing and encoding are of the one worker that did it. Bodies that rest are not drawn again, so that the
# first four cases tell what a scene at rest costs; in the `bouncing` and `orbit` ones every frame is drawn in full.
# For a quiet machine.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
carom=${1:-$root/build/release/demos/carom}
most=${2:-2}
runs=${3:-3}
work=$(mktemp -d)
trap 'wait; rm -rf "$work"' EXIT

# scene NAME SHAPE COLUMNS ROWS STEP CAMERA [HEIGHT RESTITUTION]: bodies above a floor; a little, so that they soon
# rest, if nothing else is said.
scene() {
  cat >"$work/$1.json" <<JSON
{ "format": 1, "rate": 120, "duration": 3,
  "bodies": [
    { "name": "floor", "shape": { "box": [60, 60, 1] }, "position": [0, 0, -0.5], "static": true,
      "material": { "color": "#d6d3cc", "checker": true } },
    { "name": "body", "shape": $2, "position": [$(awk "BEGIN { print -$5 * ($3 - 1) / 2 }"),
      $(awk "BEGIN { print -$5 * ($4 - 1) / 2 }"), ${7:-0.36}],
      "material": { "restitution": ${8:-0} },
      "color": ["#d55e00", "#0072b2", "#009e73", "#e69f00", "#56b4e9", "#cc79a7", "#f0e442"],
      "repeat": { "count": [$3, $4, 1], "step": [$5, $5, 0] } } ],
  "cameras": { "main": $6 } }
JSON
}
box='{ "box": [0.6, 0.6, 0.6] }'
still='{ "eye": [7, -13, 8], "target": [0, 0, 0.3], "fovDegrees": 36 }'
scene boxes-200 "$box" 20 10 0.8 "$still"
polyhedron="{ \"hull\": { \"file\": \"$root/assets/meshes/dodecahedron.ply\", \"scale\": 0.7 } }"
far='{ "eye": [14, -26, 16], "target": [0, 0, 0.3], "fovDegrees": 36 }'
scene polyhedra-200 "$polyhedron" 20 10 0.8 "$still"
scene boxes-1000 "$box" 40 25 0.8 "$far"
scene bouncing-200 "$box" 20 10 0.8 "$still" 1.5 0.95
scene bouncing-polyhedra-200 "$polyhedron" 20 10 0.8 "$still" 1.5 0.95
scene bouncing-1000 "$box" 40 25 0.8 "$far" 1.5 0.95
scene orbit-200 "$box" 20 10 0.8 \
  '{ "orbit": { "target": [0, 0, 0.3], "radius": 14.8, "height": 7.7, "degreesPerSecond": 20 }, "fovDegrees": 36 }'

for case in boxes-200:1280x720 polyhedra-200:1280x720 boxes-1000:1280x720 boxes-200:1920x1080 \
  bouncing-200:1280x720 bouncing-polyhedra-200:1280x720 bouncing-1000:1280x720 bouncing-200:1920x1080 \
  orbit-200:1280x720; do
  for workers in $(seq 1 "$most"); do
    for _ in $(seq 1 "$runs"); do
      "$carom" render "$work/${case%:*}.json" --size "${case#*:}" --fps 60 --workers "$workers" \
        --progress none -o "$work/out/f_%04d.png" 2> "$work/told.txt"
    done | sed 's/.*png  //; s/  smallest gap.*//' |
      awk -v what="$case, $workers worker(s)" '{ fps = $5 + 0; for (i = 1; i < NF; ++i) if ($(i + 1) == "fps") fps = $i
        if (fps > best) { best = fps; line = $0 } } END { printf "%-46s %s\n", what ":", line }'
  done
done
