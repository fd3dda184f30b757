#!/bin/sh
#
# Installs the hosts that tests run, on Debian and what comes from it. Without them those tests are skipped, and say so.

set -eu

missing=

for program in jalv jackd jack_lsp; do
    command -v $program >/dev/null || missing=yes
done
dpkg-query -W ardour >/dev/null 2>&1 || missing=yes
[ -n "$missing" ] || exit 0

sudo=
[ "$(id -u)" -eq 0 ] || sudo='sudo -n'
apt="$sudo env DEBIAN_FRONTEND=noninteractive apt-get -qq"
$apt update
packages='ardour jalv jackd2'
! apt-cache show jack-example-tools >/dev/null 2>&1 || packages="$packages jack-example-tools" # jack_lsp, from Debian 13 on
# shellcheck disable=SC2086  # a list of words
$apt install -y --no-install-recommends $packages </dev/null >/dev/null
