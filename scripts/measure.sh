#!/usr/bin/env bash
# Measures what the program promises about speed, in a release build. Each program in benches/ prints its figures.
# Usage: scripts/measure.sh [NAME]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/lib/system-packages.sh

need_rust
need_compiler
exec cargo bench --locked --bench "${1:-*}"
