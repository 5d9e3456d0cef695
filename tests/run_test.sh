#!/usr/bin/env bash
# The launcher, in a copy whose apt-get, cmake, ninja, ... are stand-ins that write down how they were called.
# shellcheck disable=SC2317  # the functions are called through check
set -euo pipefail
unset AUTOMORPH_PRESET  # of the run that calls this test
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

check() {  # check SENTENCE COMMAND...: the command must succeed
    local sentence=$1
    shift
    "$@" && return
    printf 'not so: %s\n--- output\n%s\n--- calls\n%s\n' "$sentence" "$output" "$(cat "$work/calls")"
    failures=$((failures + 1))
}
has() { [[ $output == *"$1"* ]]; }
called() { grep -q -- "^$1" "$work/calls"; }
never() { ! "$@"; }

stand_in() {  # stand_in NAME: the script on stdin becomes the command NAME
    { echo '#!/bin/bash'; echo "work=$work; echo \"\${0##*/} \$*\" >>\$work/calls"; cat; } >"$work/bin/$1"
    chmod +x "$work/bin/$1"
}

new_machine() {  # everything installed, nothing built, root unless $user says otherwise
    rm -rf "${work:?}"/*
    mkdir -p "$work/bin" "$work/project/tests" "$work/elsewhere"
    local tool
    for tool in bash sh env cat dirname readlink mkdir mktemp rm mv grep sed awk nproc tar gzip touch; do
        ln -s "$(command -v "$tool")" "$work/bin/$tool"
    done
    # The example meshes, should this machine have them, are out of the way.
    sed "s|archive=/\$meshes_archive|archive=$work/\$meshes_archive|" "$project/run" >"$work/project/run"
    grep -q "archive=$work" "$work/project/run"
    cp "$project/CMakePresets.json" "$work/project"
    touch "$work/network" "$work/missing" "$work/calls"

    stand_in dpkg-query <<'END'
for package in "${@:4}"; do grep -qx -- "$package" $work/missing || printf 'installed:%s ' "$package"; done
END
    stand_in apt-get <<'END'
[[ $* == *update* ]] && exit
[[ -e $work/network ]] || { echo "E: no network"; exit 100; }
if [[ $* == *download* ]]; then touch libcgal-demo_1_all.deb; else : >$work/missing; fi
END
    stand_in apt-cache </dev/null
    stand_in dpkg-deb <<'END'
mkdir -p data/meshes usr/share/doc/libcgal-dev && echo OFF >data/meshes/lion-head.off
tar -czf usr/share/doc/libcgal-dev/data.tar.gz data && rm -r data
END
    stand_in cmake <<'END'
mkdir -p $work/project/build/release/render && touch $work/project/build/release/build.ninja
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$work/project" >$work/project/build/release/CMakeCache.txt
END
    stand_in ninja <<'END'
[[ " $* " == *" -n "* ]] && exit
[[ -e $work/compiler_error ]] && { echo "error: expected ';'"; exit 1; }
cp_program=$work/project/build/release/render/automorph
printf '#!/bin/bash\nprintf "<%%s>" "$@"\n' >$cp_program && PATH=/usr/bin:/bin chmod +x $cp_program
END
    stand_in ctest </dev/null
    chmod -R a+rwX "$work"
}

user=()  # what to put before a command to run it as somebody else
call() {  # call ARGUMENTS...: runs the launcher from another folder; sets output and status
    status=0
    output=$(cd "$work/elsewhere" && PATH=$work/bin "${user[@]}" "$work/bin/bash" "$work/project/run" "$@" 2>&1) || status=$?
}

new_machine
call morph 'a b.obj' --frames 5
check "arguments reach the program as they are" has '<morph><a b.obj><--frames><5>'
check "the call succeeds" test "$status" = 0
check "nothing is installed where nothing is missing" never called apt-get
check "only the program is built" called 'ninja.* automorph$'
call morph
check "the second call does not configure again" test "$(grep -c ^cmake "$work/calls")" = 1
touch -d '+1 minute' "$work/project/CMakePresets.json"
call morph
check "changed presets do" test "$(grep -c ^cmake "$work/calls")" = 2

sed -i "s|$work/project|/the/old/place|" "$work/project/build/release/CMakeCache.txt"
touch "$work/project/build/release/old_object"
call morph
check "a build folder that was moved is made anew" test ! -e "$work/project/build/release/old_object"

call help figures
check "help on a topic is the program's" has '<help><figures>'
call help
check "help alone is the launcher's" has 'figure CONFIG'

new_machine
printf 'libfmt-dev\ncatch2\n' >"$work/missing"
chmod a+w "$work/missing"
if ((EUID == 0)); then
    call test -R overlay
    check "it says what it installs" has 'not installed: libfmt-dev catch2'
    check "just what is missing is installed" called 'apt-get.* install --no-install-recommends libfmt-dev catch2$'
    check "then the tests run" called 'ctest .*-R overlay$'
    check "the tests have their meshes" test -e "$work/project/build/meshes/lion-head.off"

    new_machine
    echo libfmt-dev >"$work/missing"
    rm "$work/network"
    call test
    check "without a network it stops" test "$status" = 1
    check "and says what to do" has 'apt-get install --no-install-recommends libfmt-dev'
    check "and does not build" never called ninja
    user=(/usr/bin/setpriv --reuid=65534 --regid=65534 --clear-groups)
fi

new_machine
echo libfmt-dev >"$work/missing"
call test
check "without root and sudo it stops" test "$status" = 1
check "without root and sudo it says what to do" has 'as root, run: apt-get install --no-install-recommends libfmt-dev'
check "without root and sudo it installs nothing" never called apt-get
user=()

new_machine
touch "$work/compiler_error"
call morph
check "a failed build is a failed call" test "$status" = 1
check "a failed build shows what the compiler says" has "error: expected ';'"

new_machine
printf 'source: ../mine.off  # not build/meshes/lion-head.off\n' >"$work/elsewhere/own.yaml"
printf 'source: ../build/meshes/lion-head.off\n' >"$work/elsewhere/heads.yaml"
call figure own.yaml
check "own meshes fetch nothing" test ! -e "$work/project/build/meshes"
rm "$work/network"
call figure heads.yaml
check "meshes that cannot be fetched stop the call" test "$status" = 1
check "it says which package has them" has 'apt-get install libcgal-demo'
check "nothing is left behind" test -z "$(cd "$work/project/build" && compgen -G 'meshes*')"
touch "$work/network"
call figure heads.yaml
check "a config that names example meshes gets them" test -e "$work/project/build/meshes/lion-head.off"
check "no part is left" test -z "$(compgen -G "$work/project/build/meshes.part*")"
call figure heads.yaml
check "they are fetched once" test "$(grep -c 'apt-get.*download' "$work/calls")" = 2
rm -r "$work/project/build/meshes"
printf 'extends: "../elsewhere/heads.yaml"  # and more\n' >"$work/elsewhere/more.yaml"
call figure more.yaml
check "so does a config that extends it" test -e "$work/project/build/meshes/lion-head.off"

new_machine
echo ffmpeg >"$work/missing"
chmod a+w "$work/missing"
if ((EUID == 0)); then
    call figure own.yaml
    check "figures get the program that makes videos" called 'apt-get.* install --no-install-recommends ffmpeg$'
    echo ffmpeg >"$work/missing"
    rm "$work/network"
    call figure own.yaml
    check "without it the figure is made all the same" has '<figure><own.yaml>'
    check "and it is said" has 'going on without videos'
    check "the call succeeds without videos" test "$status" = 0
    : >"$work/calls"
    call morph
    call turntable a.obj --out a_.png
    check "nothing else needs it" never called apt-get
    echo ffmpeg >"$work/missing"
    touch "$work/network"
    call turntable a.obj --out a.mp4
    check "but a turntable as a video does" called 'apt-get.* install --no-install-recommends ffmpeg$'
fi

new_machine
stand_in cpack </dev/null
DEBFULLNAME=Jo DEBEMAIL=jo@example.org call package
check "a package names its builder" called 'cmake -DAUTOMORPH_MAINTAINER=Jo <jo@example.org> '
check "and is packed" called cpack
: >"$work/calls"
call package
check "an earlier builder is not named again" called 'cmake -UAUTOMORPH_MAINTAINER '

exit $((failures > 0))
