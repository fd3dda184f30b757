#!/bin/sh
#
# usage: fetch_system.sh TRIPLE DIRECTORY
#
# Unpack the libraries that Hooke is built with into DIRECTORY, from Debian's packages for the machine TRIPLE.
# Nothing is installed, and package lists of its own are used, so that this needs no root and changes no system.

set -eu

triple=$1
target=$2
packages='libc6-dev libcmocka-dev liblapack-dev liblilv-dev libsndfile1-dev lv2-dev'

give_up() {
  printf 'fetch_system: %s\n' "$*" >&2
  exit 1
}

architecture=$(dpkg-architecture -f -t "$triple" -q DEB_HOST_ARCH 2>/dev/null) ||
  give_up "Debian knows no machine $triple"

mkdir -p "$(dirname "$target")"
work=$(mktemp -d "$target.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/system"

get() {
  apt-get -qq -o APT::Sandbox::User=root -o APT::Architecture="$architecture" \
    -o APT::Architectures="$architecture" -o Acquire::Languages=none -o Debug::NoLocking=1 \
    -o Dir::State::Lists="$work/lists" -o Dir::State::Status=/dev/null -o Dir::Cache="$work/cache" "$@"
}

printf 'fetch_system: unpacking libraries for %s into %s\n' "$architecture" "$target" >&2
get update || give_up 'the package lists could not be fetched'
# shellcheck disable=SC2086  # a list of words
get install --download-only -y --no-install-recommends $packages >/dev/null ||
  give_up 'the packages could not be fetched'
for package in "$work"/cache/archives/*.deb; do
  case ${package##*/} in
    libpython* | libssl*) ;;
    lib* | lv2* | zlib* | linux-libc*) dpkg-deb -x "$package" "$work/system" ;;
  esac
done

# What Debian has an administrator choose when a package is installed.
cd "$work/system/usr/lib/$triple"
for library in blas lapack; do
  for file in "$library"/*.so*; do ln -sf "$file" .; done
  ln -sf "$library-netlib.pc" "pkgconfig/$library.pc"
done

# Links from the root of that system are to lead into it and not into this one's.
find "$work/system" -type l -lname '/*' | while read -r link; do
  ln -sfnr "$work/system$(readlink "$link")" "$link"
done
mv -T "$work/system" "$target"
