#!/usr/bin/env bash
# Compares the #include lines of the project with allowed.txt; says which lines break it and exits 1 if any does.
#   tests/includes/check.sh [ROOT]    ROOT: the folder that holds morph/, render/, tests/ (default: this project)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "${1:-$here/../..}"

shopt -s globstar nullglob
sources=({morph,render,tests,bench}/**/*.{h,cpp})
((${#sources[@]})) || { echo "no sources found in $PWD"; exit 1; }

awk -v table="$here/allowed.txt" '
function folder_of(file) { return match(file, /\/[^\/]*$/) ? substr(file, 1, RSTART - 1) : "." }

# Does a pattern of the table (folder, folder/** or file) cover this file?
function covers(pattern, file) {
    if (pattern == file || pattern == folder_of(file)) return 1
    return sub(/\/\*\*$/, "/", pattern) && index(file, pattern) == 1
}
function covered(list, file,    i, n, patterns) {
    n = split(list, patterns)
    for (i = 1; i <= n; i++) if (covers(patterns[i], file)) return 1
    return 0
}

# The entry of [folders] that a file falls under: the longest one that covers it.
function entry_of(file,    pattern, best) {
    for (pattern in may) if (covers(pattern, file) && length(pattern) > length(best)) best = pattern
    return best
}
function wrong(why) { printf "%s:%d: %s\n    %s\n", FILENAME, FNR, why, $0; bad++ }

BEGIN {
    while ((getline line < table) > 0) {
        if (line ~ /^#/ || line ~ /^ *$/) continue
        if (line ~ /^\[/) { section = line; continue }
        name = line; sub(/[: ].*/, "", name); rest = line; sub(/^[^: ]*:? */, "", rest)
        if (section == "[folders]") may[name] = rest
        else door[name] = rest
    }
}

FNR == 1 { files++ }
/^[ \t]*#[ \t]*include/ {
    includes++
    header = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", header)
    quoted = header ~ /^"/
    if (match(header, /^[<"][^">]+[">]/)) header = substr(header, 2, RLENGTH - 2)
    else sub(/[^A-Za-z0-9_].*/, "", header)  # a macro, as FreeType has them
    if (header ~ /(^|\/)\.\.?\//) { wrong("write the path from the root of the project"); next }

    if (header ~ /^(morph|render|tests|bench)\//) {
        entry = entry_of(FILENAME)
        if (entry == "") wrong(folder_of(FILENAME) " is not in tests/includes/allowed.txt; enter what it may include")
        else if (folder_of(header) != folder_of(FILENAME) && !covered(may[entry], header))
            wrong(entry " may include only: " (may[entry] == "" ? "itself" : may[entry]))
        next
    }
    for (name in door) if (index(header, name) == 1) {
        if (!covered(door[name], FILENAME)) wrong(name " may be included only in: " door[name])
        next
    }
    if (quoted && header !~ /\//) next  # beside the including file
    if (quoted) wrong("write the path from the root of the project")
    else if (header !~ /^[a-z0-9_]+$/) wrong("a library that is not in tests/includes/allowed.txt; enter who may include it")
}

END {
    printf "%d includes in %d files: %d not allowed\n", includes, files, bad
    exit bad > 0
}' "${sources[@]}"
