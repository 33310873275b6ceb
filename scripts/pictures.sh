#!/bin/sh
# Draws the README's pictures from the built-in human: scripts/pictures.sh [VASA [FOLDER]]
# A row is drawn in several pictures, set side by side and reduced to 256 colours by ffmpeg. The app's windows are drawn on a
# display without a screen (xvfb-run); those of the row are the tests' session's.
set -eu
vasa=${1:-build/release/bin/vasa}
folder=${2:-docs/pictures}
parts=$(mktemp -d)
trap 'rm -rf "$parts"' EXIT

# draw NAME SIZE OPTIONS...: the first frame of a clip, closely cut
draw() {
  name=$1 size=$2
  shift 2
  "$vasa" --quiet render --frames 0 --no-avoid --quads 16x20 --supersample 2 --size "$size" "$@" -o "$parts/$name.png"
}

# still_of CLIP FRAME: the whole body, vessels moved apart
still_of() {
  "$vasa" --quiet render --clip "$1" --frames "$2" --supersample 2 --size 240x400 -o "$parts/$1.png"
}

# row NAME PARTS...
row() {
  name=$1 inputs='' count=0
  shift
  for part in "$@"; do
    inputs="$inputs -i $parts/$part.png"
    count=$((count + 1))
  done
  # shellcheck disable=SC2086
  ffmpeg -loglevel error -y $inputs -filter_complex \
    "hstack=$count,split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=dither=sierra2_4a" "$folder/$name.png"
}

# large NAME SIZE OPTIONS...
large() {
  name=$1 size=$2
  shift 2
  "$vasa" --quiet render --size "$size" --supersample 2 "$@" -o "$folder/$name.png"
}

vasa_path=$(realpath "$vasa")
# view SIZE SCRIPT: windows go to $parts
view() {
  (cd "$parts" && XDG_CONFIG_HOME=$parts xvfb-run -a -s '-screen 0 1280x1024x24' "$vasa_path" --quiet view --clip walk --size "$1" --script "$2")
}

large front 640x960 --frames 0
large walk 480x640 --clip walk --frames 9 --camera 1.8,1.1,2.8/0,0.87,0/33
large squat 480x640 --clip squat --frames 45 --camera 1.7,0.9,2.6/0,0.62,0.05/27
large fist 480x640 --clip fist --frames 30 --focus RightHand --distance 0.75

# page NAME PLATE OPTIONS...
page() {
  name=$1
  shift
  "$vasa" --quiet plate "$@" --dpi 90 -o "$parts/$name.png"
  ffmpeg -loglevel error -y -i "$parts/$name.png" -vf \
    "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=dither=sierra2_4a" "$folder/$name.png"
}
page plate thorax
page brain brain --hide veins --labels all-visible

# The walk once around, at every second frame.
"$vasa" --quiet render --clip walk --size 300x400 --supersample 2 --camera 1.8,1.1,2.8/0,0.87,0/33 -o "$parts/film.{frame:03}.png"
ffmpeg -loglevel error -y -framerate 30 -i "$parts/film.%03d.png" -vf \
  "select=not(mod(n\,2)),setpts=N/15/TB,split[a][b];[a]palettegen=max_colors=96:stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle" \
  -r 15 -loop 0 "$folder/walk.gif"

only='--clip stand --hide skin,bones,organs'
# shellcheck disable=SC2086
{
  for forks in off on; do
    close="--clip stand --forks $forks"
    draw "y_$forks" 240x240 $close --hide skin,bones,organs,veins --camera 0.003,1.085,0.25/0.003,1.066,0.004/8
    draw "t_$forks" 240x240 $close --hide skin,bones,organs,veins --camera 0.0,1.33,-0.25/0.013,1.306,-0.037/6
    draw "crossing_$forks" 240x240 $close --hide skin,bones,organs,arteries --camera -0.03,1.19,-0.25/-0.022,1.182,0.0/10
  done
  row forks y_off y_on t_off t_on crossing_off crossing_on

  for still in walk:16 run:8 squat:45 twist:40 elbow_flex:60; do
    still_of "${still%:*}" "${still#*:}"
  done
  row stills walk run squat twist elbow_flex

  draw without 240x480 $only --camera 0,0.88,3.9/0,0.88,0/27
  draw with 240x480 $only --camera 0,0.88,3.9/0,0.88,0/27 --capillaries 3
  row whole without with

  for level in 1 2 3; do
    draw "level$level" 320x320 $only --capillaries "$level" --camera 0.5,1.68,0.25/0,1.66,0/20
  done
  row levels level1 level2 level3

  draw brain 300x300 --clip stand --hide skin,bones,organs --capillaries 2 --camera 0.5,1.68,0.25/0,1.66,0/20
  draw face 300x300 --clip stand --hide skin,organs --capillaries 2 --camera 0.15,1.62,0.6/0,1.59,0.03/20
  draw hand 300x300 --clip stand --hide skin --capillaries 3 --camera 0.36,0.8,0.65/0.325,0.795,0.03/22
  draw foot 300x300 --clip stand --hide skin --capillaries 3 --camera 0.42,0.3,0.55/0.145,0.07,0.06/22
  row regions brain face hand foot
}

sed "s|OUT|$parts|" tests/view/session.txt > "$parts/session.txt"
view 960x640 session.txt
inputs=''
for window in posed picked measured searched cut slid; do inputs="$inputs -i $parts/$window.png"; done
# shellcheck disable=SC2086
ffmpeg -loglevel error -y $inputs -filter_complex \
  "xstack=inputs=6:layout=0_0|w0_0|w0+w1_0|0_h0|w0_h0|w0+w1_h0,scale=1440:-1:flags=area,split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=dither=sierra2_4a" \
  "$folder/session.png"

cat > "$parts/search.txt" <<END
settle
hold control
key f
let control
frames 2
type abdominal aorta
key enter
frames 2
key i
settle
window view.png
END
view 1280x800 search.txt
ffmpeg -loglevel error -y -i "$parts/view.png" -vf scale=800:-1:flags=area "$folder/view.png"
