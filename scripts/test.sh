#!/usr/bin/env bash
# Sets up what the tests need and runs every check and test, as CI does. One profile is built (dev).
# Usage: scripts/test.sh
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/lib/system-packages.sh

# Each step is named, so that a failure says what failed.
step() {
  current=$1
  printf '\n== %s (at %d s)\n' "$1" "$SECONDS"
  shift
  "$@"
}
current=setup
trap '[ $? -eq 0 ] || printf "\nFAILED: %s\n" "$current" >&2' EXIT

set_up() {
  need_rust
  need_compiler
  install_packages "${WINDOW_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
  # rust-toolchain.toml names the components, but a toolchain that was there before may lack them.
  local component
  for component in rustfmt clippy; do
    cargo "${component/rustfmt/fmt}" --version >/dev/null 2>&1 && continue
    note "$component is missing from the toolchain"
    rustup component add "$component"
  done
}

# Two versions of a crate whose types cross our code compile, and then nothing fits or draws.
no_second_version() {
  local crates='egui|eframe|egui_glow|glow|glam|three-d' twice
  twice=$(cargo tree --locked --features inspection --edges normal,dev --prefix none --format '{p}' |
    grep -oE "^($crates) v[^ ]+" | sort -u | cut -d' ' -f1 | uniq -d)
  if [ -n "$twice" ]; then
    echo "two versions of: $twice"
    return 1
  fi
}

# Real-window tests need a display; one in memory disturbs nobody.
tests() {
  xvfb-run -a -s '-screen 0 1600x1000x24' cargo test --locked --features inspection --lib --bins --test it
}

step 'system packages and toolchain' set_up
step 'format' cargo fmt --check
step 'scripts' shellcheck -x .ci/run scripts/*.sh scripts/lib/*.sh
step 'one version of each shared crate' no_second_version
step 'lints, everything' cargo clippy --locked --features inspection --all-targets -- -D warnings
step 'lints, without window and OpenGL' cargo clippy --locked --no-default-features -- -D warnings
step 'lints, without window' cargo clippy --locked --no-default-features --features render -- -D warnings
step 'documentation' env RUSTDOCFLAGS='-D warnings' cargo doc --locked --no-deps --features inspection
step 'examples in the documentation' cargo test --locked --features inspection --doc
step 'tests' tests
printf '\nAll checks and tests passed in %d s.\n' "$SECONDS"
