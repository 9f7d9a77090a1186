#!/usr/bin/env bash
# scripts/packaging/test_deb.sh PACKAGE [TREE]: installs a package in a fresh Debian 12, runs scenes there as an
# ordinary user and removes the package. Exit status 1: something fails, or a file stays behind.
#
# TREE: a tree of debootstrap --variant=minbase; made in a temporary folder where it is not given.
# TREAD_MIRROR: the mirror for it (default: the first one of this machine's own sources).
# Needs root, and debootstrap for a fresh tree.
set -euo pipefail

package=$(readlink -f "${1:?which package? see the head of this file}")
tree=${2:-}
((EUID == 0)) || { echo "test_deb.sh needs root for chroot: run it with sudo" >&2; exit 4; }
work=$(mktemp -d)
unmount() { umount -q "$work/root/proc" || true; }
trap 'unmount; rm -rf "$work"' EXIT

say() { printf '[%4d s] %s\n' "$SECONDS" "$*"; }
# inside COMMAND...: in the tree, with no more environment than a new login has
inside() { chroot "$work/root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
as_user() { inside su - guest -c "$*"; }
installed() { inside dpkg-query -W -f "\${Package}\n" | sort; }
# Files of the tree, without those that apt and dpkg keep about themselves.
files() {
  (cd "$work/root" && find . -xdev \( -path ./proc -o -path ./var/cache -o -path ./var/log -o -path ./var/lib/apt \
    -o -path ./var/lib/dpkg -o -path ./home -o -path ./root -o -path ./tmp \) -prune -o -print) | sort
}

sources=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources 2>/dev/null |
  grep -v '^#' || true)
mirror=${TREAD_MIRROR:-$(grep -om1 -E 'https?://[^ ]+' <<<"$sources" || true)}
if [[ -z $tree ]]; then
  say "debootstrap"
  debootstrap --variant=minbase bookworm "$work/root" ${mirror:+"$mirror"} >"$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2; exit 4; }
else
  cp -a "$tree" "$work/root"
fi
mount -t proc proc "$work/root/proc"
cp "$package" "$work/root/tmp/tread.deb"
chmod 644 "$work/root/tmp/tread.deb"
inside useradd --create-home --shell /bin/bash guest
say "apt-get update"
inside apt-get update -qq
files >"$work/before"
installed >"$work/packages"

say "apt-get install"
# Dependencies alone: a recommended package may stay because another one recommends it, too.
inside apt-get install -y -qq --no-install-recommends /tmp/tread.deb >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; exit 1; }
say "$(comm -13 "$work/packages" <(installed) | wc -l) packages were added"
[[ -z $(inside ldd /usr/bin/tread | grep 'not found' || true) ]] || { echo "libraries are missing" >&2; exit 1; }

say "runs of a user, in a folder of its own"
as_user 'mkdir work && cd work && tread --version'
as_user 'cd work && tread run bar-wave.toml -o bar --quiet && tread results bar' >"$work/bar"
grep -q '^State: done$' "$work/bar"
as_user 'cd work && tread run tyre -o tyre --quiet --set "scene.element_size=8 mm" && tread check corrugation-d' \
  >"$work/tyre"
as_user 'cd work && tread run tyre -o lanes --quiet --set "scene.element_size=8 mm"' # again: from the cache
as_user 'cd work && TREAD_INSTRUCTION_SET=baseline tread run bar-wave -o baseline --quiet'
as_user 'test -s work/tyre/report.html && grep -q "highspeed" /usr/share/tread/references/*.toml'
for file in /usr/share/man/man1/tread.1 /usr/share/man/man1/tread-run.1 /usr/share/doc/tread/copyright \
  /usr/share/doc/tread/docs/can-and-cannot.md \
  /usr/share/bash-completion/completions/tread /usr/share/zsh/vendor-completions/_tread \
  /usr/lib/python3/dist-packages/tread_results.py; do
  inside test -s "$file" || { echo "$file is missing" >&2; exit 1; }
done
# The program must not know the machine that built it.
[[ -z $(inside grep -c -e "$(readlink -f "$(dirname "$0")/../..")" /usr/bin/tread | grep -v '^0$' || true) ]] ||
  { echo "/usr/bin/tread names a folder of the machine that built it" >&2; exit 1; }

say "purge"
inside apt-get purge -y -qq --autoremove tread >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; exit 1; }
files >"$work/after"
if ! diff "$work/before" "$work/after" >"$work/left"; then
  echo "the tree is not as it was (<: lost, >: left behind):" >&2
  grep "^[<>]" "$work/left" | head -n 20 >&2
  exit 1
fi
say "nothing is left behind"
