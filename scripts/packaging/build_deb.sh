#!/usr/bin/env bash
# scripts/packaging/build_deb.sh [FOLDER [CMAKE OPTION...]]: builds the Debian package of the program into FOLDER
# (default: build/package). Installs what the build needs, with apt. Needs dpkg-dev besides.
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../setup.sh"

packages+=(dpkg-dev file)
[[ ! -e $root/.git ]] || packages+=(git) # the program states its commit
install_packages
build=$root/build/package
folder=$(realpath -m "${1:-$build}")
shift || true
mkdir -p "$build" "$folder"

# The program of the package finds its data beside itself alone, and names no folder of this machine.
configure "$build/configure.log" "$build" --preset release -B "$build" -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_SKIP_RPATH=ON \
  -DCMAKE_SKIP_INSTALL_ALL_DEPENDENCY=ON -DTREAD_SOURCE_SHARE= -DTREAD_MPI=OFF "$@"
logged "$build/build.log" cmake --build "$build" --target tread || die "The build failed."
(cd "$build" && logged "$build/cpack.log" cpack -G DEB -B "$folder") || die "The package cannot be made."
rm -rf "$folder/_CPack_Packages"
ls "$folder"/tread_*.deb
