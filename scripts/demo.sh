#!/usr/bin/env bash
# From nothing to an object seen from two places under four lights, written into out/demo/.
set -euo pipefail
cd "$(dirname "$0")/.."

out=out/demo
illum=build/release/tools/illum/illum

say() { printf '\n== %s\n' "$*"; }
run() { printf '$ %s\n' "${*/#$illum/illum}"; "$@"; }

say "Setting the machine up"
scripts/setup.sh build

say "Building the program"
cmake --preset release -DILLUM_TESTS=OFF >/dev/null
cmake --build --preset release --target illum

rm -rf "$out"
mkdir -p "$out"
say "Rendering a bust from nine places under 64 lights into one object (half a minute on two cores)"
run "$illum" build builtin:bust -o "$out/bust.illum" --uv 3x3
run "$illum" info "$out/bust.illum"
run "$illum" verify "$out/bust.illum"

say "Relighting: two lights from a new place"
run "$illum" relight "$out/bust.illum" --light -1,0.5,0.6,1.1,0.75,0.45 \
  --light 1,-0.2,0.5,0.15,0.35,0.8 --view 0.3,0.6 -o "$out/two_lights.png"

say "Two places, four lights"
run scripts/relit_sheet.sh "$out/bust.illum" "$out/sheet.png" 180 0,0.5 0.75,0.75

say "Written"
cat <<END
$out/bust.illum      the relightable object ($(stat -c %s "$out/bust.illum") bytes)
$out/two_lights.png  a warm light from the left, a cool one from the right, seen from between view points
$out/sheet.png       two view points below each other, four lights side by side
Other scenes: $illum build builtin:
END
