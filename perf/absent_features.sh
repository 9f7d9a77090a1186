#!/bin/bash
# What an absent feature costs: instructions per step by callgrind, portable lanes, one thread.
#
#   perf/absent_features.sh [PROGRAM]      default: build/release/tread
#
# The scene beside this script lacks friction, damping, corrugation, surfaces, slab, sleepers, dampers and torque. Every
# feature that can be stated as zero or as not present must cost nothing then (0.5 %) and leave the same state; each is
# given a value, which shows what it costs. Two runs of different length each: their difference is free of what is done
# once. Exits 3 where a bound fails.
set -euo pipefail
export LC_ALL=C # numbers with a decimal point

here=$(cd "$(dirname "$0")" && pwd)
. "$here/callgrind.sh"
program=${1:-$here/../build/release/tread}
scene=$here/absent_features.toml
bound=0.005

need_callgrind "$program"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export TREAD_INSTRUCTION_SET=baseline

value_of() { sed -n "s/.*\"$1\": \"\{0,1\}\([^\",]*\).*/\1/p" "$work/out/summary.json" | head -n 1; }

# count DURATION ARGUMENT...: sets `instructions` of all steps, `steps` and `state`.
count() {
  local duration=$1
  shift
  under_callgrind "$work/log" 'tread::Simulation::step()' --callgrind-out-file=/dev/null \
    "$program" run "$scene" -t 1 --quiet -o "$work/out" --overwrite --set "motion.duration=$duration" "$@"
  instructions=$(sed -n 's/.*Collected *: *//p' "$work/log")
  steps=$(value_of steps)
  state=$(value_of state_hash)
}

# per_step ARGUMENT...: sets `each`, instructions per step, and `state` at the end of the longer run. Both runs hold one
# sample, at their first step.
per_step() {
  count "10 us" "$@"
  local instructions_before=$instructions steps_before=$steps
  count "40 us" "$@"
  each=$(((instructions - instructions_before) / (steps - steps_before)))
}

failed=0
report() { # NAME, compare with `base`
  local share verdict=""
  share=$(awk -v a="$each" -v b="$base" 'BEGIN { printf "%+.3f", 100 * (a / b - 1) }')
  if [[ ${2:-} == absent ]]; then
    verdict=ok
    awk -v s="$share" -v b="$bound" 'BEGIN { exit !(s <= 100 * b && s >= -100 * b) }' || verdict="FAILS: it costs"
    [[ $state == "$base_state" ]] || verdict="FAILS: another state"
    [[ $verdict == ok ]] || failed=1
  fi
  printf '| %-44s | %11s | %9s %% | %s | %s |\n' "$1" "$each" "$share" "$state" "$verdict"
}

printf '| %-44s | %11s | %11s | %-16s | |\n' "scene" "per step" "difference" "state"
printf '|---|---|---|---|---|\n'
per_step
base=$each base_state=$state
report "nothing"
absent() { local name=$1; shift; per_step "$@"; report "$name" absent; }
present() { local name=$1; shift; per_step "$@"; report "$name"; }

absent "torque: mu = 0" --set motion.traction.mu=0
absent "torque: 0 N m" --set "motion.traction.torque=0 N m"
absent "damping: high_frequency_fraction 0" --set 'material.steel.damping={ kind = "high_frequency_fraction", value = 0 }'
absent "damping: rayleigh_beta 0 s" --set 'material.steel.damping={ kind = "rayleigh_beta", value = "0 s" }'
absent "slab: not present" --set slab.present=false
absent "corrugation: not present" --set corrugation.present=false
absent "vehicle: not present" --set vehicle.present=false
absent "sleepers: not present" --set sleepers.present=false
present "friction 0.5" --set contact.friction=0.5
present "fastenings' dampers: 200 kN s/m" --set "fastenings.damping=200 kN s/m"
present "torque: 1 kN m, friction 0.5" --set contact.friction=0.5 --set "motion.traction.torque=1 kN m"
present "damping: high_frequency_fraction 1e-4" \
  --set 'material.steel.damping={ kind = "high_frequency_fraction", value = 1e-4 }'
present "corrugation in the gap, 50 um" --set "corrugation.depth=50 um" --set "corrugation.wavelength=20 mm" \
  --set "corrugation.start=-20 mm" --set "corrugation.length=60 mm" --set corrugation.apply=gap
present "sleepers" --set "material.concrete.youngs_modulus=35 GPa" --set material.concrete.poissons_ratio=0.2 \
  --set "material.concrete.density=2400 kg/m3" --set "sleepers.stiffness=40 MN/m"
present "support: half the stiffness" --set support.odd.fastening=1 --set support.odd.stiffness=0.5
present "surface: dip of 20 um" --set surface.dip.kind=dip --set "surface.dip.at=10 mm" \
  --set "surface.dip.length=40 mm" --set "surface.dip.depth=20 um"
printf '# x [mm], y [mm], d [um]\n-20,-9,0\n0,-9,0\n20,-9,0\n-20,9,0\n0,9,20\n20,9,0\n' > "$work/map.csv"
present "surface: map of 20 um" --set surface.map.kind=map --set "surface.map.at=0 mm" --set "surface.map.file=$work/map.csv"
present "zone: one more" --set "zone.more.start=60 mm" --set "zone.more.length=40 mm"
exit $((failed * 3))
