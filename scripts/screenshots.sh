#!/usr/bin/env bash
# Takes the pictures in screenshots/ again: every scene drawn without a window.
# Usage: scripts/screenshots.sh
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/lib/system-packages.sh

need_rust
need_compiler
install_packages "${WINDOW_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
cargo build --release --locked
polyscene=${CARGO_TARGET_DIR:-target}/release/polyscene

# Where a scene shows most, in seconds of model time; others are shown at 2 s.
declare -A moment=([bullet]=0.0101 [cradle]=1 [orbit]=5)

mkdir -p screenshots/scenes
for scene in scenes/*.xml; do
  name=$(basename "$scene" .xml)
  "$polyscene" render "$scene" --at "${moment[$name]:-2}" --size 1200x750 --out "screenshots/scenes/$name.png"
done
