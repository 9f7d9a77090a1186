#!/usr/bin/env bash
# run_script.sh SOURCES: ./run with a program that only notes its arguments: a long run has a preview first; a short one,
# one with options that a preview cannot share and one that its elements refuse have none; the exit code is the run's.
# ./test, scripts/setup.sh and scripts/verification_page.sh in the same way; a rule for shell scripts, one for CMake files.
set -euo pipefail
export LC_ALL=C
unset TREAD_PRESET
sources=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{bin,scripts,scenes,build/release}
cp "$sources/run" "$sources/test" "$work"
cp "$sources/scripts/setup.sh" "$work/scripts"
touch "$work/scenes/corrugation-d.toml" "$work/my.toml"

# Every package but MISSING is installed; nothing is compiled.
printf '#!/bin/sh\n[ "$4" = "${MISSING:-}" ] || printf installed\n' >"$work/bin/dpkg-query"
printf '#!/bin/sh\n' >"$work/bin/apt-get"
printf '#!/bin/sh\nexec "$@"\n' >"$work/bin/sudo"
printf '#!/bin/sh\n' >"$work/bin/mpicc"
printf '#!/bin/sh\necho "ctest $*" >>"$NOTES"\n' >"$work/bin/ctest"
cat >"$work/bin/cmake" <<'STUB'
#!/usr/bin/env bash
echo "cmake $*" >>"$NOTES"
if [[ $1 == --build ]]; then
  [[ -z ${SERVER:-} ]] || sleep 2 >/dev/null 2>&1 &
  cp "$(dirname "$0")/tread" "$2/tread"
else
  touch build/release/build.ninja
  mkdir -p build/release/tests
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/release/CMakeCache.txt
fi
STUB
cat >"$work/bin/tread" <<'STUB'
#!/usr/bin/env bash
echo "$*" >>"$NOTES"
seconds=$SECONDS_OF_RUN
[[ $* != *"6 mm"* ]] || seconds=50
if [[ $1 == check ]]; then
  [[ $* != *narrow*"6 mm"* ]] || exit 2
  printf '{\n  "preload_s": 1.5,\n  "rolling_s": %s,\n  "steps": 7\n}\n' "$seconds"
  exit 0
fi
[[ $* != *fails* ]] || exit 3
for code in 2 3 75; do
  [[ $* != *"coarse=$code"*"6 mm"* ]] || exit "$code"
done
while [[ $1 != -o ]]; do shift; done
mkdir -p "$2" && touch "$2/report.html"
STUB
chmod +x "$work"/bin/*
export PATH=$work/bin:$PATH NOTES=$work/notes

fail() { echo "run_script.sh: $*" >&2; cat "$work/notes" "$work/said" >&2 || true; exit 1; }
# try SECONDS OPTION...: ./run of a scene that is expected to take so long.
try() {
  rm -rf "$work/notes" "$work/out"
  export SECONDS_OF_RUN=$1
  shift
  status=0
  "$work/run" "$@" -o "$work/out" >"$work/said" 2>&1 || status=$?
}
runs() { grep -c '^run ' "$work/notes"; }

try 660 --help
[[ $status == 0 && ! -e $work/notes && $(head -n 1 "$work/said") == "./run [scene.toml] [tread options]:"* ]] ||
  fail "--help prints how to call ./run and runs nothing"
try 660 --set "motion.speed=250 km/h" --quiet
[[ $status == 0 && $(runs) == 2 ]] || fail "a long run has a preview"
grep -q '^run .*/out/preview --set motion.speed=250 km/h --quiet --set scene.element_size=6 mm' "$work/notes" ||
  fail "the preview is the same passage on coarse elements"
grep -q "^Report: $work/out/preview/report.html" "$work/said" || fail "the preview's report is named"
grep -q "^Both reports: $work/out/index.html" "$work/said" || fail "the page of both reports is named"
[[ $(tail -n 1 "$work/said") == "Report: $work/out/report.html" ]] || fail "the report is named last"
for page in $(grep -o 'href="[^"]*"' "$work/out/index.html" | cut -d'"' -f2); do
  [[ -f $work/out/$page ]] || fail "index.html links to $page, which is absent"
