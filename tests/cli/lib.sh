# SPDX-License-Identifier: Apache-2.0
# Shared by the tests of the command line, which ctest runs as
#   SRP=path-of-srp ROOT=top-of-the-sources bash NAME.sh
# each in an empty directory of its own. A check that fails is reported, the test goes on.
# shellcheck shell=bash disable=SC2034
set -u

MODELS=$ROOT/models
SHARED=${SRP_SHARED_DATA_DIR:-$ROOT/../shared/data}
failures=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/srp-cli.XXXXXX") || exit 1
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
mkdir work log
cd work || exit 1

# fail TEXT: with the line of the test and what the last command said.
fail() {
    failures=$((failures + 1))
    echo "FAILED: ${0##*/}:${BASH_LINENO[${#BASH_LINENO[@]} - 2]}: $1"
    echo "  command: ${last-}"
    sed 's/^/  stdout: /' ../log/out 2> /dev/null | head -12
    sed 's/^/  stderr: /' ../log/err 2> /dev/null | head -12
}

# expect STATUS ARGUMENT...: srp with these arguments ends with this status. What it says is kept.
expect() {
    local want=$1 got
    shift
    last="srp $*"
    "$SRP" "$@" > ../log/out 2> ../log/err < /dev/null
    got=$?
    [ "$got" -eq "$want" ] || fail "exit status $got, expected $want"
    # Messages go to stderr: whoever fails prints no result.
    if [ "$want" -ne 0 ] && [ -s ../log/out ]; then
        fail "failed and printed a result"
    fi
    if [ "$want" -ne 0 ] && ! [ -s ../log/err ]; then
        fail "failed without a word"
    fi
}

# Of the last command: stdout or stderr contains this text, or it does not.
prints() { grep -qF -- "$1" ../log/out || fail "stdout lacks '$1'"; }
says() { grep -qF -- "$1" ../log/err || fail "stderr lacks '$1'"; }
prints_not() { ! grep -qF -- "$1" ../log/out || fail "stdout has '$1'"; }
says_not() { ! grep -qF -- "$1" ../log/err || fail "stderr has '$1'"; }
silent() { ! [ -s ../log/err ] || fail "stderr is not empty"; }

# check TEXT COMMAND...: the command succeeds.
check() {
    local text=$1
    shift
    "$@" || fail "$text"
}

# Names in the directory are exactly these: nothing is left behind.
holds() {
    local got want
    got=$(find . -mindepth 1 -printf '%P\n' | LC_ALL=C sort | tr '\n' ' ')
    want=$(printf '%s\n' "$@" | LC_ALL=C sort | tr '\n' ' ')
    [ $# -gt 0 ] || want=
    [ "$got" = "$want" ] || fail "directory has '$got', expected '$want'"
}

skip() { echo "skipped: $1"; }

finish() {
    if [ "$failures" -gt 0 ]; then
        echo "$failures checks failed"
        exit 1
    fi
    echo "passed"
    exit 0
}
