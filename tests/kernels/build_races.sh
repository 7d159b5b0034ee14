#!/usr/bin/env bash
# Builds small trees in Oclgrind, which interprets the kernels and reports data races, diverging barriers and
# accesses out of bounds: both builders by groups, and `levels` by single work-items. (fold_races.sh has the
# other by those.)
# Without optimisation: Oclgrind does not know what Clang writes where it inlines functions that return
# structures.
# Usage: build_races.sh FACET_BENCH
set -euo pipefail
bench=$1
command -v oclgrind >/dev/null || { echo "SKIPPED: no oclgrind (Debian package oclgrind)"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT

check() {
  oclgrind --data-races --check-api --local-mem-size 65536 --log "$log" "$bench" build --kept --device Oclgrind \
    --repeat 1 --flags=-cl-opt-disable "$@" >/dev/null
  [[ ! -s $log ]] || { echo "FAILED"; head -40 "$log"; exit 1; }
}
check --face group --mesh soup:1 soup:40 soup:1000
check --face serial --tree levels --mesh soup:1 soup:300
echo "8 builds without a race"
