#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The installed program finds its library, wherever the tree is moved; man page and completion are
# where their readers look.
. "$(dirname "$0")/lib.sh"

last="cmake --install $BUILD"
cmake --install "$BUILD" --prefix "$PWD/first" > ../log/out 2> ../log/err || fail 'cannot install'
mv first moved
check 'no man page' test -s moved/share/man/man1/srp.1
check 'no completion' test -s moved/share/bash-completion/completions/srp
SRP=$PWD/moved/bin/srp
expect 0 --version
expect 0 force "$MODELS/cube.obj" --az 0 --el 0
last='ldd moved/bin/srp'
if command -v ldd > /dev/null; then
    ldd moved/bin/srp > ../log/out
    # Linked to our library, or (with OpenGL) holding it.
    if grep -q 'libsrpcore' ../log/out; then
        prints "$PWD/moved/"
    fi
    prints_not 'libGL' # OpenGL is opened when it is asked for
    prints_not 'libEGL'
    prints_not 'libOSMesa'
    # The licence that --version states is that of what is linked.
    if grep -qF libgsl ../log/out; then
        expect 0 --version
        prints 'GPL-3'
    else
        expect 0 --version
        prints_not 'GPL-3'
    fi
    last='ldd moved/lib/libsrpcore.so'
    ldd "$(find moved -name 'libsrpcore.so' | head -1)" > ../log/out
    prints 'libc.so'
    prints_not 'libgsl' # the library is Apache-2.0
    prints_not 'libplplot'
fi

# Staged for a package: below DESTDIR, as if it were /usr.
last="DESTDIR=stage cmake --install $BUILD --prefix /usr"
DESTDIR=$PWD/stage cmake --install "$BUILD" --prefix /usr > ../log/out 2> ../log/err || fail 'cannot stage'
SRP=$PWD/stage/usr/bin/srp
expect 0 force "$MODELS/cube.obj" --az 0 --el 0
check 'no man page' test -s stage/usr/share/man/man1/srp.1

# The demo builds all that it would install.
! grep -q -- '--target' "$ROOT/scripts/demo.sh" || fail 'the demo builds less than it can install'
finish
