#!/usr/bin/env bash
# Compiles for a card, and fails where a kernel over elements or of a patch came out empty.
#
#   scripts/nvcc_whole.sh NVCC ARGUMENT...
#
# A card cannot call a function that is neither constexpr nor TREAD_BODY. From a constexpr one nvcc lets it, says
# nothing, and leaves out the kernel that would get there.
set -euo pipefail
export LC_ALL=C # numbers with a decimal point
log=$(mktemp)
trap 'rm -f "$log"' EXIT
"$@" -Xptxas -v 2>"$log" || { grep -v '^ptxas info' "$log" >&2; exit 1; }
awk '
  /Compiling entry function/ { kernel = /(march|patch)_kernel/ ? $0 : "" }
  kernel != "" && /Used [0-9]+ registers/ {
    ++kernels
    match($0, /Used [0-9]+/)
    if (substr($0, RSTART + 5, RLENGTH - 5) + 0 < 32) { print "empty: " kernel; ++empty }
    kernel = ""
  }
  END {
    if (kernels == 0) print "no kernels found in the output of ptxas"
    if (empty > 0) print "a body calls a function that is neither constexpr nor TREAD_BODY"
    exit kernels == 0 || empty > 0
  }' "$log" >&2
