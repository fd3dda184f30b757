# shellcheck shell=sh disable=SC2034,SC2154
#
# What the tests of building, packing and installing share besides claims.sh: to be read after it with `.`, not run.

# Quick to compile; what is made is not to be fast.
quick='-O0'

# Say why what follows is left out, unless the long versions are asked for.
only_long() {
    test -n "${HOOKE_TEST_LONG-}" && return
    echo "left out, for it takes a minute or more: $*; ./waf test --long does it"
    exit $((n_failed > 0))
}

# The files that belong to the sources, in the order of their names: what git says or, where there is none, all.
source_files() {
    (
        cd "$HOOKE_SOURCE" || exit
        if test -e .git && has git; then
            git -c safe.directory='*' ls-files
        else
            find . -type f ! -path './build/*' ! -path './.git' ! -path './.git/*' ! -path './.waf-cache/*' ! -name '.lock-waf*' ! -path '*/__pycache__/*' |
                sed 's|^\./||'
        fi
    ) | LC_ALL=C sort
}

# copy_tree DIRECTORY: the sources alone, as they are now.
copy_tree() {
    mkdir -p "$1" && (cd "$HOOKE_SOURCE" && source_files | tar -cf - -T -) | tar -xf - -C "$1"
}

# in_tree DIRECTORY ARGUMENT...: waf there, asking for nothing from elsewhere; what it says goes to waf.log.
in_tree() (
    cd "$1" || exit
    shift
    HOOKE_NO_CHECK=1 HOOKE_NO_INSTALL=1 PYTHONDONTWRITEBYTECODE=1 ./waf "$@" >"$dir/waf.log" 2>&1
)

# must DIRECTORY ARGUMENT...: the same, and it has to succeed.
must() {
    in_tree "$@" || {
        fail "waf $* failed: $(tail -n 25 "$dir/waf.log")"
        exit 1
    }
}

# The names of all files below a directory, one a line.
files_below() {
    (cd "$1" && find . ! -type d | sed 's|^\./||' | LC_ALL=C sort)
}

# installed BINDIR LV2DIR MANDIR: what is to be installed where, as files_below would say it.
installed() {
    {
        echo "$1/hooke"
        (cd "$HOOKE_BUNDLE" && find . -type f ! -name '*.dll.a' | sed "s|^\.|$2/hooke.lv2|")
        echo "$3/man1/hooke.1"
    } | LC_ALL=C sort
}
