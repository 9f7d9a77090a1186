# Sourced by ./run and ./test: sets `root`; installs what the build of the program needs; builds.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
packages=(g++ cmake ninja-build libeigen3-dev libhdf5-dev libmetis-dev libtomlplusplus-dev libcli11-dev
  libfmt-dev libtbb-dev nlohmann-json3-dev)
installed= # packages of this call: the build is configured anew for them

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
  installed=${missing[*]}
}

# home_of FOLDER: the sources that a build folder is configured for; nothing where it is not configured.
home_of() { sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$1/CMakeCache.txt" 2>/dev/null || true; }

# arrived FOLDER NAME PROGRAM: succeeds where the configuration found no PROGRAM, and there is one now.
arrived() { grep -q "^$2:.*-NOTFOUND$" "$1/CMakeCache.txt" && command -v "$3" >/dev/null; }

# configured FOLDER PRESET TARGET: succeeds where FOLDER is configured for them, in this clone and with all packages.
configured() {
  [[ -z $installed && -f $1/build.ninja && $(home_of "$1") -ef $root && $(cat "$1/preset" 2>/dev/null) == "$2" ]] &&
    [[ $3 != all || -d $1/tests ]] && # without GoogleTest there are no tests
    ! arrived "$1" MPI_C_COMPILER mpicc && ! arrived "$1" TREAD_PYTHON python3
}

# configure LOG FOLDER OPTION...: configures FOLDER, from scratch where it came with a copied or moved clone.
configure() {
  local log=$1 folder=$2 home
  shift 2
  home=$(home_of "$folder")
  if [[ -n $home && ! $home -ef $root ]]; then
    echo "$folder was configured for $home; configuring it anew for $root ..." >&2
    find "$folder/" \( -name CMakeCache.txt -o -name CMakeFiles -o -name '*.cmake' -o -name build.ninja -o -name '.ninja_*' \) \
      -prune -exec rm -rf {} +
    rm -f "$folder/tread"
  fi
  (cd "$root" && logged "$log" cmake -D TREAD_SYSTEM_LIBRARIES=ON "$@") || die "The build cannot be configured."
}

# Part of `build` that calls in one clone take in turn.
configure_and_build() {
  local preset=$1 target=$2 folder=$root/build/release unused_card
  if ! configured "$folder" "$preset" "$target"; then
    rm -f "$folder/preset"
    configure "$root/build/configure.log" "$folder" --preset "$preset"
    echo "$preset" >"$folder/preset"
  fi
  unused_card=$(cat "$folder/unused_card.txt" 2>/dev/null) || true
  [[ -z $unused_card ]] || echo "$unused_card" >&2
  [[ -x $folder/tread ]] || echo "Building; this takes minutes, once ..." >&2
  logged "$root/build/build.log" cmake --build "$folder" --target "$target" || die "The build failed."
}

# build PRESET TARGET: configures if needed and builds in build/release; one call at a time.
build() {
  local status=0
  mkdir -p "$root/build/release"
  exec 9>"$root/build/lock"
  # 1: another call holds the lock. All else: no flock, or a file system without locks.
  flock -n 9 2>/dev/null || [[ $? != 1 ]] || { echo "Another call is building here; waiting ..." >&2; flock 9; }
  (configure_and_build "$@") || status=$?
  flock -u 9 2>/dev/null || true # a compiler cache's server may have inherited it
  exec 9>&-
  return "$status"
}
