#!/bin/sh
# The bundle is valid Turtle that describes a valid plugin, and its library needs and shows nothing that it should not.
set -u

bundle=${HOOKE_BUNDLE:?}
library=$bundle/hooke.so
copy=$(mktemp -d) || exit 1
trap 'rm -rf "$copy"' EXIT
failed=0

fail() {
  echo "failed: $*"
  failed=1
}

for tool in lv2_validate sord_validate nm objdump; do
  command -v $tool >/dev/null || { echo "skipped: there is no $tool"; exit 77; }
done
[ -e "$library" ] || { echo "failed: there is no $library"; exit 1; }

# It succeeds, and says nothing of an error or a warning. It takes a path with a blank in it for two.
is_valid() {
  said=$(cd "$1" && lv2_validate ./*.ttl 2>&1) || return 1
  ! echo "$said" | grep -Eiq 'error:|warning:|[1-9][0-9]* errors'
}

# The same bundle with one change must be found at fault, or the tool has not looked.
is_found() {
  rm -f "$copy"/*
  cp "$bundle"/*.ttl "$copy"
  sed "$2" "$bundle/$1.ttl" >"$copy/$1.ttl"
  ! cmp -s "$bundle/$1.ttl" "$copy/$1.ttl" || fail "nothing was changed by $2"
  ! is_valid "$copy"
}

is_valid "$bundle" || fail "lv2_validate finds fault with the bundle:
$said"
for plugin in strings guitar; do
  is_found $plugin 's/lv2:symbol/lv2:symbool/' || fail 'lv2_validate does not see a property that there is not'
  is_found $plugin 's/lv2:index 0 /lv2:index "much" /' || fail 'lv2_validate does not see a text for a number'
  is_found $plugin '1s/^/(/' || fail 'lv2_validate does not see a fault of syntax'
done

# By itself it knows no vocabulary, so all that it is asked is whether the file can be read.
is_read() {
  ! sord_validate "$1" 2>&1 | grep -q 'error reading'
}

for file in "$bundle"/*.ttl; do
  is_read "$file" || fail "sord_validate cannot read $file"
done
is_read "$copy/guitar.ttl" && fail 'sord_validate does not see a fault of syntax'

# Addresses and types aside, one name is shown.
shown=$(nm -D --defined-only "$library" | awk '{ print $NF }')
[ "$shown" = lv2_descriptor ] || fail "the library shows: $shown"

needed=$(objdump -p "$library" | awk '$1 == "NEEDED" { print $2 }')
for name in $needed; do
  case $name in
    libc.so.* | libm.so.*) ;;
    libasan.so.* | libubsan.so.*) ;;
    *) fail "the library needs $name" ;;
  esac
done

undefined=$(ldd -r "$library" 2>&1 | grep 'undefined symbol' | grep -Ev '__(asan|ubsan)_')
[ -z "$undefined" ] || fail "the library lacks: $undefined"

objdump -p "$library" | grep -A1 STACK | grep -q 'flags rw-' || fail 'the library asks for a stack that can be executed'
objdump -p "$library" | grep -E 'RPATH|RUNPATH' && fail 'the library says where to look for others'

exit $failed
