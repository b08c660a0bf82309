#!/usr/bin/env bash
# Sets up, builds and opens the editor on a scene (the thesis scene by default).
# Without a display it draws the scene to a picture and simulates it instead.
# Usage: scripts/run.sh [SCENE]
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$here/scripts/lib/system-packages.sh"

case "${1:-}" in
  -h | --help)
    sed -n '2,4s/^# //p' "$0"
    exit 0
    ;;
esac
scene=${1:-$here/scenes/thesis-appendix-2.xml}
if [ ! -r "$scene" ]; then
  note "There is no scene file $scene"
  exit 1
fi
scene=$(realpath "$scene")
cd "$here"

need_rust
need_compiler

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  install_packages "${WINDOW_PACKAGES[@]}" || note "Going on: the window may still open."
  exec cargo run --release --locked -- "$scene"
fi

echo "There is no display: the scene is drawn to a picture and simulated for 10 s instead of being opened."
install_packages "${RENDER_PACKAGES[@]}" || note "Going on: drawing may still work."
cargo build --release --locked
polyscene=${CARGO_TARGET_DIR:-target}/release/polyscene
picture=${CARGO_TARGET_DIR:-target}/$(basename "$scene" .xml).png

echo
"$polyscene" run "$scene" --dt 1/60 --until 10
echo
"$polyscene" render "$scene" --force --out "$picture" && echo "The picture is $picture"
