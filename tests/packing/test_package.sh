#!/bin/sh
# One command makes a Debian package, which can be installed, plays, and can be removed without a trace.
set -u

. "${HOOKE_SOURCE:?is the directory of the sources}/tests/support/claims.sh"
. "$HOOKE_SOURCE/tests/support/trees.sh"

version=$(sed -n "s/^VERSION = '\(.*\)'$/\1/p" "$HOOKE_SOURCE/wscript")
same "$(sed -n '1s/.*(\(.*\)).*/\1/p' "$HOOKE_SOURCE/debian/changelog")" "$version" 'the version in debian/changelog'

only_long 'making a package'
needs dpkg-buildpackage dpkg-dev
needs dpkg-checkbuilddeps dpkg-dev
needs dh debhelper
needs fakeroot fakeroot
(cd "$HOOKE_SOURCE" && dpkg-checkbuilddeps) 2>missing || skip "$(cat missing)"

copy_tree tree
mkdir -p tree/.waf-cache
cp -R "${WAFDIR:?}/waflib" tree/.waf-cache
unset WAFDIR CFLAGS LDFLAGS LV2_PATH
(cd tree && dpkg-buildpackage -us -uc) >log 2>&1 || {
    fail "dpkg-buildpackage: $(tail -n 30 log)"
    exit 1
}
grep -E 'dpkg-[a-z]*: warning' log && fail 'dpkg-buildpackage warns'

# The sources in it are ours and waf's, so that nothing is fetched while it builds.
tar -tf "hooke_$version.tar.xz" | grep -v '/$' | sed 's|^[^/]*/||' | LC_ALL=C sort >packed
{ source_files && (cd tree && find .waf-cache -type f ! -path '*__pycache__*' | sed 's|^\./||'); } | LC_ALL=C sort >wanted
cmp -s packed wanted || fail "the source package has: $(diff wanted packed)"

package=$(echo hooke_"$version"_*.deb)
dpkg-deb -x "$package" unpacked
{
    installed usr/bin usr/lib/lv2 usr/share/man | sed 's|hooke\.1$|&.gz|'
    { (cd "$HOOKE_SOURCE" && ls README.md CONTRIBUTING.md doc/*) | grep -v 'hooke\.1$' && printf '%s\n' changelog.gz copyright; } |
        sed 's|^|usr/share/doc/hooke/|'
} | LC_ALL=C sort >wanted
files_below unpacked >found
cmp -s found wanted || fail "the package has: $(diff wanted found)"

needs=$(dpkg-deb -f "$package" Depends)
for library in libc6 liblilv liblapack libsndfile; do
    case $needs in
        *$library*) ;;
        *) fail "the package does not depend on $library: $needs" ;;
    esac
done
same "$(dpkg-deb -f "$package" Provides)" lv2-plugin 'what the package provides'
for file in unpacked/usr/bin/hooke unpacked/usr/lib/lv2/hooke.lv2/hooke.so; do
    ! readelf -S "$file" | grep -q '\.symtab' || fail "$file has its symbols"
    readelf -d "$file" | grep -q BIND_NOW || fail "$file is not bound when it is loaded"
    ! readelf -d "$file" | grep -E 'RPATH|RUNPATH' || fail "$file says where to look for others"
done
gzip -dc unpacked/usr/share/man/man1/hooke.1.gz | cmp -s - "$HOOKE_SOURCE/doc/hooke.1" || fail 'the manual page is another'

# Into a system of its own.
mkdir -p root/var/lib/dpkg/info root/var/lib/dpkg/updates root/var/lib/dpkg/triggers
: >root/var/lib/dpkg/status
: >root/var/lib/dpkg/available
dpkg_there() {
    fakeroot dpkg --root="$dir/root" --log="$dir/dpkg.log" --force-not-root --force-depends --force-bad-path \
        --force-script-chrootless "$@" >log 2>&1 || fail "dpkg $*: $(cat log)"
}
there() {
    (cd root && find . ! -path './var/lib/dpkg/*' | LC_ALL=C sort)
}
there >before
dpkg_there -i "$package"
same "$(dpkg-query --admindir=root/var/lib/dpkg -W -f '${Status}' hooke)" 'install ok installed' 'the state of the package'

specifications=$(pkg-config --variable=lv2dir lv2)
LV2_PATH=$dir/root/usr/lib/lv2:${specifications:-/usr/lib/lv2}
export LV2_PATH
for plugin in urn:hooke:strings urn:hooke:guitar; do
    lv2ls | grep -qx "$plugin" || fail "$plugin is not found: $(lv2ls)"
done
same "$(root/usr/bin/hooke --version)" "hooke $version" 'the version that the program says'
for tune in demo.mid demo.score; do
    root/usr/bin/hooke render "$HOOKE_SOURCE/doc/$tune" out/packaged.wav >packaged 2>&1 || fail "$tune: $(cat packaged)"
    (unset LV2_PATH && "$HOOKE_BIN" render "$HOOKE_SOURCE/doc/$tune" out/built.wav) >built 2>&1
    same "$(grep -o '[0-9.]* s, peak [^,]*' packaged)" "$(grep -o '[0-9.]* s, peak [^,]*' built)" "how long and loud $tune is"
done

dpkg_there -P hooke
there >after
cmp -s before after || fail "left or taken by purge: $(diff before after)"

if has lintian; then
    lintian --fail-on error,warning --suppress-tags bogus-mail-host,initial-upload-closes-no-bugs \
        ./*.changes >lint 2>&1 || fail "lintian: $(cat lint)"
else
    echo 'not looked at by lintian: it is not installed'
fi

exit $((n_failed > 0))
