#!/usr/bin/env bash
# Builds small trees by single work-items and folds them, in Oclgrind, which interprets the kernels and
# reports data races and accesses out of bounds.
# Without optimisation: Oclgrind does not know what Clang writes where it inlines functions that return
# structures.
# Usage: fold_races.sh FACET_BENCH
set -euo pipefail
bench=$1
command -v oclgrind >/dev/null || { echo "SKIPPED: no oclgrind (Debian package oclgrind)"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
oclgrind --data-races --check-api --local-mem-size 65536 --log "$log" "$bench" fold \
  --device Oclgrind --tree levels,binned --mesh soup:1 terrain:1 soup:40 soup:200 --repeat 1 --flags=-cl-opt-disable >/dev/null
[[ ! -s $log ]] || { echo "FAILED"; head -40 "$log"; exit 1; }
echo "4 meshes by both builders without a race"
