#!/usr/bin/env bash
# Kills vasa N times (200) at random moments of writing pictures, a film, a GLB, VTP files and a network; after each kill
# the folder must hold finished files alone, and the same command (with --resume for pictures) must end with the bytes of
# an undisturbed run.
#   tests/soak/kills.sh PROGRAM [N]
set -euo pipefail
program=$(realpath "$1")
kills=${2:-200}
RANDOM=1  # the same moments each time, as far as a machine allows
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

human=$(dirname "$(dirname "$program")")/share/vasa  # installed
[ -d "$human" ] || human=$(dirname "$(dirname "$program")")/data        # in the build folder
"$program" --quiet export --body "$human/human.glb" --network "$human/human.vasa" -o vessels.vtp > /dev/null
names=(pictures film glb lines network)
run() {  # what, folder, more arguments
  local what=$1 folder=$2
  shift 2
  exec > /dev/null
  case $what in
    pictures) "$program" --quiet render --clip walk --frames 0:7 --size 96x160 --quads 4x2 -o "$folder/{frame}.png" "$@" ;;
    film) "$program" --quiet render --clip walk --frames 0:7 --size 96x160 --quads 4x2 --video "$folder/film.mp4" ;;
    glb) "$program" --quiet export --clip fist --frames 0:5 --quads 4x2 --tolerance 5 -o "$folder/fist.glb" ;;
    lines) "$program" --quiet export --clip walk --frames 0:7 -o "$folder/{frame}.vtp" ;;
    network) "$program" --quiet convert vessels.vtp --scale 0.001 --kind artery -o "$folder/network.vasa" ;;
  esac
}

declare -A length
for what in "${names[@]}"; do
  mkdir -p "whole/$what"
  start=$(date +%s%N)
  (run "$what" "whole/$what")
  length[$what]=$((($(date +%s%N) - start) / 1000000))
done

interrupted=0
for ((kill = 0; kill < kills; kill++)); do
  what=${names[kill % ${#names[@]}]}
  rm -rf torn && mkdir torn
  run "$what" torn 2> /dev/null &
  child=$!
  sleep "$(awk -v ms="${length[$what]}" -v share="$RANDOM" 'BEGIN { printf "%.3f", ms * share / 32768000 }')"
  # The program is this shell's child, or the shell itself became it.
  pkill -KILL -P "$child" 2> /dev/null || kill -KILL "$child" 2> /dev/null || true
  if ! wait "$child" 2> /dev/null; then interrupted=$((interrupted + 1)); fi
  for file in torn/* torn/.[!.]*; do
    [ -e "$file" ] || continue
    cmp -s "$file" "whole/$what/$(basename "$file")" || { echo "kill $kill ($what): $file is left, and is not as it should be"; exit 1; }
  done
  more=()
  [ "$what" = pictures ] && more=(--resume)
  (run "$what" torn "${more[@]}")
  diff -r torn "whole/$what" > /dev/null || { echo "kill $kill ($what): another result than undisturbed"; diff -rq torn "whole/$what"; exit 1; }
done
echo "kills: $kills of which $interrupted before the end, nothing left behind, all results as undisturbed"
