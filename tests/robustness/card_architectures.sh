#!/usr/bin/env bash
# card_architectures.sh SOURCES: architectures that a build by default is made for, on machines with cards that the
# program can use, that are newer than nvcc or too old, or that the driver does not show.
set -euo pipefail
cmake=$(command -v cmake)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/ask.cmake" <<ASK
cmake_minimum_required(VERSION 3.22)
include($1/kernels/device/card_architectures.cmake)
find_card_architectures(architectures fault $work/nvcc)
message("\${architectures}|\${fault}")
ASK
printf '#!/bin/sh\nprintf "compute_%%s\\n" 100 75 80 90\n' >"$work/nvcc"
chmod +x "$work/nvcc"

# expect WORDS COMMANDS: the answer with an nvidia-smi of these commands; none: without one.
expect() {
  rm -f "$work/nvidia-smi"
  [[ -z $2 ]] || { printf '#!/bin/sh\n%s\n' "$2" >"$work/nvidia-smi" && chmod +x "$work/nvidia-smi"; }
  local said
  said=$(PATH=$work "$cmake" -P "$work/ask.cmake" 2>&1)
  [[ $said == "$1" ]] || { printf 'card_architectures.sh: expected\n%s\nfound\n%s\n' "$1" "$said" >&2; exit 1; }
}

this_nvcc="and this nvcc compiles tread for 80, 90, 100; take a newer card"
expect "90|" "echo 9.0; echo 9.0"
expect "90;80|" "echo 9.0; echo 7.5; echo 8.0" # the program leaves the card of 7.5 alone
expect "|this machine's card has the architecture 75, $this_nvcc" "echo 7.5"
expect "100|" "echo 12.0; echo 12.1" # newer than nvcc: from PTX
expect "80;90|" "echo 8.9; echo 9.0"
not_shown="mend that, or state TREAD_CUDA_ARCHITECTURES"
expect "|nvidia-smi does not show this machine's card (No devices were found); $not_shown" "echo No devices were found; exit 6"
expect "|nvidia-smi does not show this machine's card (No such file or directory); $not_shown" ""
echo "card_architectures.sh: all is well"
