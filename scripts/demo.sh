#!/usr/bin/env bash
# The whole way on photographs that the project makes itself, written into out/demo/.
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
say "Photographing a medal under 60 lights"
scripts/demo_stack.py "$out/photographs"

say "Building the object, every fifth light left out for judging"
run "$illum" build "$out/photographs" -o "$out/medal.illum" --holdout 5
run "$illum" info "$out/medal.illum"
run "$illum" verify "$out/medal.illum"

say "Relighting: one raking light, then a warm and a cool one together"
run "$illum" relight "$out/medal.illum" --light -0.9,0.3,0.35 -o "$out/raking.png"
run "$illum" relight "$out/medal.illum" --light -1,0.5,0.6,1.1,0.75,0.45 \
  --light 1,-0.2,0.5,0.15,0.35,0.8 -o "$out/two_lights.png"

say "A light that goes round"
/usr/bin/python3 - >"$out/round.lp" <<'PYTHON'
import math
print(12)
for k in range(12):
    a = math.radians(90 - 30 * k)
    print(f"round_{k:02d}.png {0.8 * math.cos(a):.6f} {0.8 * math.sin(a):.6f} 0.6")
PYTHON
run "$illum" relight "$out/medal.illum" --lights "$out/round.lp" -o "$out/round"
scripts/contact_sheet.py "$out/round.png" 6 256 "$out"/round/*.png
scripts/contact_sheet.py "$out/medal.jpg" 3 300 \
  "$out/photographs/photo_05.jpg" "$out/raking.png" "$out/two_lights.png"

say "Judging it against the photographs"
run "$illum" evaluate "$out/medal.illum" --against "$out/photographs" --html "$out/report.html"

say "Written"
cat <<EOF
$out/photographs/    the photographs and lights.lp
$out/medal.illum     the relightable object ($(stat -c %s "$out/medal.illum") bytes)
$out/raking.png      one light, low from the left
$out/two_lights.png  a warm light from the left, a cool one from the right
$out/round.png       a light that starts at the top and goes round clockwise
$out/medal.jpg       a photograph, the raking light and the two lights, side by side
$out/report.html     how close it comes, light by light
EOF
