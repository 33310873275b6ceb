#!/usr/bin/env bash
# What other programs make of our files. Not part of test.sh, for these programs are large:
#   Khronos' glTF validator   npm install gltf-validator   (in a folder named by NODE_MODULES, or its parent)
#   VTK                       apt-get install python3-vtk9
#   Blender 3.4               apt-get install blender
# usage: tests/external/check_exports.sh path/to/vasa [scene options, e.g. --body B.glb --network N.vasa --clip walk]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
vasa=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- --clip walk
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "== export"
"$vasa" export "$@" -o "$work/a.glb" --quads 6x3 --budget 400 --json > "$work/glb.json"
frames=$(grep -o '"frames": [0-9]*' "$work/glb.json" | grep -o '[0-9]*')
picked=(0 $((frames / 2)) $((frames - 1)))
for frame in "${picked[@]}"; do "$vasa" export "$@" --frames "$frame" --quads 6x3 -o "$work/$frame.obj" --quiet > /dev/null; done
"$vasa" export "$@" -o "$work/a.vtp" > /dev/null

echo "== glTF validator"
if command -v node > /dev/null && (cd "${NODE_MODULES:-$here}" && node -e "require.resolve('gltf-validator')") 2> /dev/null; then
  (cd "${NODE_MODULES:-$here}" && node -e "
    require('gltf-validator').validateBytes(new Uint8Array(require('fs').readFileSync('$work/a.glb'))).then(report => {
      console.log('errors', report.issues.numErrors, 'warnings', report.issues.numWarnings);
      report.issues.messages.slice(0, 10).forEach(m => console.log(m.code, m.pointer, m.message));
      process.exit(report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0); })")
else
  echo "skipped: gltf-validator is not installed"
fi

echo "== VTK"
if /usr/bin/python3 -c 'import vtkmodules.vtkIOXML' 2> /dev/null; then
  for mode in binary appended zlib; do
    /usr/bin/python3 "$here/vtk_rewrite.py" "$work/a.vtp" "$work/$mode.vtp" "$mode"
    "$vasa" convert "$work/a.vtp" --scale 0.001 --exact -o "$work/ours.vasa" --quiet > /dev/null
    "$vasa" convert "$work/$mode.vtp" --scale 0.001 --exact -o "$work/theirs.vasa" --quiet > /dev/null
    cmp "$work/ours.vasa" "$work/theirs.vasa" && echo "$mode: VTK's copy converts to the same bytes"
  done
else
  echo "skipped: python3-vtk9 is not installed"
fi

echo "== Blender"
if command -v blender > /dev/null; then
  blender --background --factory-startup --python-exit-code 1 --python "$here/blender_compare.py" -- "$work/a.glb" "$work" "${picked[@]}" 2>&1 | grep -E '^(frame|error|Error|Traceback|objects)' || { echo "failed in Blender"; exit 1; }
else
  echo "skipped: blender is not installed"
fi
