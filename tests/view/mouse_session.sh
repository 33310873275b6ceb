#!/bin/sh
# A person's session with a real mouse and keyboard, on a display without a screen: tests/view/mouse_session.sh VASA DATA
# Poses, finds, hides, names, colours, keeps, exports, edits, undoes and redoes, saves and opens as hands do it: each part tells what it
# does. Whatever was saved has to be the same to the byte once it has been opened and saved again. What the app has understood is read from
# its window's title, which begins with a star while something is unsaved, and from the scene.
set -eu
command -v xdotool >/dev/null && command -v ffmpeg >/dev/null || exit 77
if [ -z "${MOUSE_SESSION_INSIDE:-}" ]; then
  export MOUSE_SESSION_INSIDE=1
  exec xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' "$0" "$@"
fi
vasa=$1 data=$2
folder=$(mktemp -d)
app=
trap 'if [ -n "$app" ]; then kill "$app" 2>/dev/null || true; fi; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/config"

cat >"$folder/scene.json" <<END
{ "body": "$data/human.glb", "networks": ["$data/human.vasa"], "camera": { "view": "front" } }
END

fail() {
  echo "mouse_session: $1" >&2
  cat "$folder/log" >&2
  exit 1
}

# wait_for WHAT COMMAND...: until it succeeds, a minute at most
wait_for() {
  what=$1 latest=$(($(date +%s) + 60))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$(date +%s)" -lt "$latest" ] || fail "$what did not happen"
    sleep 0.1
  done
}

titled() { [ "$(xdotool getwindowname "$window")" = "$1" ]; }
saved='human.vasa - vasa'
unsaved="* $saved"

# start [SCENE]; without any the built-in human
start() {
  "$vasa" view "$@" --size 960x640 --out "$folder" >"$folder/log" 2>&1 &
  app=$!
  wait_for 'the opening of the window' xdotool search --name '^human.vasa - vasa$'
  window=$(xdotool search --name '^human.vasa - vasa$' | head -1)
  sleep 2 # its first picture
}

end() {
  xdotool key ctrl+q
  wait "$app" || fail 'the app ended with an error'
  app=
}

point() {
  xdotool mousemove --window "$window" "$1" "$2"
  sleep 0.1
}

# drag X Y X Y: in steps, as hands do
drag() {
  point "$1" "$2"
  xdotool mousedown 1
  for step in 1 2 3 4 5 6; do
    point $(($1 + ($3 - $1) * step / 6)) $(($2 + ($4 - $2) * step / 6))
  done
  xdotool mouseup 1
  sleep 0.3
}

# The wrist is dragged, that is undone and redone, a vessel is chosen in the list.
start "$folder/scene.json"
point 480 600
xdotool key p
sleep 0.3
drag 403 316 443 210
wait_for 'a pose by the dragged wrist' titled "$unsaved"
xdotool key ctrl+z
wait_for 'undoing it' titled "$saved"
xdotool key ctrl+y
wait_for 'redoing it' titled "$unsaved"
xdotool key p
xdotool key o
sleep 1
point 100 50
xdotool click 1
sleep 0.3
xdotool type --delay 60 'femrl art'
sleep 0.5
point 100 106 # the first answer
xdotool click 1
sleep 0.3
xdotool key ctrl+s
wait_for 'saving' titled "$saved"
end
cp "$folder/scene.json" "$folder/first.json"
grep -q '"LeftArm"' "$folder/scene.json" || fail 'no arm is posed in the saved scene'
grep -q '"chosen": ".* femoral artery"' "$folder/scene.json" || fail 'no femoral artery is chosen in the saved scene'

start "$folder/scene.json"
xdotool key ctrl+s
sleep 1
end
cmp "$folder/first.json" "$folder/scene.json" || fail 'opened and saved again, the scene is another'

# type_file PATH: into a dialog of files that has just been asked for
type_file() {
  sleep 0.7
  xdotool type --delay 30 "$1"
  sleep 0.3
}

