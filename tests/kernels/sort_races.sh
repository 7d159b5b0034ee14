#!/usr/bin/env bash
# Runs small sorts by every portable way in Oclgrind, which interprets the kernels and reports data
# races, diverging barriers and accesses out of bounds. It runs one work-group after the other: what
# groups do to each other while both run, it does not see.
# Usage: sort_races.sh FACET_BENCH
set -euo pipefail
bench=$1
command -v oclgrind >/dev/null || { echo "SKIPPED: no oclgrind (Debian package oclgrind)"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT

sort_with() {
  # Atomics of a buffer that was filled count as uninitialised there, so that is not asked for.
  oclgrind --data-races --check-api --local-mem-size 65536 --log "$log" "$bench" sort \
    --device Oclgrind --no-peers --repeat 1 "$@" >/dev/null
  [[ ! -s $log ]] || { echo "FAILED: sort $*"; head -40 "$log"; exit 1; }
}
sort_with --face group --look-back on --count 600 --items 1 --bits 12
sort_with --face group --look-back on --count 600 --items 2 --bits 9 --beside on --order --copies 2 --keys 32
sort_with --face group --look-back on --launches one --count 600 --items 1 --bits 12
sort_with --face group --look-back off --count 600 --items 2 --bits 9 --keys 32
# Optimised, these kernels have intrinsics of LLVM that Oclgrind lacks.
sort_with --face serial --count 4200 --bits 23 --keys 32 --flags=-cl-opt-disable
sort_with --face serial --count 4200 --few 64 --bucket-mean 256 --keys 64 --flags=-cl-opt-disable
echo "6 ways without a race"
