#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/install-deps.sh, with the tools of Debian replaced by ones that only take notes: what it asks
# for, and when it asks for nothing.
#   ROOT=top-of-the-sources bash install_deps.sh
set -u
scratch=$(mktemp -d "${TMPDIR:-/tmp}/srp-deps.XXXXXX") || exit 1
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin"
cat > "$scratch/bin/dpkg-query" << 'END'
#!/bin/sh
for package; do :; done
grep -qx "$package" "$STATE/installed" && echo installed
END
cat > "$scratch/bin/apt-cache" << 'END'
#!/bin/sh
grep -qx "$2" "$STATE/unknown" || printf '%s:\n  Candidate: 1.0\n' "$2"
END
cat > "$scratch/bin/apt-get" << 'END'
#!/bin/sh
echo "$*" >> "$STATE/calls"
[ ! -e "$STATE/offline" ] || exit 100
for package; do
    case $package in -* | install | update) ;; *) echo "$package" >> "$STATE/installed" ;; esac
done
END
cat > "$scratch/bin/id" << 'END'
#!/bin/sh
echo 0
END
chmod +x "$scratch"/bin/*
export PATH=$scratch/bin:$PATH STATE=$scratch
failures=0

# run STATUS TEXT: the script ends so, having said TEXT (nothing at all if empty).
run() {
    : > "$scratch/calls"
    bash "$ROOT/scripts/install-deps.sh" build > "$scratch/said" 2>&1
    local got=$?
    [ "$got" -eq "$1" ] || wrong "status $got, expected $1"
    if [ -n "$2" ]; then
        grep -q "$2" "$scratch/said" || wrong "does not say '$2'"
    elif [ -s "$scratch/said" ]; then
        wrong 'says something'
    fi
}
calls() { [ "$(wc -l < "$scratch/calls")" -eq "$1" ] || wrong "expected $1 calls of apt-get"; }
wrong() {
    failures=$((failures + 1))
    echo "FAILED: line ${BASH_LINENO[1]}: $1"
    sed 's/^/  said: /' "$scratch/said"
    sed 's/^/  apt-get /' "$scratch/calls"
}

# A bare machine: lists, what is needed, what is nice to have.
: > "$scratch/installed"
: > "$scratch/unknown"
run 0 'installing .*cmake'
calls 3
grep -qx libembree-dev "$scratch/installed" || wrong 'the optional packages are not installed'
# All is there: not a word, and no network.
run 0 ''
calls 0
# An optional package alone is missing: it is tried, once.
sed -i '/^mandoc$/d' "$scratch/installed"
run 0 ''
calls 1
# ... and done without where that fails, or where there is none.
sed -i '/^mandoc$/d' "$scratch/installed"
touch "$scratch/offline"
run 0 'going on without mandoc (optional)'
calls 1
echo mandoc > "$scratch/unknown"
run 0 'going on without mandoc (optional)'
calls 0
# What is needed must be there.
sed -i '/^cmake$/d' "$scratch/installed"
run 100 'installing cmake'

[ "$failures" -eq 0 ] && echo passed
exit "$((failures > 0))"
