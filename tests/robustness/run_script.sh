#!/usr/bin/env bash
# run_script.sh SOURCES: ./run with a program that only notes its arguments: a long run has a preview first; a short one,
# one with options that a preview cannot share and one that its elements refuse have none; the exit code is the run's.
set -euo pipefail
sources=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{bin,scripts,scenes,build/release}
cp "$sources/run" "$work/run"
cp "$sources/scripts/setup.sh" "$work/scripts"
touch "$work/build/release/build.ninja" "$work/scenes/corrugation-d.toml" "$work/my.toml"
echo release >"$work/build/release/preset"

# Every package is installed; nothing is compiled.
printf '#!/bin/sh\nprintf installed\n' >"$work/bin/dpkg-query"
printf '#!/bin/sh\n' >"$work/bin/cmake"
cat >"$work/build/release/tread" <<'STUB'
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
chmod +x "$work"/bin/* "$work/build/release/tread"
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
if "$work/run" "$work/none.toml" 2>"$work/said"; then fail "a scene that is absent"; fi
grep -q "There is no scene file" "$work/said" || fail "the absent scene is named"
echo "run_script.sh: all is well"
