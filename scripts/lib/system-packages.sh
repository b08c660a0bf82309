# shellcheck shell=bash
# What the other scripts share: the Debian and Ubuntu packages PolyScene needs, and Rust. Sourced, not run.

# To build: a C compiler links the program; no -dev package is needed.
# shellcheck disable=SC2034  # used by the scripts that source this file
BUILD_PACKAGES=(gcc libc6-dev)

# To draw without a display: OpenGL through EGL, in software where there is no GPU.
# shellcheck disable=SC2034
RENDER_PACKAGES=(libegl1 libegl-mesa0 libgl1-mesa-dri)

# To open the window: the program loads these when it starts.
# shellcheck disable=SC2034
WINDOW_PACKAGES=(
  libgl1 libegl1 libgl1-mesa-dri libglx-mesa0 libegl-mesa0
  libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon0 libxkbcommon-x11-0
  libwayland-client0 libwayland-egl1 libdbus-1-3
)

# To test: a display in memory with its start-up helper, the linter of these scripts, and a checker of XML schemas.
# shellcheck disable=SC2034
TEST_PACKAGES=(xvfb xauth shellcheck libxml2-utils)

note() { printf '%s\n' "$*" >&2; }

is_installed() {
  dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed
}

# install_packages PACKAGE...: installs what is missing when it may. Fails, after printing the command
# to type, when something is still missing; the caller decides whether that matters.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    note "This is not Debian or Ubuntu: please see to it that the equivalents of these are installed: $*"
    return 0
  fi
  local package missing=()
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      as_root=(sudo -n)
    else
      note "Missing system packages. Please run:  sudo apt-get install ${missing[*]}"
      return 1
    fi
  fi
  note "Installing system packages: ${missing[*]}"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=120)
  # An old index may still know the packages, so a failed update is not the end.
  "${as_root[@]}" "${apt[@]}" update >/dev/null || note "apt-get update failed; trying with the index there is"
  if ! "${as_root[@]}" "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null; then
    note "Could not install: ${missing[*]}"
    return 1
  fi
}

# need_rust: puts cargo on the PATH, or says where to get it.
need_rust() {
  command -v cargo >/dev/null && return 0
  if [ -r "${CARGO_HOME:-$HOME/.cargo}/env" ]; then
    # shellcheck source=/dev/null
    . "${CARGO_HOME:-$HOME/.cargo}/env"
    command -v cargo >/dev/null && return 0
  fi
  note "Rust is missing. Please install it with rustup, see https://rustup.rs, and run this again."
  return 1
}

# need_compiler: a compiler that is there already will do, wherever it came from.
need_compiler() {
  command -v cc >/dev/null || install_packages "${BUILD_PACKAGES[@]}"
}
