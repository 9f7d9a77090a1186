#!/usr/bin/env bash
# Installs the build into a temporary folder: the program runs a shipped scene from another folder, man pages and
# completion are there, and the program of this folder is built against the engine and runs.
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
for file in man/man1/tread.1 man/man1/tread-run.1 bash-completion/completions/tread \
  zsh/vendor-completions/_tread fish/vendor_completions.d/tread.fish doc/tread/copyright \
  doc/tread/docs/can-and-cannot.md tread/scenes/tyre.toml tread/python/tread_results.py; do
  [[ -s $work/tread/share/$file ]] || { echo "share/$file is not installed" >&2; exit 1; }
done
(cd "$work" && TREAD_SHARE=$work/tread/share/tread tread/bin/tread check -t 1 bar-wave >log) ||
  { cat "$work/log" >&2; exit 1; }
cp "$here/CMakeLists.txt" "$here/rolling_tyre.cpp" "$work"
cmake -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_PREFIX_PATH="$work/tread" >"$work/log" || { cat "$work/log" >&2; exit 1; }
cmake --build "$work/build" >"$work/log" || { cat "$work/log" >&2; exit 1; }
"$work/build/rolling_tyre"
