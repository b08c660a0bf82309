#!/usr/bin/env bash
# Measures PolyScene beside rapier3d on the same scenes: time against error, in one run. It downloads and builds
# rapier3d. Prints a table and whether the claims hold, and writes every point to benches/peers/peers.csv. With
# `--case friction` MuJoCo and pooltool follow, which pip fetches into a temporary folder (or PEERS=FOLDER, which is kept);
# what cannot be fetched is skipped, and said to be.
# Usage: scripts/peers.sh [--quick] [--case TEXT] [--csv FILE]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/lib/system-packages.sh

need_rust
need_compiler
here=$PWD
cd benches/peers
case " $* " in
  *' --case friction '*) ;;
  *) exec cargo run --locked --release -- "$@" ;;
esac

rc=0
cargo run --locked --release -- "$@" || rc=$?
if [ -n "${PEERS:-}" ]; then
  mkdir -p "$PEERS"
  work=$(realpath "$PEERS")
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
(cd "$here" && cargo build --locked --release --no-default-features)
program=${CARGO_TARGET_DIR:-$here/target}/release/polyscene
cargo run --locked --release -- --case friction --write "$work" >/dev/null

# fetch PACKAGE MODULE: into a virtual environment. Isolated, for folders beside this one have the names of the modules.
fetch() {
  [ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv" || return 1
  "$work/venv/bin/python" -I -c "import $2" 2>/dev/null || "$work/venv/bin/pip" install --quiet "$1"
}

for peer in 'mujoco mujoco mujoco/rolling.py' 'pooltool-billiards pooltool pooltool/shots.py'; do
  read -r package module script <<<"$peer"
  if fetch "$package" "$module" >"$work/fetch.log" 2>&1; then
    "$work/venv/bin/python" "$script" "$program" "$work" || rc=$?
  else
    note "$package is skipped: it could not be fetched ($(tail -n 1 "$work/fetch.log"))"
  fi
done
exit "$rc"
