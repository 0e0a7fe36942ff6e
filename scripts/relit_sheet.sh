#!/usr/bin/env bash
# An object seen from several places under several lights, as one picture: a row for each view, a
# column for each light.
#
#   relit_sheet.sh OBJECT.illum OUT.png|.jpg WIDTH [VIEW…]
#
# WIDTH is of one picture. VIEW as in `illum relight --view`; an object of one photograph has none.
# ILLUM names the program.
set -euo pipefail

illum=${ILLUM:-$(dirname "$0")/../build/release/tools/illum/illum}
object=$1 out=$2 width=$3
shift 3
views=("${@:-}")

# From the left; low from the right; from above; a warm and a cool one at once.
lights=(
  "--light -0.7,0.5,0.7"
  "--light 0.9,0.2,0.5"
  "--light 0.1,0.9,0.4"
  "--light -1,0.3,0.5,1.3,0.75,0.35 --light 0.9,0.5,0.4,0.2,0.45,1.1"
)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
pictures=()
for view in "${views[@]}"; do
  for light in "${lights[@]}"; do
    picture=$folder/${#pictures[@]}.png
    # Words of a light are options of their own.
    # shellcheck disable=SC2086
    "$illum" relight "$object" $light ${view:+--view "$view"} -o "$picture"
    pictures+=("$picture")
  done
done
"$(dirname "$0")/contact_sheet.py" "$out" "${#lights[@]}" "$width" "${pictures[@]}"
