#!/bin/sh
# It builds for other machines: all of it for ARM64, where the tests of core/ pass, and the bundle for Windows.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"
. "$HOOKE_SOURCE/tests/support/trees.sh"

windows=x86_64-w64-mingw32
arm=aarch64-linux-gnu
system=$HOOKE_SOURCE/.waf-cache/$arm

# Tests of core/ which an emulator, some 25 times as slow, has done in a minute. test_chain is the one in which each kernel
# agrees with a dense oracle.
core='status line pickup limiter pole pole_limits pole_plane tuning chain chain_calls chain_dither chain_fixed chain_sums
  chain_together chain_settle bank network_graph scale_text'

only_long 'building for ARM64 and Windows'
n_done=0
unset CC AR CFLAGS LDFLAGS

can_cross() {
    for tool in "$@"; do
        has "$tool" || {
            echo "left out: there is no $tool"
            return 1
        }
    done
    n_done=$((n_done + 1))
}

if can_cross $windows-gcc $windows-ar $windows-objdump; then
    copy_tree windows
    must windows configure --cross=$windows --werror --prefix=/usr
    must windows install --destdir="$dir/stage"
    installed '' usr/lib/lv2 '' | grep '^usr/' | sed 's/\.so$/.dll/' >wanted
    files_below stage >found
    cmp -s found wanted || fail "installed for Windows: $(diff wanted found)"
    ! grep -q 'hooke\.so' stage/usr/lib/lv2/hooke.lv2/manifest.ttl || fail 'the manifest names a library that is not there'
    grep -q 'hooke\.dll' stage/usr/lib/lv2/hooke.lv2/manifest.ttl || fail 'the manifest does not name the library'

    library=stage/usr/lib/lv2/hooke.lv2/hooke.dll
    $windows-objdump -p "$library" >headers
    same "$(sed -n '/Name Pointer\] Table/,/^$/s/.*\] //p' headers | grep -v Table)" lv2_descriptor 'what the library shows'
    same "$(awk '/DLL Name/ { print $3 }' headers | grep -viE '^(kernel32|msvcrt)\.dll$')" '' 'what the library needs'

    # The stack there is not fit for vectors of 32 bytes and more, so that none may be moved as if it were.
    $windows-objdump -d "$library" >code
    grep -q 'vmovup.*ymm.*(' code || fail 'found no vectors of 32 bytes'
    grep -q 'vmovup.*zmm.*(' code || fail 'found no vectors of 64 bytes'
    ! grep -E 'vmov(ap[sd]|dqa).*[yz]mm.*\(' code | head -n 3 | grep . || fail 'vectors are moved as if their place were fit'
fi

if can_cross $arm-gcc $arm-ar $arm-objdump qemu-aarch64 && { test -d "$system" || { echo "left out: there is no $system" && false; }; }; then
    copy_tree arm
    mkdir -p arm/.waf-cache && ln -s "$system" arm/.waf-cache/$arm
    must arm configure --cross=$arm --werror --prefix=/usr
    must arm test --only=test_status # builds all tests
    for file in arm/build/hooke arm/build/hooke.lv2/hooke.so; do
        readelf -h "$file" | grep -q 'Machine: *AArch64' || fail "$file is for: $(readelf -h "$file" | grep Machine)"
    done
    $arm-objdump -d arm/build/hooke.lv2/hooke.so | grep -qE 'f(add|mul)[[:space:]]+v[0-9]+\.4s' || fail 'found no vectors in it'

    for name in $core; do
        (unset HOOKE_TEST_LONG && cd arm/build && qemu-aarch64 -L "$system" tests/test_"$name") >log 2>&1 ||
            fail "test_$name, status $?: $(tail -n 20 log)"
        grep -q 'PASSED.* test(s)' log || fail "test_$name ran no test: $(tail -n 5 log)"
    done

    # And the plugin is played through a host there.
    printf '0 pluck 1\n0.2 pluck 2\n' >short.score
    LV2_PATH=$dir/arm/build/lv2:$system/usr/lib/lv2 \
        qemu-aarch64 -L "$system" arm/build/hooke render --tail 0.2 short.score out/arm.wav >there 2>&1 ||
        fail "it does not play: $(cat there)"
    "$HOOKE_BIN" render --tail 0.2 short.score out/here.wav >here 2>&1
    same "$(grep -o '[0-9.]* s, peak [^,]*' there)" "$(grep -o '[0-9.]* s, peak [^,]*' here)" 'how long and loud it is there'
fi

test $n_done -gt 0 || skip 'there is no compiler for another machine'
exit $((n_failed > 0))
