#!/usr/bin/env bash
# Exports all sample scenes and loads them into the programs they are for: MuJoCo, OpenUSD, Khronos's glTF validator,
# and Gazebo's libsdformat. These are fetched by pip, npm and apt into a temporary folder; what cannot be fetched is
# skipped, and said to be. CONSUMERS=FOLDER keeps that folder for the next time.
# Usage: scripts/consumers.sh [PROGRAM]
# shellcheck disable=SC2317  # the functions that fetch are called by name
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case ${1:-} in -*)
  sed -n '2,5s/^# //p' "$0"
  exit 2
  ;;
esac
if [ $# -gt 0 ]; then
  program=$(realpath "$1")
else
  (cd "$here" && cargo build --locked --release --no-default-features)
  program=${CARGO_TARGET_DIR:-$here/target}/release/polyscene
fi

if [ -n "${CONSUMERS:-}" ]; then
  work=$CONSUMERS
  mkdir -p "$work"
  work=$(realpath "$work")
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi

# fetch_python PACKAGE MODULE: into a virtual environment.
fetch_python() {
  [ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv" || return 1
  "$work/venv/bin/python" -c "import $2" 2>/dev/null || "$work/venv/bin/pip" install --quiet "$1"
}

fetch_gltf() {
  [ -d "$work/node_modules/gltf-validator" ] ||
    (cd "$work" && npm install --silent --prefix . gltf-validator) || return 1
  [ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv"
}

# Debian's libsdformat with what it needs, unpacked and not installed, and a small reader built with it.
SDF_PACKAGES=(libsdformat-dev libsdformat12-12 sdformat-sdf libignition-math-dev libignition-math6-6
  libignition-utils-dev libcli11-dev libtinyxml2-9 libtinyxml2.6.2v5 liburdfdom-model3.0 liburdfdom-world3.0
  libconsole-bridge1.0)

fetch_sdf() {
  [ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv" || return 1
  local root=$work/sdformat libraries package
  if [ ! -x "$work/read_sdf" ]; then
    mkdir -p "$root"
    (cd "$root" && apt-get -qq download "${SDF_PACKAGES[@]}") || return 1
    for package in "$root"/*.deb; do
      dpkg -x "$package" "$root" || return 1
    done
    libraries=$(dirname "$(find "$root" -name libsdformat12.so)") || return 1
    g++ -std=c++17 -O1 "$here/scripts/consumers/read_sdf.cc" -o "$work/read_sdf" \
      -I"$root/usr/include/sdformat-12.3" -I"$root/usr/include/ignition/math6" \
      -I"$root/usr/include/ignition/utils1" -I"$root/usr/include" -L"$libraries" -lsdformat12 -lignition-math6 \
      -Wl,-rpath-link,"$libraries" || return 1
  fi
  libraries=$(dirname "$(find "$root" -name libsdformat12.so)")
  export LD_LIBRARY_PATH=$libraries SDF_PATH=$root/usr/share/sdformat12
}

wrong=0
# check CONSUMER FETCH...
check() {
  local consumer=$1 rc=0
  shift
  printf '%s\n' "$consumer"
  if ! "$@" >"$work/fetch.log" 2>&1; then
    printf '  skipped: it could not be fetched (%s)\n' "$(tail -n 1 "$work/fetch.log")"
    return
  fi
  "$work/venv/bin/python" "$here/scripts/consumers/check.py" "$consumer" "$program" "$work" \
    "$here"/scenes/*.xml "$here"/scenes/hard/*.xml || rc=$?
  case $rc in
    0) echo '  passed' ;;
    3) echo '  skipped' ;;
    *)
      echo '  FAILED'
      wrong=1
      ;;
  esac
}

check mujoco fetch_python mujoco mujoco
check usd fetch_python usd-core pxr
check gltf fetch_gltf
check sdf fetch_sdf
exit "$wrong"
