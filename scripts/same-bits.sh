#!/usr/bin/env bash
# Runs two builds of polyscene over all sample scenes with every method, and compares events, states and summaries
# byte for byte (but for the wall time): a change that only moves code about must print nothing here.
# Usage: scripts/same-bits.sh BASE NEW [SCENE|FOLDER ...]
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -lt 2 ]; then
  sed -n '2,4s/^# //p' "$0"
  exit 2
fi
base=$(realpath "$1")
new=$(realpath "$2")
shift 2

# s per run. One that takes longer in both builds counts as equal; in one of them, both get ten times as long.
limit=${LIMIT:-20}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Everything a run says, into $work/NAME.*.
record() {
  local program=$1 scene=$2 method=$3 name=$4 time=$5 rc=0
  rm -f "$work/$name".*
  timeout "$time" "$program" run "$scene" --dt 1/60 --until 4 --every 60 --method "$method" \
    --events "$work/$name.events" --states "$work/$name.states" --json \
    >"$work/$name.summary" 2>"$work/$name.messages" || rc=$?
  echo "$rc" >"$work/$name.status"
  sed -i -E 's/"wall_s":[^,]*,//' "$work/$name.summary"
}

scenes=()
for place in "$here/scenes" "$here/scenes/hard" "$@"; do
  if [ -d "$place" ]; then
    scenes+=("$place"/*.xml)
  else
    scenes+=("$place")
  fi
done

different=0 slow=0
for scene in "${scenes[@]}"; do
  for method in exact thesis fixed; do
    record "$base" "$scene" "$method" base "$limit"
    record "$new" "$scene" "$method" new "$limit"
    case "$(cat "$work/base.status") $(cat "$work/new.status")" in
      '124 124')
        slow=$((slow + 1))
        continue
        ;;
      '124 '* | *' 124')
        record "$base" "$scene" "$method" base "$((10 * limit))"
        record "$new" "$scene" "$method" new "$((10 * limit))"
        ;;
    esac
    for part in status messages events states summary; do
      touch "$work/base.$part" "$work/new.$part"
      if ! cmp -s "$work/base.$part" "$work/new.$part"; then
        different=$((different + 1))
        echo "$scene ($method): the $part differ"
        diff "$work/base.$part" "$work/new.$part" | head -n 4 | cut -c 1-200 || true
      fi
    done
  done
done
echo "${#scenes[@]} scenes compared, $different differences, $slow runs out of time in both" >&2
[ "$different" -eq 0 ]