done

try 60 "$work/my.toml"
[[ $status == 0 && $(runs) == 1 ]] || fail "a short run has no preview"
grep -q "^run $work/my.toml -o $work/out\$" "$work/notes" || fail "the scene is run as it is"
try 60 corrugation-d
grep -q "^run $work/scenes/corrugation-d.toml " "$work/notes" || fail "a shipped scene has a name"
try 150
[[ $(runs) == 1 ]] || fail "a preview that takes a third of the run is none"
try 660 --json
[[ $(runs) == 1 ]] || fail "one object on stdout"
try 660 --set narrow=1
[[ $status == 0 && $(runs) == 1 ]] || fail "a scene that the preview's elements refuse runs without one"
for code in 2 3; do
  try 660 --set "coarse=$code"
  [[ $status == 0 && $(runs) == 2 && ! -e $work/out/index.html ]] || fail "a preview that ends with $code ends nothing"
done
try 660 --set coarse=75
[[ $status == 75 && $(runs) == 1 ]] || fail "a preview that is stopped ends the script with its code"
try 660 --set fails=1
[[ $status == 3 && $(runs) == 2 ]] || fail "a fault that the preview has, too, is the run's exit code"
try 60 --set fails=1
[[ $status == 3 ]] || fail "the exit code of the run"
echo "The card of this machine is not used." >"$work/build/release/unused_card.txt"
try 60
grep -q "^The card of this machine is not used" "$work/said" || fail "the reason why a card is not used"
rm "$work/build/release/unused_card.txt"
# refused WORDS ARGUMENT...: ./run ends at once, with 2 and these words.
refused() {
  rm -f "$work/notes"
  status=0
  "$work/run" "${@:2}" >"$work/said" 2>&1 || status=$?
  [[ $status == 2 && ! -e $work/notes && $(cat "$work/said") == *"$1"* ]] || fail "'$1' with exit code 2, not $status"
}
refused "There is no scene file '$work/none.toml'; shipped: corrugation-d.toml" "$work/none.toml"
refused "a value is missing after -o" -o
refused "there are 2 scenes" "$work/my.toml" --quiet corrugation-d

# The scene stands anywhere, with or without its suffix; options take their values with them.
try 60 corrugation-d.toml
grep -q "^run $work/scenes/corrugation-d.toml " "$work/notes" || fail "a shipped scene with its suffix"
try 60 -h
[[ $status == 0 && ! -e $work/notes ]] || fail "-h runs nothing"
# shellcheck disable=SC2016
mapfile -t with_value < <(sed -n '/^### tread run$/,/^### tread resume$/s/^| `\(-[^`]*\)` | [^ ].*/\1/p' \
  "$sources/docs/reference/commands.md" | tr -d , | tr ' ' '\n' | sed 'a value')
