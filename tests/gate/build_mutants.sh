#!/bin/bash
# bash tests/gate/build_mutants.sh OUT [CMAKE OPTIONS]: carom programs with one constant changed each, for
# seeded_faults.py (light, shader, tone-map, solver) and work_seen.py (sweep, texture, band). The tree itself is not
# touched.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
out=$(mkdir -p "$1" && cd "$1" && pwd)
shift
copy=$out/tree
mkdir -p "$copy"
(cd "$root" && tar cf - --exclude=./build --exclude=./.git --exclude=./tests/golden .) | tar xf - -C "$copy"
# Where a build of the tree has its files, so that a compiler cache knows them.
build=$copy/build/release
cmake -S "$copy" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" >"$out/cmake.txt"

# mutate NAME FILE OLD NEW: OLD must be there, once or more; its first place changes.
mutate() {
  grep -qF -- "$3" "$copy/$2" || { echo "build_mutants: $2 has no '$3'" >&2; exit 1; }
  cp "$copy/$2" "$out/saved"
  python3 -c 'import sys; p, a, b = sys.argv[1:]; t = open(p).read(); open(p, "w").write(t.replace(a, b, 1))' \
    "$copy/$2" "$3" "$4"
  nice cmake --build "$build" --target carom -j2 >"$out/$1.txt"
  cp "$build/demos/carom" "$out/$1"
  cp "$out/saved" "$copy/$2"
}
mutate light renderer/look/light.h "to_light = Vec3(0.50, -0.50, 0.85)" "to_light = Vec3(0.55, -0.50, 0.85)"
mutate shader renderer/glsl/body_fragment.glsl "kSkyLight, 0.5 + 0.5 * n.z" "kSkyLight, 0.54 + 0.46 * n.z"
mutate tone-map renderer/glsl/light.glsl "inversesqrt(1.0 + light * light)" "inversesqrt(1.1 + light * light)"
mutate solver engine/foundation/tolerances.h "kSolverResidual = 1.0e-8" "kSolverResidual = 1.0e-6"
# For work_seen.py: one sweep more a solve, one texel more a side of the shadow map, one band of a PNG more.
mutate sweep engine/response/sweeps/contact_solver.cpp "if (hasConverged(report, settings, enough, rows.size())) break;" \
  "if (hasConverged(report, settings, enough, rows.size())) { sweeps.sweep({settings.friction, !forward, kVisitAll, enough}, report); break; }"
mutate texture renderer/view/preset.h "shadow_texels = 1024" "shadow_texels = 1025"
mutate band renderer/image/png.cpp "if (is_first || std::memcmp(" "if (is_first || i == 0 || std::memcmp("
