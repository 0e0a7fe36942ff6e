#!/usr/bin/env bash
# Installs what is missing on a Debian 12 machine: scripts/setup.sh [build|test]
#
#   build   what compiling, running and demonstrating Illumigraph needs (the default)
#   test    that, and what scripts/test.sh needs besides
#
# Asks dpkg first and calls apt only when something is missing, so a second run does nothing and
# needs neither root nor a network.
set -euo pipefail

build_packages=(
  g++ cmake ninja-build ccache pkg-config
  libpng-dev libjpeg62-turbo-dev libavif-dev libopenexr-dev libimath-dev libzip-dev zlib1g-dev
  libopenimageio-dev openimageio-tools liblcms2-dev libwebp-dev libhwy-dev libembree-dev libassimp-dev
  libeigen3-dev
  libopenblas-dev libtbb-dev libcli11-dev nlohmann-json3-dev libfmt-dev libgtest-dev libgmock-dev
  python3 python3-numpy python3-pil
)
test_packages=(
  clang-16 libclang-rt-16-dev clang-format libbenchmark-dev
  python3-pytest python3-pytest-xdist util-linux coreutils git chromium
)

missing_of() {
  local package
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
      echo "$package"
  done
}

# Browser tests need Node 18 or newer with npm. Where a newer one than Debian's is there, it stays.
node_packages() {
  local major=0
  if command -v node >/dev/null && command -v npm >/dev/null; then
    major=$(node --version | sed 's/^v\([0-9]*\).*/\1/')
  fi
  [ "$major" -ge 18 ] || echo nodejs npm
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "setup: packages are missing and need root to be installed: ${missing[*]}" >&2
    exit 1
  fi
}

case "${1:-build}" in
  build) wanted=("${build_packages[@]}") ;;
  test)
    read -r -a node <<<"$(node_packages)"
    wanted=("${build_packages[@]}" "${test_packages[@]}" "${node[@]}")
    ;;
  *)
    echo "usage: scripts/setup.sh [build|test]" >&2
    exit 2
    ;;
esac

mapfile -t missing < <(missing_of "${wanted[@]}")
if [ "${#missing[@]}" -eq 0 ]; then
  echo "setup: all ${#wanted[@]} packages are installed"
  exit 0
fi
echo "setup: installing ${#missing[@]} packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
as_root apt-get update -qq
as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
  "${missing[@]}"
