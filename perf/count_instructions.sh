#!/bin/bash
# Instructions of every kernel by callgrind, AVX2, one thread, where the system has no hardware counters: rows as
# `tread bench kernels --json` prints them, without rates, for `tread bench compare --by instructions`.
#
#   perf/count_instructions.sh [PROGRAM [OPTION...]] >mine.json     default: build/release/tread --elements 100000
#
# The options are those of `tread bench kernels`, such as --kernel and --precision. callgrind collects within
# tread_counted_call (drivers/bench/hardware_counters.hpp) alone and writes one dump after each of its calls, so neither
# set-up nor timed runs count. Minutes.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
. "$here/callgrind.sh"
program=${1:-$here/../build/release/tread}
options=("${@:2}")
[[ " ${options[*]} " == *" --elements "* ]] || options+=(--elements 100000)
counted=tread_counted_call

need_callgrind "$program"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LD_BIND_NOW=1 # no look-up of a symbol within the first call

under_callgrind "$work/log" "$counted" --dump-after="$counted" --callgrind-out-file="$work/dump" \
  "$program" bench kernels -t 1 --lanes avx2 --backend openmp --repetitions 1 --run-seconds 0 --json "${options[@]}" \
  >"$work/rows"
python3 "$here/add_counts.py" "$work/rows" "$work/dump"
