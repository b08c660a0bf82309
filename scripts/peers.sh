#!/usr/bin/env bash
# Measures PolyScene beside rapier3d on the same scenes: time against error, in one run. It downloads and builds
# rapier3d. Prints a table and whether the claims hold, and writes every point to benches/peers/peers.csv.
# Usage: scripts/peers.sh [--quick] [--case TEXT] [--csv FILE]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/lib/system-packages.sh

need_rust
need_compiler
cd benches/peers
exec cargo run --locked --release -- "$@"
