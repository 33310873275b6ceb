#!/usr/bin/env bash
# From nothing to a film: installs what is missing, builds, and lets the built-in human walk, squat and make a fist.
# Leaves pictures and videos in out/demo.
set -euo pipefail
cd "$(dirname "$0")"
scripts/install-dependencies.sh
cmake --preset release -DVASA_BUILD_TESTS=OFF > /dev/null
cmake --build --preset release
vasa=build/release/bin/vasa
out=out/demo
mkdir -p "$out"

echo
"$vasa" info
echo
for clip in walk squat; do
  "$vasa" render --clip "$clip" --camera 2,1.1,2.4/0,0.85,0/36 --size 1280x720 -o "$out/$clip/{frame:04}.png" --video "$out/$clip.mp4"
done
"$vasa" render --clip fist --focus RightHand --camera front --distance 1.2 --size 1280x720 --video "$out/fist.mp4"
"$vasa" render --size 900x1400 -o "$out/front.png"
"$vasa" render --size 900x1400 --camera back -o "$out/back.png"
"$vasa" plate front -o "$out/plate.pdf"
echo
"$vasa" profile --clip walk --frames 10
echo
echo "pictures and videos:"
ls -1 "$out"/*.png "$out"/*.pdf "$out"/*.mp4
