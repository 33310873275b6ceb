#!/usr/bin/env bash
# The same bytes whatever made them: motion solved (.vtp at every knot, exact), pictures and a converted network by each of the
# given builds of the program with several numbers of threads, beside the first one's with one thread.
#   tests/soak/same.sh BODY.glb NETWORK.vasa PROGRAM...
set -euo pipefail
body=$(realpath "$1")
network=$(realpath "$2")
shift 2
programs=()
for program in "$@"; do programs+=("$(realpath "$program")"); done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_CACHE_HOME=$scratch/cache

make() {  # program, threads, folder
  local run=("$1" --quiet --no-cache --threads "$2")
  mkdir -p "$3"
  for clip in walk elbow_flex; do
    "${run[@]}" export --body "$body" --network "$network" --clip $clip --frames 0:15 --track "$3/$clip.track" -o "$3/$clip-{frame}.vtp" > /dev/null
    rm "$3/$clip.track"  # carries the program's version
  done
  "${run[@]}" render --body "$body" --network "$network" --clip walk --frames 0:2 --size 240x320 -o "$3/walk-{frame}.png" > /dev/null
  "${run[@]}" convert "$3/walk-0.vtp" --exact -o "$3/walk-0.vasa" > /dev/null
}

different=0
for program in "${programs[@]}"; do
  for threads in 1 2 3 8 16; do
    if [ ! -e "$scratch/first" ]; then
      make "$program" $threads "$scratch/first"
      continue
    fi
    rm -rf "$scratch/other"
    make "$program" $threads "$scratch/other"
    if diff -rq "$scratch/first" "$scratch/other" > "$scratch/differences"; then
      echo "same: $program, $threads threads: $(find "$scratch/other" -type f | wc -l) files"
    else
      echo "same: $program, $threads threads: $(wc -l < "$scratch/differences") files DIFFER"
      sed 's/^/  /' "$scratch/differences"
      different=1
    fi
  done
done
exit $different
