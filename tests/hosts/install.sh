#!/bin/sh
#
# Installs the hosts that tests run, on Debian and what comes from it. Without them those tests are skipped, and say so.

set -eu

missing=

for program in ardour7-lua jalv jackd; do
    command -v $program >/dev/null || missing=yes
done
[ -n "$missing" ] || exit 0

sudo=
[ "$(id -u)" -eq 0 ] || sudo='sudo -n'
apt="$sudo env DEBIAN_FRONTEND=noninteractive apt-get -qq"
$apt update
$apt install -y --no-install-recommends ardour jalv jackd2 </dev/null >/dev/null
