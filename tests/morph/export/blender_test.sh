#!/usr/bin/env bash
# Blender loads a .glb and shows the library's frames. Skipped (status 77) where Blender is not installed, or not
# the numpy without which it loads no glTF.
#   blender_test.sh AUTOMORPH
set -euo pipefail
automorph=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if ! command -v blender >/dev/null; then
    echo "skipped: Blender is not installed (Debian package blender)"
    exit 77
fi
if ! blender -b --factory-startup --python-exit-code 1 --python-expr "import numpy" >/dev/null 2>&1; then
    echo "skipped: Blender has no numpy, so it loads no glTF (Debian package python3-numpy)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

"$automorph" -q shape ellipsoid a.off --semi-axes 1 0.8 0.5 --triangles 1000
"$automorph" -q shape star star.off --triangles 1500
# x, y, z -> y, z, x is a turn by 120 degrees; away from the origin, and larger.
awk 'NR == 2 { vertices = $1 }
     NR > 2 && NR <= 2 + vertices { print 2 * $2 + 5, 2 * $3 - 3, 2 * $1 + 1; next }
     { print }' star.off >b.off
"$automorph" -q morph a.off b.off --up z --out m.glb
"$automorph" -q morph a.off b.off --frames 3 --out m_.ply
HOME=$work blender -b --factory-startup --python-exit-code 1 --python "$here/blender_check.py" -- \
    m.glb m_000.ply m_001.ply m_002.ply
