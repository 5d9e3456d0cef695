#!/usr/bin/env bash
# The check finds each kind of forbidden include, and lets the allowed ones pass.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

# expect WANTED FILE INCLUDE: WANTED is the message (a part of it) or "allowed".
expect() {
    local wanted=$1 file=$2 include=$3 found status=0
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/$(dirname "$file")"
    printf '#pragma once\n\n#include %s\n' "$include" >"$tree/$file"
    found=$("$here/check.sh" "$tree") || status=$?
    if [[ $wanted == allowed ]]; then
        ((status == 0)) && return
    else
        ((status != 0)) && [[ $found == *"$file:3: "*"$wanted"* ]] && return
    fi
    printf '%s: #include %s: wanted "%s", found (exit %d):\n%s\n' "$file" "$include" "$wanted" "$status" "$found"
    failures=$((failures + 1))
}

expect allowed morph/mesh/a.h '<vector>'
expect allowed morph/mesh/a.h '"morph/mesh/b.h"'
expect allowed morph/overlay/a.cpp '"morph/exact/predicates.h"  // reason'
expect allowed morph/morph.cpp '"morph/overlay/overlay.h"'
expect allowed morph/mesh/a.cpp '"mesh.h"'
expect allowed render/geometry/a.cpp '<embree4/rtcore.h>'
expect allowed render/image/a.cpp 'FT_FREETYPE_H'
expect allowed render/figure/a.cpp '"morph/morph.h"'
expect allowed render/figure/a.cpp '"morph/shapes/shapes.h"'
expect allowed tests/morph/overlay/a.cpp '"tests/catch.h"'
expect allowed tests/render/figure/a.cpp '"morph/morph.h"'
expect allowed tests/morph/overlay/a.cpp '<CGAL/Arrangement_2.h>'

expect 'morph/mesh may include only: itself' morph/mesh/a.h '"morph/overlay/overlay.h"'
expect 'morph/mesh may include only: itself' morph/mesh/a.h '<morph/overlay/overlay.h>'
expect 'morph/overlay may include only' morph/overlay/a.h '"render/film/film.h"'
expect 'morph/overlay may include only' morph/overlay/a.h '"morph/morph.h"'
expect 'may include only' morph/morph.cpp '  "render/figure/figure.h"'
expect 'may include only' render/integrator/a.cpp '"morph/morph.h"'
expect 'may include only' render/geometry/a.cpp '"render/figure/figure.h"'
expect 'may include only' tests/morph/a.cpp '"render/film/film.h"'
expect 'not in tests/includes/allowed.txt' morph/newcomer/a.cpp '"morph/mesh/mesh.h"'
expect 'CGAL/ may be included only in' morph/overlay/a.cpp '<CGAL/MP_Float.h>'
expect 'embree4/ may be included only in' render/integrator/a.cpp '<embree4/rtcore.h>'
expect 'FT_ may be included only in' render/film/a.cpp 'FT_FREETYPE_H'
expect 'a library that is not in' morph/mesh/a.cpp 'SOME_MACRO'
expect 'OpenImageIO/ may be included only in' render/film/a.cpp '"OpenImageIO/imageio.h"'
expect 'a library that is not in' morph/mesh/a.cpp '<boost/any.hpp>'
expect 'from the root' morph/mesh/a.cpp '"mesh/mesh.h"'
expect 'from the root' morph/mesh/a.cpp '"../mesh/mesh.h"'

rm -rf "${tree:?}"/*
if "$here/check.sh" "$tree" >/dev/null; then
    echo "an empty tree: wanted an error"
    failures=$((failures + 1))
fi
exit $((failures > 0))
