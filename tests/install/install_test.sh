#!/usr/bin/env bash
# The program is installed with what tells of it; another project finds, links and runs the installed libraries, and
# sees nothing of this source tree.
#   install_test.sh BUILD CMAKE COMPILER
set -euo pipefail
build=$1 cmake=$2 compiler=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/program" --component program >"$work/log"
for file in bin/automorph share/man/man1/automorph.1.gz share/bash-completion/completions/automorph \
    share/fish/vendor_completions.d/automorph.fish lib/automorph/image_io.so; do
    [[ -s $work/program/$file ]] || { echo "not installed: $file"; exit 1; }
done
# Pictures are read and written by a module that is found from the program on, wherever that was moved; without it the
# error says what is missing.
mv "$work/program" "$work/moved"
ln -s moved/bin/automorph "$work/linked"
printf 'show: shape\nsource: {shape: ellipsoid, triangles: 200}\npicture: {width: 24, height: 24, spp: 1}\n' >"$work/tiny.yaml"
"$work/linked" figure "$work/tiny.yaml" --out "$work/tiny" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
rm "$work/moved/lib/automorph/image_io.so"
if "$work/linked" figure "$work/tiny.yaml" --out "$work/none" >"$work/log" 2>&1 ||
    ! grep -F "moved/lib/automorph/image_io.so: " "$work/log" >/dev/null; then
    echo "a missing module is not named:"
    cat "$work/log"
    exit 1
fi
"$cmake" --install "$build" --prefix "$work/prefix" --component development >"$work/log"
cp -r "$here" "$work/outside"
"$cmake" -G Ninja -S "$work/outside" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$cmake" --build "$work/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
source=$(cd "$here/../.." && pwd)
if grep -rF --include '*.json' --include '*.cmake' -- "$source" "$work/build/compile_commands.json" "$work/prefix"; then
    echo "the installed package names the source tree"
    exit 1
fi
cd "$work"
./build/outside
[[ $(head -c 4 m.glb) == glTF ]]
