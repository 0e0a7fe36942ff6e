#!/usr/bin/env bash
# Makes the pictures of docs/gallery: each built-in scene from two places, under four lights.
#
#   gallery.sh [SCENE…]      all of them, if none is named; near_light: two lights of the box
#
# Objects are kept in out/gallery/.
set -euo pipefail
cd "$(dirname "$0")/.."

illum=${ILLUM:-build/release/tools/illum/illum}
out=out/gallery
mkdir -p "$out" docs/gallery

scenes=("$@")
if [ ${#scenes[@]} -eq 0 ]; then
  mapfile -t scenes < <("$illum" build builtin: | sed 's/builtin:\([a-z]*\).*/\1/')
  scenes+=(near_light)
fi
# Figure 14 of the paper: the shadow of a distant light, and that of a lamp beside the box.
near_light() {
  local object=$out/near_light.illum
  [ -e "$object" ] || "$illum" build builtin:box -o "$object" --uv 1x1 --size 320 \
    --basis sh --coefficients 64
  "$illum" relight "$object" --light -0.7,0.9,0.7 -o "$out/distant.png"
  "$illum" relight "$object" --point -0.75,0.95,0.75,2,2,2 -o "$out/near.png"
  scripts/contact_sheet.py docs/gallery/near_light.jpg 2 320 "$out/distant.png" "$out/near.png"
}

for scene in "${scenes[@]}"; do
  if [ "$scene" = near_light ]; then
    near_light
    continue
  fi
  [ -e "$out/$scene.illum" ] || "$illum" build "builtin:$scene" -o "$out/$scene.illum"
  views=(0,0.5 0.75,0.75)
  [ "$scene" != coin ] || views=() # one photograph
  ILLUM=$illum scripts/relit_sheet.sh "$out/$scene.illum" "docs/gallery/$scene.jpg" 180 \
    "${views[@]}"
done
