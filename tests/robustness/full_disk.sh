#!/usr/bin/env bash
# full_disk.sh TREAD SCENE [--set key=value ...]: runs the scene on file systems that are too small for it from the
# start, or become so in the preload; gives them room, resumes, and compares the files. Every kind of file is the one
# that finds the disk full at some size. Exit status 77: this user may not mount a tmpfs.
set -euo pipefail
tread=$1 scene=$2
if [[ ${FULL_DISK_INSIDE:-} != yes ]]; then
  if ! unshare --map-root-user --mount mount -t tmpfs tmpfs /mnt 2>/dev/null; then
    echo "skipped: this user may not mount a tmpfs in a name space of its own"
    exit 77
  fi
  FULL_DISK_INSIDE=yes exec unshare --map-root-user --mount "$0" "$@"
fi
shift 2
command -v h5diff >/dev/null || { echo "there is no h5diff; the Debian package hdf5-tools has it"; exit 1; }
export OMP_WAIT_POLICY=passive TREAD_CACHE=off
work=$(mktemp -d)
trap 'umount "$work/disk" 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/disk"
"$tread" run "$scene" -t 1 --quiet -o "$work/whole" "$@"
largest=$(du -sk "$work/whole" | cut -f1)

expect_same() {
  for file in histories.csv surface_axis.csv; do cmp "$work/whole/$file" "$work/disk/run/$file"; done
  for file in run.h5 patch.h5 surface.h5; do h5diff "$work/whole/$file" "$work/disk/run/$file"; done
}

# kB from the start on: the order does not fit, the run does not.
for case in "20:No space left on device" "100:the disk of $work/disk/run has .* left"; do
  mount -t tmpfs -o size=${case%%:*}k tmpfs "$work/disk"
  code=0
  "$tread" run "$scene" -t 1 --quiet -o "$work/disk/run" "$@" 2>"$work/errors" || code=$?
  echo "${case%%:*} from the start: exit $code $(cut -c1-160 "$work/errors")"
  ((code == 4))
  grep -q "${case#*:}" "$work/errors"
  umount "$work/disk"
done

# kB, and the time between checkpoints: often, and only one at the start.
for case in 1000:1h 1150:1h 1300:1h 1500:1h 1700:1h 1900:1h 2100:1h 2300:1h 2600:1h 2900:1h \
  1500:300ms 2200:300ms 3000:300ms; do
  size=${case%:*}
  mount -t tmpfs -o size=$((10 * largest + 20000))k tmpfs "$work/disk"
  "$tread" run "$scene" -t 1 --quiet -o "$work/disk/run" "$@" --set "output.checkpoint_interval=${case#*:}" \
    2>"$work/errors" &
  run=$!
  until grep -qs '"preload"' "$work/disk/run/status.json"; do sleep 0.01; done
  kill -STOP $run
  mount -o remount,size=${size}k "$work/disk"
  kill -CONT $run
  code=0
  wait $run || code=$?
  echo "$case: exit $code $(cut -c1-160 "$work/errors")"
  if ((code != 0)); then
    ((code == 4))
    grep -q "No space left on device" "$work/errors"
    mount -o remount,size=$((10 * largest + 20000))k "$work/disk"
    if [[ -e $work/disk/run/checkpoint/order.h5 ]]; then
      "$tread" resume "$work/disk/run" -t 1 --quiet
      expect_same
    fi
  else
    expect_same
  fi
  umount "$work/disk"
done
