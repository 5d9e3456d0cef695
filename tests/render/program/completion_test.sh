#!/usr/bin/env bash
# The completions of bash and fish complete what a user types; that of zsh is read by zsh. Those of zsh and fish are
# tried where these shells are installed.
#   completion_test.sh AUTOMORPH
set -euo pipefail
automorph=$1
work=$(mktemp -d)
scripts=$(mktemp -d)
trap 'rm -rf "$work" "$scripts"' EXIT
cd "$work"
mkdir meshes
touch 'a face.ply' b.OBJ notes.txt fig.yaml meshes/c.stl
failures=0

# shellcheck disable=SC1090  # generated
source <("$automorph" completion bash)
[[ $(complete -p automorph) == 'complete -F _automorph automorph' ]]

expect() {  # expect "WORD WORD..." REPLY...: the last word is what is being typed; a | stands for a space in it
    local typed=$1 found wanted
    shift
    IFS=' ' read -ra COMP_WORDS <<<"automorph $typed"
    COMP_WORDS=("${COMP_WORDS[@]//|/ }")
    [[ $typed != *' ' && -n $typed ]] || COMP_WORDS+=('')
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    COMPREPLY=()
    _automorph 2>/dev/null || true
    found=$(printf '<%s>' "${COMPREPLY[@]}" | sed 's/></>\n</g' | sort)
    wanted=$(printf '<%s>' "$@" | sed 's/></>\n</g' | sort)
    [[ $found == "$wanted" ]] && return
    printf 'automorph %s: wanted %s, found %s\n' "$typed" "$wanted" "$found"
    failures=$((failures + 1))
}

expect mo morph
expect sh shape
expect 'shape ' ellipsoid star head
expect 'morph ' 'a face.ply' b.OBJ meshes
expect 'morph a' 'a face.ply'
expect 'morph a|face.ply meshes/' meshes/c.stl
expect 'morph b.OBJ b.OBJ --ali' --alignment
expect 'morph b.OBJ b.OBJ --alignment ' none registration features dense
expect 'morph b.OBJ b.OBJ --alignment = d' dense
expect 'morph b.OBJ b.OBJ --interpolation =' linear rigid-linear slerp
expect 'morph b.OBJ b.OBJ --qui' --quiet
expect 'morph --out n' notes.txt
expect 'morph --frames ' ''
expect 'figure ' fig.yaml meshes
expect 'figure --out ' meshes
expect 'info --j' --json
expect 'shape head h.ply --preset car' caricature
expect 'shape head h.ply --nose-w' --nose-width
expect 'help trou' troubleshooting
expect 'help mor' morph
expect 'completion ' bash fish zsh
expect '--log-level info mo' morph
expect '--log-level = info mo' morph
expect 'turntable a' 'a face.ply'
expect 'diff n' notes.txt
expect '--ver' --version
expect 'morph --ver' ''

if command -v zsh >/dev/null; then
    "$automorph" completion zsh >"$scripts/_automorph.zsh"
    found=$(ZDOTDIR=$scripts zsh -f -c 'source $ZDOTDIR/_automorph.zsh && print ${_comps[automorph]}
        COMP_WORDS=(automorph morph --alignment "") COMP_CWORD=3; setopt ksharrays shwordsplit
        compgen() { print -l "$2" }; _automorph; print $COMPREPLY[0]' 2>&1) || true
    [[ $found == *_automorph*none* ]] || { echo "zsh: $found"; failures=$((failures + 1)); }
fi

expect_fish() {  # expect_fish TYPED REPLY...: the replies without their descriptions
    local typed=$1 found wanted
    shift
    found=$(HOME=$scripts XDG_CONFIG_HOME=$scripts fish --no-config -c \
        'source $HOME/automorph.fish; complete -C $argv[1]' "automorph $typed" 2>&1 | cut -f 1 | sort)
    wanted=$(printf '%s\n' "$@" | sort)
    [[ $found == "$wanted" ]] && return
    printf 'fish: automorph %s: wanted %s, found %s\n' "$typed" "${wanted//$'\n'/ }" "${found//$'\n'/ }"
    failures=$((failures + 1))
}

if command -v fish >/dev/null; then
    "$automorph" completion fish >"$scripts/automorph.fish"
    expect_fish 'mor' morph
    expect_fish 'shape ' ellipsoid star head
    expect_fish 'morph ' 'a face.ply' b.OBJ meshes/
    expect_fish 'morph "a fa' 'a face.ply'
    expect_fish 'morph "a face.ply" meshes/' meshes/c.stl
    expect_fish 'morph b.OBJ b.OBJ --ali' --alignment
    expect_fish 'morph b.OBJ b.OBJ --alignment ' none registration features dense
    expect_fish 'morph b.OBJ b.OBJ --alignment=de' --alignment=dense
    expect_fish 'morph b.OBJ b.OBJ --qui' --quiet
    expect_fish 'morph --out n' notes.txt
    expect_fish 'morph --frames ' ''
    expect_fish 'figure ' fig.yaml meshes/
    expect_fish 'figure --out ' meshes/
    expect_fish 'info --j' --json
    expect_fish 'shape head h.ply --preset car' caricature
    expect_fish 'help trou' troubleshooting
    expect_fish 'completion ' bash fish zsh
    expect_fish '--ver' --version
    expect_fish 'morph --ver' ''
    expect_fish '--log-level info mor' morph
else
    echo "fish is not installed: its completion is not tried"
fi
exit $((failures > 0))
