#!/usr/bin/env bash
# Makes the pictures of docs/gallery: each built-in scene from two places, under four lights.
#
#   gallery.sh [SCENE…]      all of them, if none is named
#
# Objects are kept in out/gallery/. They have 3 x 3 view points instead of the scenes' 5 x 5.
set -euo pipefail
cd "$(dirname "$0")/.."

illum=${ILLUM:-build/release/tools/illum/illum}
out=out/gallery
mkdir -p "$out" docs/gallery

scenes=("$@")
if [ ${#scenes[@]} -eq 0 ]; then
  mapfile -t scenes < <("$illum" build builtin: | sed 's/builtin:\([a-z]*\).*/\1/')
fi
for scene in "${scenes[@]}"; do
  [ -e "$out/$scene.illum" ] || "$illum" build "builtin:$scene" -o "$out/$scene.illum" --uv 3x3
  views=(0,0.5 0.75,0.75)
  [ "$scene" != coin ] || views=() # one photograph
  ILLUM=$illum scripts/relit_sheet.sh "$out/$scene.illum" "docs/gallery/$scene.jpg" 180 \
    "${views[@]}"
done
