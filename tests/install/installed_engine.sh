#!/usr/bin/env bash
# Installs the build into a temporary folder, builds the program of this folder against it and runs it.
#
#   tests/install/installed_engine.sh BUILD CXX      BUILD: the build folder, CXX: the compiler
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
build=$1
compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/tread" >"$work/log" || { cat "$work/log" >&2; exit 1; }
[[ -x $work/tread/bin/tread ]] || { echo "the program is not installed" >&2; exit 1; }
cp "$here/CMakeLists.txt" "$here/rolling_tyre.cpp" "$work"
cmake -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_PREFIX_PATH="$work/tread" >"$work/log" || { cat "$work/log" >&2; exit 1; }
cmake --build "$work/build" >"$work/log" || { cat "$work/log" >&2; exit 1; }
"$work/build/rolling_tyre"
