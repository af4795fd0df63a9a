#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the examples of a document with the built srp on PATH:
#   SRP=path-of-srp ROOT=top-of-the-sources bash run_examples.sh DOCUMENT.md
#
# In the document,
#   ```sh        is a script: it must succeed;
#   ```console   is a session: commands after "$ " and, below each, all that it says on stdout and
#                stderr; a line "..." stands for any text;
#   ```sh needs-WORD, ```console needs-WORD are skipped when the variable LACKS has that word: what this
#                build is without (figures, pictures, fit);
#   ```sh no-run, ```console no-run and every other kind of block are only shown.
# The blocks of one document run in order in one scratch directory, where `models` is ours. Links to
# files of the repository must lead somewhere.
set -u

document=$1
scratch=$(mktemp -d "${TMPDIR:-/tmp}/srp-docs.XXXXXX") || exit 1
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/work" "$scratch/bin"
ln -s "$ROOT/models" "$scratch/work/models"
ln -s "$SRP" "$scratch/bin/srp"
PATH=$scratch/bin:$PATH
export PATH
# What is remembered is remembered here, and forgotten afterwards.
export XDG_CACHE_HOME=$scratch/cache
cd "$scratch/work" || exit 1

failures=0
examples=0

# fail LINE COMMAND GOT [EXPECTED]
fail() {
    failures=$((failures + 1))
    echo "FAILED: $document:$1: $2"
    sed 's/^/  got:      /' <<< "$3"
    if [ $# -gt 3 ]; then
        sed 's/^/  expected: /' <<< "$4"
    fi
}

# skip LINE WORD
skip() { echo "skipped: $document:$1: this build is without $2"; }

# run_script LINE TEXT
run_script() {
    local output
    examples=$((examples + 1))
    output=$(bash -euo pipefail -c "$2" 2>&1 < /dev/null) || fail "$1" "${2%%$'\n'*} ..." "$output"
}

# matches TEXT EXPECTED: equal, but "..." on a line of its own is any text.
matches() {
    local pattern='' line
    while IFS= read -r line; do
        if [ "$line" = ... ]; then
            pattern+='*'
        else
            line=${line//\\/\\\\}
            line=${line//\*/\\*}
            line=${line//\?/\\?}
            line=${line//\[/\\[}
            pattern+=$line$'\n'
        fi
    done <<< "$2"
    # shellcheck disable=SC2053
    [[ $1$'\n' == $pattern ]]
}

# run_command LINE COMMAND EXPECTED
run_command() {
    local output
    examples=$((examples + 1))
    output=$(bash -c "$2" 2>&1 < /dev/null)
    matches "$output" "$3" || fail "$1" "$2" "$output" "$3"
}

# run_session LINE TEXT: splits a session into commands and what they say.
run_session() {
    local number=$1 at=$1 command='' expected='' line
    while IFS= read -r line; do
        number=$((number + 1))
        if [ "${line:0:2}" = '$ ' ]; then
            [ -z "$command" ] || run_command "$at" "$command" "${expected%$'\n'}"
            command=${line:2}
            expected=
            at=$number
        elif [ -z "$expected" ] && [ "${line:0:2}" = '> ' ]; then
            command+=$'\n'${line:2}
        else
            expected+=$line$'\n'
        fi
    done <<< "$2"
    [ -z "$command" ] || run_command "$at" "$command" "${expected%$'\n'}"
}

# check_links LINE TEXT: of running text.
check_links() {
    local link
    while IFS= read -r link; do
        link=${link:2} link=${link%')'} link=${link%%#*}
        case $link in
        '' | *://*) ;;
        *) [ -e "${document%/*}/$link" ] || fail "$1" "a link to $link" 'no such file' ;;
        esac
    done < <(grep -oE '\]\([^)]*\)' <<< "$2")
}

number=0
kind=
text=
while IFS= read -r line; do
    number=$((number + 1))
    if [ -z "$kind" ] && [ "${line:0:3}" = '```' ]; then
        kind=${line:3}
        [ -n "$kind" ] || kind=text
        begin=$number
        text=
    elif [ "$line" = '```' ]; then
        need=${kind##* needs-}
        [[ " ${LACKS:-} " != *" $need "* ]] || { skip "$begin" "$need" && kind=text; }
        case $kind in
        sh | 'sh needs-'*) run_script "$begin" "$text" ;;
        console | 'console needs-'*) run_session "$begin" "${text%$'\n'}" ;;
        esac
        kind=
    elif [ -n "$kind" ]; then
        text+=$line$'\n'
    else
        check_links "$number" "$line"
    fi
done < "$document"

if [ -n "$kind" ]; then
    echo "FAILED: $document:$begin: the block has no end"
    failures=$((failures + 1))
fi
echo "$document: $examples examples, $failures failed"
[ "$failures" -eq 0 ]