((${#with_value[@]} > 20)) || fail "docs/reference/commands.md lists the options of tread run"
try 60 "${with_value[@]}" "$work/my.toml"
grep -qs "^run $work/my.toml " "$work/notes" || fail "./run knows all options that take a value"

# The build is configured once, and anew for another preset, packages that arrive, and a clone that was copied or moved.
cache=$work/build/release/CMakeCache.txt
configured() { grep -q "^cmake .*--preset ${1:-release}" "$work/notes"; }
try 60
if configured; then fail "a configured build stays"; fi
MISSING=libfmt-dev try 60
configured || fail "an installed package is seen"
echo MPI_C_COMPILER:FILEPATH=MPI_C_COMPILER-NOTFOUND >>"$cache"
try 60
configured || fail "an MPI that arrived is seen"
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$work/other" >"$cache"
touch "$work/build/release/tests/case.cmake" "$work/build/release/mine.txt"
mkdir -p "$work/build/release/core/CMakeFiles"
try 60
configured || fail "the build of another clone is not this one's"
grep -q "^$work/build/release was configured for $work/other; " "$work/said" || fail "the other clone is named"
[[ ! -e $work/build/release/tests/case.cmake && ! -e $work/build/release/core/CMakeFiles &&
  -e $work/build/release/mine.txt ]] || fail "the configuration of the other clone goes, and that alone"

# Two calls build in turn.
rm "$work/said"
# shellcheck disable=SC2016
flock "$work/build/lock" sh -c 'until grep -qs "Another call" "$1"; do sleep 0.02; done' sh "$work/said" &
while flock -n "$work/build/lock" true; do sleep 0.02; done
try 60
kill "$!" 2>/dev/null || true
[[ $status == 0 && $(head -n 1 "$work/said") == "Another call is building here; waiting ..." ]] || fail "calls take turns"
SERVER=yes try 60
flock -n "$work/build/lock" true || fail "a compiler cache's server that stays holds up no other call"

# test_script PRESET WORD...: ./test
test_script() {
  rm -f "$work/notes"
  status=0
  TREAD_PRESET=$1 "$work/test" "${@:2}" >"$work/said" 2>&1 || status=$?
}
test_script ci -R Friction
[[ $status == 0 && $(tail -n 1 "$work/notes") == *" -LE "*" -R Friction" ]] && configured ci || fail "./test with the preset ci"
test_script release -R Friction --all
[[ $status == 0 && $(tail -n 1 "$work/notes") == *" -j 2 -R Friction" ]] || fail "--all stands anywhere"
test_script tsan
[[ $status == 2 && ! -e $work/notes ]] || fail "./test refuses presets with a folder of their own"
grep -q "docs/contributing.md says how others are run" "$work/said" || fail "other presets have their page"

# A bound that fails stands in the page; a case that stops, or that is not listed, does not.
mkdir -p "$work"/page/{scripts,build/release,docs/records/verification}
cp "$sources"/scripts/{verification_page.sh,put_between_marks.sh} "$work/page/scripts"
printf '#!/bin/sh\n' >"$work/page/scripts/accuracy_table.py"
printf '<!-- tread verify: %s -->\n' begin end >"$work/page/docs/records/verification.md"
cat >"$work/page/build/release/tread" <<'STUB'
#!/bin/sh
[ "$2" != sliding ] || exit 3
echo "Page of $2" >"$4/$2.md"
exit 3
STUB
chmod +x "$work/page/scripts/accuracy_table.py" "$work/page/build/release/tread"
# page STATUS NAME
page() {
  status=0
  "$work/page/scripts/verification_page.sh" "$2" >"$work/said" 2>&1 || status=$?
  [[ $status == "$1" ]] || fail "verification_page.sh $2: exit code $status, not $1"
}
page 0 transient
grep -q "^Page of transient" "$work/page/docs/records/verification.md" || fail "the page holds the bound that fails"
page 1 sliding
grep -q "^failed: sliding: exit code 3" "$work/said" || fail "a case that stops is named"
page 2 slidng
grep -q "no run of 'slidng' is listed; listed are hertz_sphere, " "$work/said" || fail "a name without a run is refused"

# Decimal commas of the user's language would cut numbers.
mapfile -t scripts < <(find "$sources"/{run,test,scripts,perf,tests} -name '*.sh' -o -name run -o -name test)
for script in "${scripts[@]}"; do
  ! grep -qE '\bawk\b|sort -n|%\.[0-9]+[efg]' "$script" || grep -q '^export LC_ALL=C' "$script" ||
    fail "$script reads or prints numbers without LC_ALL=C"
done
# Without VERBATIM nothing is built in a folder such as 'a&b'.
mapfile -t lists < <(find "$sources"/{CMakeLists.txt,core,kernels,io,drivers,tests,cmake} -name CMakeLists.txt -o -name '*.cmake')
for list in "${lists[@]}"; do
  if tr '\n' ' ' <"$list" | grep -oE 'add_custom_(command|target)\([^)]*COMMAND [^)]*\)' | grep -v VERBATIM; then
    fail "$list has a command without VERBATIM"
  fi
done
echo "run_script.sh: all is well"
