# Sourced by ./run and ./test: sets `root`; installs what the build of the program needs; builds.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
packages=(g++ cmake ninja-build libeigen3-dev libhdf5-dev libmetis-dev libtomlplusplus-dev libcli11-dev
  libfmt-dev libtbb-dev nlohmann-json3-dev)

# die MESSAGE...: one line each; the exit code says that the machine lacks something.
die() {
  printf '%s\n' "$@" >&2
  exit 4
}

# logged LOG COMMAND...: runs silently; shows the end of what was said if the command fails.
logged() {
  local log=$1
  shift
  "$@" >"$log" 2>&1 || {
    tail -n 60 "$log" >&2
    echo "Failed: $* (all of its output: $log)" >&2
    return 1
  }
}

# Installs the packages that are not there; calls apt only if one is missing.
install_packages() {
  local package missing=() sudo=()
  command -v dpkg-query >/dev/null ||
    die "This is not a Debian or Ubuntu system. Install what these packages hold: ${packages[*]}" \
      "and build with: cmake --preset release && cmake --build --preset release"
  for package in "${packages[@]}"; do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  command -v apt-get >/dev/null || die "There is no apt-get; install: ${missing[*]}"
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      die "Packages are missing and there is no sudo. Ask an administrator for: apt-get install ${missing[*]}"
    sudo=(sudo)
  fi
  echo "Installing ${missing[*]} ..." >&2
  mkdir -p "$root/build"
  logged "$root/build/apt.log" "${sudo[@]}" apt-get update -qq || true # the lists at hand may do
  logged "$root/build/apt.log" "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" || die "Could not install: ${missing[*]}"
}

# build PRESET TARGET: configures if needed and builds in build/release.
build() {
  local preset=$1 target=$2 folder=$root/build/release
  mkdir -p "$folder"
  # A folder configured without GoogleTest has no tests: ./test configures it anew.
  if [[ ! -f $folder/build.ninja || $(cat "$folder/preset" 2>/dev/null) != "$preset" ||
    ($target == all && ! -d $folder/tests) ]]; then
    (cd "$root" && logged build/configure.log cmake --preset "$preset") || die "The build cannot be configured."
    echo "$preset" >"$folder/preset"
  fi
  local unused_card
  unused_card=$(cat "$folder/unused_card.txt" 2>/dev/null) || true
  [[ -z $unused_card ]] || echo "$unused_card" >&2
  [[ -x $folder/tread ]] || echo "Building; this takes minutes, once ..." >&2
  logged "$root/build/build.log" cmake --build "$folder" --target "$target" || die "The build failed."
}