# A vessel is hidden, colours are changed by a menu, a view is kept, all is saved under another name and exported.
start "$folder/scene.json"
point 480 600
xdotool key h
wait_for 'hiding the chosen vessel' titled "$unsaved"
point 110 15 # the menu View
xdotool click 1
sleep 0.5
point 140 408 # its entry Next colouring
xdotool click 1
sleep 0.5
xdotool key ctrl+shift+1
sleep 0.3
xdotool key ctrl+shift+s
type_file "$folder/second.json"
xdotool key Return
wait_for 'saving under another name' titled "$saved"
xdotool key ctrl+e
type_file "$folder/vessels.glb"
point 313 499 # not the whole clip
xdotool click 1
sleep 0.3
xdotool key Return
wait_for 'the export' test -s "$folder/vessels.glb"
end
[ "$(head -c 4 "$folder/vessels.glb")" = glTF ] || fail 'what was exported is no GLB'
for key in '"hidden"' '"colour": "blood"' '"views"' '"LeftArm"'; do
  grep -q "$key" "$folder/second.json" || fail "there is no $key in the scene that was saved under another name"
done
cmp "$folder/first.json" "$folder/scene.json" || fail 'saving under another name changed the first scene'
cp "$folder/second.json" "$folder/kept.json"

# What is damaged is told, and another scene opened by the dialog.
# no_message: nothing is written below the scene's name and numbers
no_message() {
  ffmpeg -v error -f x11grab -video_size 250x16 -i "$DISPLAY+10,82" -frames:v 1 -pix_fmt gray -f rawvideo - |
    od -An -v -tu1 -w1 | sort -u >"$folder/greys"
  [ "$(wc -l <"$folder/greys")" -eq 1 ]
}
echo '{ "body": 3 }' >"$folder/bad.json"
start "$folder/scene.json"
xdotool key F12
message() { ! no_message; }
wait_for 'telling that a picture was written' message
wait_for 'the end of that message' no_message
xdotool key ctrl+o
type_file "$folder/bad.json"
xdotool key Return
told=$(date +%s)
sleep 1
no_message && fail 'that a file cannot be opened is not told'
xdotool key Escape
sleep 0.3
xdotool key ctrl+o
type_file "$folder/second.json"
xdotool key Return
wait_for 'taking away the message of the file before' no_message
[ $(($(date +%s) - told)) -lt 14 ] || fail 'the message of the file before was not taken away, but had its time'
save_again() {
  xdotool key ctrl+s
  sleep 0.5
  [ -n "$(find "$folder/second.json" -newer "$folder/kept.json")" ]
}
wait_for 'opening another scene, and saving it' save_again
end
cmp "$folder/kept.json" "$folder/second.json" || fail 'opened by the dialog and saved again, the scene is another'
cmp "$folder/first.json" "$folder/scene.json" || fail 'opening another scene changed the first one'

# Menus by keys alone; what has no name is asked for one; a body and its vessels are opened together.
mkdir "$folder/pair"
cp "$data/human.glb" "$data/human.vasa" "$folder/pair"
start --verbose
point 480 600
xdotool key alt+p
sleep 0.5
xdotool key Down Return # Both sides, which changes nothing that is saved
sleep 0.3
xdotool key alt+v
sleep 0.5
xdotool key Escape
sleep 0.3
xdotool key p
sleep 0.3
drag 403 316 443 210
wait_for 'a pose of both arms' titled "$unsaved"
xdotool key ctrl+s
type_file "$folder/named.json"
xdotool key Return
wait_for 'saving under a first name' titled "$saved"
for arm in LeftArm RightArm; do
  grep -q "\"$arm\"" "$folder/named.json" || fail "the menu did not ask for both sides: no $arm"
