#!/usr/bin/env bash
# Builds small trees by groups in Oclgrind, which interprets the kernels and reports data races, diverging
# barriers and accesses out of bounds. (fold_races.sh has those by single work-items.)
# Without optimisation: Oclgrind does not know what Clang writes where it inlines functions that return
# structures.
# Of 800 triangles there are more than 32 subtrees, whose range is split before it is swept.
# Usage: build_races.sh FACET_BENCH
set -euo pipefail
bench=$1
command -v oclgrind >/dev/null || { echo "SKIPPED: no oclgrind (Debian package oclgrind)"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT

oclgrind --data-races --check-api --local-mem-size 65536 --log "$log" "$bench" build --kept --face group \
  --device Oclgrind --mesh soup:1 soup:40 soup:800 --repeat 1 --flags=-cl-opt-disable >/dev/null
[[ ! -s $log ]] || { echo "FAILED"; head -40 "$log"; exit 1; }
echo "6 builds without a race"
