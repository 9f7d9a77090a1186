#!/usr/bin/env bash
# card_architectures.sh SOURCES: architectures that a build by default is made for, on machines with cards that the
# program can use, that are newer than nvcc or too old, or that the driver does not show; an nvcc that is too old.
set -euo pipefail
cmake=$(command -v cmake)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sources="$work/a clone (copy)"
ln -s "$1" "$sources"
cat >"$work/ask.cmake" <<ASK
cmake_minimum_required(VERSION 3.23)
include("$sources/kernels/device/card_architectures.cmake")
find_card_architectures(architectures fault "$work/nvcc")
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

# An nvcc of CUDA 11 counts as none.
mkdir -p "$work"/old/{bin,include} "$work/project/kernels"
printf '#!/bin/sh\ntouch "%s"\necho "Cuda compilation tools, release 11.8, V11.8.89"\n' "$work/called" >"$work/old/bin/nvcc"
chmod +x "$work/old/bin/nvcc"
touch "$work/old/include/cuda_runtime.h"
cat >"$work/project/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.23)
project(tread LANGUAGES NONE)
add_subdirectory(kernels)
PROJECT
ln -s "$1/kernels/device" "$work/project/kernels/device"
cat >"$work/project/kernels/CMakeLists.txt" <<KERNELS
include("$sources/kernels/cuda.cmake")
if(TARGET nvcc_check)
  message(FATAL_ERROR "nvcc_check calls \${CUDAToolkit_NVCC_EXECUTABLE}")
endif()
KERNELS
for choice in AUTO ON; do
  status=0
  rm -f "$work/called"
  "$cmake" -G Ninja -S "$work/project" -B "$work/$choice" -D TREAD_CUDA="$choice" \
    -D CUDAToolkit_ROOT="$work/old" >"$work/said" 2>&1 || status=$?
  [[ -e $work/called ]] || { cat "$work/said" >&2; echo "card_architectures.sh: the old nvcc is not asked" >&2; exit 1; }
  ! grep "=$work/old/bin" "$work/$choice/CMakeCache.txt" ||
    { echo "card_architectures.sh: the old nvcc would be found for ever" >&2; exit 1; }
  [[ $choice == AUTO && $status == 0 || $choice == ON && $(cat "$work/said") == *"there is no nvcc of CUDA 12 or later"* ]] ||
    { cat "$work/said" >&2; echo "card_architectures.sh: TREAD_CUDA=$choice with an nvcc of CUDA 11" >&2; exit 1; }
done
echo "card_architectures.sh: all is well"