done
xdotool key ctrl+o
sleep 0.7
xdotool type --delay 30 "$folder/pair"
xdotool key Return
sleep 0.5
xdotool key Down Down shift+Down Return
opened_again() { [ "$(grep -c "preparing the body's meshes" "$folder/log")" -ge 2 ]; }
wait_for 'opening a body and vessels together' opened_again
sleep 3
xdotool key ctrl+shift+s
type_file "$folder/paired.json"
paired() { grep -q 'pair/human.glb' "$folder/paired.json" && grep -q 'pair/human.vasa' "$folder/paired.json"; }
xdotool key Return
wait_for 'saving what was opened together' paired
end

# Edits by hand: each is a line of the journal, goes with undo, comes back with redo; what is saved is the same once opened and saved again.
cp "$folder/kept.json" "$folder/edited.json" # a pose, a hidden vessel, a kept view
start "$folder/edited.json"
journal="$folder/edited.vedit"
point 480 600
xdotool key ctrl+h ctrl+f # all vessels again
sleep 0.3
xdotool type --delay 60 'left femoral artery'
sleep 0.3
xdotool key Return
sleep 0.5
point 480 600
xdotool key 1 f e
sleep 1

# lines N: N of them are saved. latest WORD: the last one saved begins with it
lines() {
  xdotool key ctrl+s
  sleep 0.3
  [ "$(grep -cv -e '^#' -e '^$' "$journal")" = "$1" ]
}
latest() { tail -n 1 "$journal" | grep -q "^$1 "; }

# edited N WORD: the Nth line has come, and goes and comes by undo and redo
edited() {
  wait_for "$2 by hand" lines "$1"
  latest "$2" || fail "instead of $2: $(tail -n 1 "$journal")"
  point 480 600
  xdotool key ctrl+z
  wait_for "undoing $2" lines $(($1 - 1))
  xdotool key ctrl+y
  wait_for "redoing $2" lines "$1"
  latest "$2" || fail "redone instead of $2: $(tail -n 1 "$journal")"
}
press() {
  point "$1" "$2"
  xdotool click 1
  sleep 0.5
}
press 311 400 # a place on the artery
drag 311 400 331 398
edited 1 move
press 106 157 # the slider for a stenosis
edited 2 stenosis
press 70 186 # the slider for the radius
edited 3 radius
press 112 244 # the tool for branches
press 420 430
edited 4 branch
press 315 464 # another place
press 184 244 # the tool for grafts
press 400 540 # past a place beside all vessels
press 338 570 # to the popliteal artery
edited 5 graft
tail -n 1 "$journal" | grep -q ' via ' || fail 'the graft does not pass where it was led'
end
cp "$folder/edited.json" "$folder/kept.json"
cp "$journal" "$folder/kept.vedit"
start "$folder/edited.json"
wait_for 'saving the edited scene again' lines 5
end
cmp "$folder/kept.json" "$folder/edited.json" || fail 'opened and saved again, the edited scene is another'
cmp "$folder/kept.vedit" "$journal" || fail 'opened and saved again, the journal is another'
"$vasa" edit "$data/human.vasa" "$journal" -o "$folder/edited.vasa" >"$folder/log" || fail 'vasa edit refuses what the app saved'

# Whoever quits while a film is being written is asked; left without it, there is nothing of it.
echo '{ "clip": "walk" }' >"$folder/walk.json"
start "$folder/walk.json"
point 480 600
xdotool key ctrl+e
type_file "$folder/film.mp4"
xdotool key Return
sleep 0.7
asked() {
  xdotool key ctrl+q
  sleep 0.7
  xdotool getwindowname "$window" >/dev/null || fail 'quitting dropped the film unasked'
}
asked
xdotool key Escape # goes on
sleep 0.3
asked
point 270 322 # Quit without it
xdotool click 1
wait "$app" || fail 'the app ended with an error'
app=
grep -q 'film.mp4: the export was cancelled' "$folder/log" || fail 'that the film was cancelled is not told'
[ ! -e "$folder/film.mp4" ] || fail 'half a film was left'

# A pose is copied, undone and pasted; several vessels are chosen by arrow keys, shown alone and named, and colours have a legend.
cat >"$folder/posed.json" <<END
{ "body": "$data/human.glb", "networks": ["$data/human.vasa"], "camera": { "view": "front" } }
END
start "$folder/posed.json"
point 480 600
xdotool key p
sleep 0.3
drag 403 316 443 210
wait_for 'another pose' titled "$unsaved"
xdotool key ctrl+c
sleep 0.3
xdotool key ctrl+z
wait_for 'undoing the pose' titled "$saved"
xdotool key ctrl+v
wait_for 'pasting the pose' titled "$unsaved"
xdotool key p o
sleep 1
press 100 50
xdotool type --delay 60 'tibial'
sleep 0.5
press 100 106
xdotool key Down shift+Down
sleep 0.3
point 480 600
xdotool key shift+h
sleep 0.3
xdotool key n l
sleep 0.3
xdotool key ctrl+s
wait_for 'saving pose and choice' titled "$saved"
xdotool key F11
sleep 0.5
xdotool key F11
sleep 0.5
end
for key in '"LeftArm"' '"hidden"' '"labels"' '"legend"'; do
  grep -q "$key" "$folder/posed.json" || fail "there is no $key in the scene of a pose and a choice"
done
cp "$folder/posed.json" "$folder/kept.json"
start "$folder/posed.json"
xdotool key ctrl+s
sleep 1
end
cmp "$folder/kept.json" "$folder/posed.json" || fail 'opened and saved again, the scene of a pose and a choice is another'
