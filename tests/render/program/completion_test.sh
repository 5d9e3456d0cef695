#!/usr/bin/env bash
# The completion of bash completes what a user types; that of zsh is read by zsh, where it is installed.
#   completion_test.sh AUTOMORPH
set -euo pipefail
automorph=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
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
expect 'completion ' bash zsh
expect '--ver' --version
expect 'morph --ver' ''

if command -v zsh >/dev/null; then
    "$automorph" completion zsh >_automorph.zsh
    found=$(ZDOTDIR=$work zsh -f -c 'source ./_automorph.zsh && print ${_comps[automorph]}
        COMP_WORDS=(automorph morph --alignment "") COMP_CWORD=3; setopt ksharrays shwordsplit
        compgen() { print -l "$2" }; _automorph; print $COMPREPLY[0]' 2>&1) || true
    [[ $found == *_automorph*none* ]] || { echo "zsh: $found"; failures=$((failures + 1)); }
fi
exit $((failures > 0))
