#!/usr/bin/env bash
# Compiles every kernel, with every set of feature flags that a scene can ask for, by clang for
# SPIR, NVPTX and AMDGCN: devices that the test machine may not have. The flags are read from
# cl/features.h, so that a new feature is covered when it is named there.
# Usage: targets.sh CL_FOLDER [CLANG]
set -euo pipefail
cl=$1
clang=${2:-clang}
command -v "$clang" >/dev/null || { echo "SKIPPED: no $clang (Debian package clang)"; exit 77; }

mapfile -t derived < <(grep -oE 'FACET_NO_[A-Z]+' "$cl/features.h" | sort -u)
chosen=(FACET_GEOMETRY_IMAGE FACET_TREE_NONE)
for flag in "${chosen[@]}"; do
  grep -q "$flag" "$cl/features.h" || { echo "cl/features.h does not name $flag"; exit 1; }
done
flags=("${derived[@]}" "${chosen[@]}")
(( ${#derived[@]} >= 5 )) || { echo "cl/features.h names only ${#derived[@]} FACET_NO_ flags"; exit 1; }

# Every subset of the flags, for the kernels that traverse; the builders' kernels have none.
jobs=$(mktemp)
trap 'rm -f "$jobs"' EXIT
for target in spir64-unknown-unknown nvptx64-nvidia-nvcl amdgcn-amd-amdhsa; do
  for ((set = 0; set < 1 << ${#flags[@]}; ++set)); do
    options=""
    for ((i = 0; i < ${#flags[@]}; ++i)); do
      (( set >> i & 1 )) && options+=" -D${flags[i]}"
    done
    echo "$target render.cl$options"
    echo "$target trace.cl$options"
  done
  # What render.cl is made of, asked one by one: with everything, and with all left out.
  echo "$target probe.cl"
  echo "$target probe.cl${derived[*]/#/ -D}"
  for kernel in morton.cl levels.cl tree.cl "radix_sort.cl -DKEY=uint" "radix_sort.cl -DKEY=ulong"; do
    echo "$target $kernel"
  done
done > "$jobs"

compile() {
  local clang=$1 cl=$2 target=$3 kernel=$4
  shift 4
  local emit=(-S)
  case $target in
    spir64*) emit=(-emit-llvm -c) ;;
    amdgcn*) emit=(-mcpu=gfx900 -nogpulib -c) ;;
  esac
  "$clang" -x cl -cl-std=CL1.2 -target "$target" -Xclang -finclude-default-header -Wall -Wextra -Werror \
    -Wno-unused-parameter -O1 -I"$cl" "$@" "${emit[@]}" -o /dev/null "$cl/$kernel" ||
    { echo "FAILED: $target $kernel $*"; return 255; }
}
export -f compile
xargs -P "$(nproc)" -a "$jobs" -I{} bash -c "compile '$clang' '$cl' {}"
echo "$(wc -l < "$jobs") compilations: every kernel, ${#flags[@]} flags, 3 targets"
