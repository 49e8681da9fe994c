#!/usr/bin/env bash
# Installs what is missing, builds the benchmarks, prints nanoseconds a query for ours and for each peer that is there,
# then wrong answers on adversarial pairs. Arguments go to Google Benchmark (for example: --benchmark_filter=/20$).
# The long runs are apart: build/bench/tests/bench/long_run --queries 100000000, and any_history with the same options
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source demos/packages.sh

install_missing_packages "${carom_packages[@]}" libbenchmark-dev
install_missing_packages "${benchmark_peers[@]}" || echo "comparing with the peers that are there" >&2
build_preset bench closest_features_bench robustness long_run any_history

programs=build/bench/tests/bench
"$programs/closest_features_bench" --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true \
  --benchmark_min_time=0.05 "$@"

# A peer's failed assertion is counted in the table; its message says no more.
echo
log=$(mktemp)
trap 'rm -f "$log"' EXIT
code=0
"$programs/robustness" 2>"$log" || code=$?
grep -v "Assertion .* failed" "$log" >&2 || true
exit "$code"
