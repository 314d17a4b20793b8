# Shared by ./rhombloom and tests/run: installs what is missing from Debian, configures and builds.
# Expects `root` to be the folder of the checkout.

export PATH="$PATH:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
export DEBIAN_FRONTEND=noninteractive

setup_log=$root/build/setup.log

say() { printf 'rhombloom: %s\n' "$1" >&2; }

# Runs a command with its output in the log; shows the log's end when it fails.
logged() {
    mkdir -p "$root/build"
    if ! "$@" >>"$setup_log" 2>&1 </dev/null; then
        tail -n 30 "$setup_log" >&2
        say "\"$1\" failed; the whole log is in build/setup.log"
        exit 3
    fi
}

# The packages of the given lists (cmake/packages.NAME) that are not installed.
missing_packages() {
    local list package
    for list in "$@"; do
        while read -r package; do
            case $package in
            '' | \#*) continue ;;
            # Node.js is often there from elsewhere, and Debian's npm would not install beside it.
            nodejs) command -v node >/dev/null && continue ;;
            npm) command -v npm >/dev/null && continue ;;
            esac
            dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || echo "$package"
        done <"$root/cmake/packages.$list"
    done
}

install_packages() {
    local missing
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} -eq 0 ] && return
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            say "these Debian packages are missing; install them as root: ${missing[*]}"
            exit 3
        fi
        as_root=(sudo --preserve-env=DEBIAN_FRONTEND)
    fi
    say "installing ${#missing[@]} Debian packages ..."
    logged "${as_root[@]}" apt-get update
    logged "${as_root[@]}" apt-get install -y --no-install-recommends "${missing[@]}"
}

# configure PRESET [OPTION ...]
configure() {
    cd "$root" && logged cmake --preset "$@"
}

# build PRESET [TARGET ...]
build() {
    local preset=$1
    shift
    cd "$root" && logged cmake --build --preset "$preset" ${1:+--target "$@"}
}
