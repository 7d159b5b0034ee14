#!/usr/bin/env bash
# Compiles every kernel, with every set of feature flags that a scene can ask for, by clang for
# SPIR, NVPTX and AMDGCN: devices that the test machine may not have; the wide layout, which is for CPUs,
# for SPIR and for x86-64 with AVX-512. The flags are read from
# cl/features.h, so that a new feature is covered when it is named there.
# Flags decide what is compiled, targets how: sets with no flag, one, or all become code for each target, and the
# others are checked for SPIR without generating code.
# Usage: targets.sh CL_FOLDER [CLANG]
set -euo pipefail
cl=$1
clang=${2:-clang}
command -v "$clang" >/dev/null || { echo "SKIPPED: no $clang (Debian package clang)"; exit 77; }

mapfile -t derived < <(grep -oE 'FACET_NO_[A-Z]+' "$cl/features.h" | sort -u)
chosen=(FACET_GEOMETRY_IMAGE FACET_TREE_NONE)
for flag in "${chosen[@]}" FACET_WIDE; do
  grep -q "$flag" "$cl/features.h" || { echo "cl/features.h does not name $flag"; exit 1; }
done
flags=("${derived[@]}" "${chosen[@]}")
(( ${#derived[@]} >= 5 )) || { echo "cl/features.h names only ${#derived[@]} FACET_NO_ flags"; exit 1; }

# Whether of N flags a set (bits of a number) has none, one, or all.
is_outer() { local count; count=$(bits "$1"); (( count <= 1 || count == $2 )); }
bits() { local n=$1 b=0; while (( n )); do (( b += n & 1, n >>= 1 )) || true; done; echo "$b"; }

# Every subset of the flags, for the kernels that traverse; the builders' kernels have none.
jobs=$(mktemp)
trap 'rm -f "$jobs"' EXIT
for target in spir64-unknown-unknown nvptx64-nvidia-nvcl amdgcn-amd-amdhsa; do
  for ((set = 0; set < 1 << ${#flags[@]}; ++set)); do
    options=""
    for ((i = 0; i < ${#flags[@]}; ++i)); do
      (( set >> i & 1 )) && options+=" -D${flags[i]}"
    done
    as=code
    is_outer "$set" ${#flags[@]} || as=check
    [[ $as == code || $target == spir64* ]] || continue
    echo "$target $as render.cl$options"
    (( $(bits "$set") % ${#flags[@]} )) || echo "$target $as render_samples.cl$options"  # all of render.cl is in it
    echo "$target $as trace.cl$options"
    [[ $as == check || $options == *FACET_TREE_NONE* ]] || echo "$target $as trace_refilled.cl$options"
  done
  # What render.cl is made of, asked one by one: with everything, and with all left out.
  echo "$target code probe.cl"
  echo "$target code probe.cl${derived[*]/#/ -D}"
  for kernel in morton.cl bottom.cl "morton.cl -DFACET_OVER_BOXES" "bottom.cl -DFACET_OVER_BOXES" subtrees.cl top.cl \
      levels.cl "levels.cl -DFACET_OVER_BOXES" tree.cl leaf_order.cl look_back.cl cut_tree.cl fold.cl blocks.cl refit.cl \
      moved_corners.cl; do
    echo "$target code $kernel"
  done
  as=check
  [[ $target == spir64* ]] && as=code
  echo "$target $as serial.cl"
  echo "$target $as serial_levels.cl"
  for key in uint ulong; do
    for kernel in radix_counts.cl radix_sort.cl "radix_sort.cl -DFACET_LOOK_BACK" \
        "radix_sort.cl -DFACET_LOOK_BACK -DFACET_ONE_LAUNCH" \
        "radix_sort.cl -DFACET_LOOK_BACK -DFACET_ONE_LAUNCH -DFACET_MANY_LAUNCHES" \
        "radix_sort.cl -DFACET_LOOK_BACK -DFACET_SORT_BESIDE -DGROUP=512 -DITEMS=3 -DCOPIES=2"; do
      echo "$target code $kernel -DKEY=$key"
    done
    # A CPU's kernels: their stack is more than AMD's GPUs have.
    as=check
    [[ $target == spir64* ]] && as=code
    echo "$target $as serial_order.cl -DKEY_BITS=$([[ $key == uint ]] && echo 32 || echo 64)"
  done
done > "$jobs"
for ((set = 0; set < 1 << ${#derived[@]}; ++set)); do
  options=" -DFACET_WIDE"
  for ((i = 0; i < ${#derived[@]}; ++i)); do
    (( set >> i & 1 )) && options+=" -D${derived[i]}"
  done
  as=code
  is_outer "$set" ${#derived[@]} || as=check
  for target in spir64-unknown-unknown x86_64-unknown-linux-gnu; do
    [[ $as == code || $target == spir64* ]] || continue
    for kernel in render.cl render_packets.cl trace.cl trace_packets.cl probe.cl refit.cl "trace.cl -DFACET_TREE_NONE"; do
      echo "$target $as $kernel$options"
    done
    [[ $options != *FACET_NO_INSTANCES* ]] || echo "$target $as trace_streams.cl$options"
  done
done >> "$jobs"
# By warps, where PTX can be written: instructions of sm_70.
for ranking in "" " -DFACET_SORT_MATCH"; do
  for key in uint ulong; do
    for more in "" " -DFACET_LOOK_BACK" " -DFACET_LOOK_BACK -DFACET_SORT_BESIDE" \
        " -DFACET_LOOK_BACK -DFACET_ONE_LAUNCH"; do
      echo "nvptx64-nvidia-nvcl code radix_sort.cl -DFACET_PTX -DGROUP=384 -DITEMS=10 -DKEY=$key$ranking$more"
    done
  done
done >> "$jobs"
for kernel in look_back.cl levels.cl trace.cl render.cl render_samples.cl trace_refilled.cl \
    "trace.cl -DFACET_NO_INSTANCES" "trace_refilled.cl -DFACET_NO_INSTANCES"; do
  echo "nvptx64-nvidia-nvcl code $kernel -DFACET_PTX"
done >> "$jobs"

compile() {
  local clang=$1 cl=$2 target=$3 as=$4 kernel=$5
  shift 5
  local emit=(-S)
  case $target in
    spir64*) emit=(-O0 -emit-llvm -c) ;;  # a driver optimises it; Clang's own passes run for the others
    x86_64*) emit=(-march=skylake-avx512 -S) ;;
    nvptx*) emit+=(-Xclang -target-cpu -Xclang sm_70) ;;
    amdgcn*) emit=(-mcpu=gfx900 -nogpulib -c) ;;
  esac
  [[ $as == code ]] || emit=(-fsyntax-only -nogpulib)
  "$clang" -x cl -cl-std=CL1.2 -target "$target" -Xclang -finclude-default-header -Wall -Wextra -Werror \
    -Wno-unused-parameter -O1 -I"$cl" "$@" "${emit[@]}" -o /dev/null "$cl/$kernel" ||
    { echo "FAILED: $target $kernel $*"; return 255; }
}
export -f compile
xargs -P "$(nproc)" -a "$jobs" -I{} bash -c "compile '$clang' '$cl' {}"
echo "$(wc -l < "$jobs") compilations: every kernel, ${#flags[@]} flags, 3 targets; the wide layout, 2 targets"
