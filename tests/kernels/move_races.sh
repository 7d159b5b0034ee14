#!/usr/bin/env bash
# Moves small scenes in the narrow layout in Oclgrind, which interprets the kernels and reports data races and
# accesses out of bounds. Without optimisation, as build_races.sh has it.
# Usage: move_races.sh FACET_BENCH
set -euo pipefail
bench=$1
command -v oclgrind >/dev/null || { echo "SKIPPED: no oclgrind (Debian package oclgrind)"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT

oclgrind --data-races --check-api --local-mem-size 65536 --log "$log" "$bench" move --layout narrow \
  --device Oclgrind --mesh soup:60 --amplitude 0.1 --instances 3 --repeat 1 --no-rays \
  --flags=-cl-opt-disable >/dev/null
[[ ! -s $log ]] || { echo "FAILED"; head -40 "$log"; exit 1; }
echo "2 moves without a race"
