#!/usr/bin/env bash
# The long suite of contact: installs what is missing, builds, and runs every part of `stress` at the size of its bar
# (hours on two cores), or with --small at sizes that take a minute. Exit code 1 when a bar is missed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source demos/packages.sh

tunnelling=() sweeps=() collisions=() tiles=() landings=() energy=() pile=()
case "${1-}" in
  "") ;;
  --small)
    tunnelling=(--trials 3000) sweeps=(--sweeps 10000) collisions=(--collisions 100000) tiles=(--glides 8)
    landings=(--landings 300) energy=(--share 0.1)
    pile=(--bodies 40 --seconds 5)
    ;;
  *)
    echo "usage: stress.sh [--small]" >&2
    exit 2
    ;;
esac

install_missing_packages "${carom_packages[@]}" libbenchmark-dev
install_missing_packages "${benchmark_peers[@]}" || echo "comparing with the peers that are there" >&2
build_preset bench stress

program=build/bench/tests/bench/stress
code=0
for part in tunnelling sweeps collisions tiles landings energy pile; do
  declare -n options=$part
  echo
  echo "stress $part ${options[*]}"
  "$program" "$part" "${options[@]}" || code=1
done
exit "$code"
