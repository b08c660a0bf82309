#!/usr/bin/env bash
# Takes the pictures in screenshots/ again: the window as a person sees it, and every scene drawn without a window.
# Usage: scripts/screenshots.sh [PROGRAM]    (PROGRAM: a polyscene that is built already; else a release build)
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/lib/system-packages.sh

install_packages "${WINDOW_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
if [ $# -gt 0 ]; then
  polyscene=$1
else
  need_rust
  need_compiler
  cargo build --release --locked
  polyscene=${CARGO_TARGET_DIR:-target}/release/polyscene
fi
mkdir -p screenshots/scenes

# window NAME SCENE COMMANDS: the pointer of the display in memory rests below the window, so nothing is hovered.
window() {
  xvfb-run -a -s '-screen 0 1600x2200x24' "$polyscene" ${2:+"scenes/$2.xml"} --do "$3" \
    --window-size 1600x1000 --screenshot "screenshots/$1.png"
}
window start '' ''
# A scene with errors ends with 1, and its picture shows them.
window problems invalid/several-problems 'tab:problems' || [ $? -eq 1 ]
window light cradle 'switch_colors,dt:1/2,step_forward*2,next_event,event:0'
window palette thesis-appendix-2 'palette'
window editor thesis-appendix-2 'dt:1,step_forward*5,next_event*3,select:5853'
window building '' 'build:room,build:rack;Ball radius=0.3;Cue ball=1,view_perspective,select:cue ball'
window parts '' 'build:table,build:funnel;Place x=2;Place z=2,build:stairs;Place x=7.5;Place z=2,build:pegboard;Place x=2.5;Place z=8,build:container;Place x=7.5;Place z=7.5,build:orbit,select_none,view_perspective,maximize_view'
window part-dialog '' 'build:room,select_none,rack'
window handles thesis-appendix-2 'select:28100,tool_turn,maximize_view'
window measuring billiards 'dt:1/10,step_forward*3,select:Left cushion,select:Stun,select:Stun object,view_top,maximize_view'
window export drag 'export:sdf'
window xml bounce 'show_xml,select:Ball'
window timeline thesis-appendix-2 'dt:1/20,step_forward*80,add_bookmark,select:15921,event_back_of_selection*4,overlay:trails'
window accuracy thesis-appendix-2 'tab:accuracy,study'
window tiles gas 'dt:1/10,step_forward*20,view_perspective,overlay:tiles,maximize_view'

"$polyscene" study scenes/thesis-appendix-2.xml --svg screenshots/study.svg --force >/dev/null

# Where a scene shows most, in seconds of model time; others are shown at 2 s.
declare -A moment=([bullet]=0.0101 [cradle]=1 [orbit]=5)
for scene in scenes/*.xml; do
  name=$(basename "$scene" .xml)
  "$polyscene" render "$scene" --at "${moment[$name]:-2}" --size 800x500 --force --out "screenshots/scenes/$name.png"
done

# The card that a window opens with shows these, without what lies at their edges (src/gui/pictures.rs).
declare -A telling=([bullet]=0.0101 [cradle]=1 [orbit]=5 [pour-5000]=0.6 [pour-1000]=1 [hopper]=1 [masses]=0.4 [galton]=4
  [galton-rough]=4 [bin]=1 [pyramid-hit]=0.8)
mkdir -p assets/samples
for scene in scenes/*.xml; do
  name=$(basename "$scene" .xml)
  "$polyscene" render "$scene" --at "${telling[$name]:-2}" --view perspective --overlays none --size 256x160 --zoom 0.3 \
    --force --out "assets/samples/$name.png"
done
