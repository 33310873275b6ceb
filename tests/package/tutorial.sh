#!/usr/bin/env bash
# Runs every command of docs/tutorial.md, in order, in one folder: nothing here is a copy that could grow stale.
#   ```sh            is run, with -e and pipefail
#   ```sh PROGRAM    is run where PROGRAM is installed
#   ```LANGUAGE FILE is written to FILE
# usage: tutorial.sh TUTORIAL.md WORK_FOLDER INSTALLED_PREFIX
set -euo pipefail
tutorial=$(realpath "$1")
prefix=$(realpath "$3")
rm -rf "$2"
mkdir -p "$2"
cd "$2"
export PATH="$prefix/bin:$PATH" VASA_DATA_DIR="$prefix/share/vasa"

awk '
  /^```/ && !inside { inside = 1; kind = substr($1, 4); word = $2; file = sprintf("step%02d.%s", ++step, kind)
                      if (kind != "sh") file = word
                      else { print file, word > "steps"; print "set -euxo pipefail" > file }
                      next }
  /^```/ { inside = 0; close(file); next }
  inside { print > file }' "$tutorial"

count=0
while read -r file needs; do
  if [ -n "$needs" ] && ! command -v "$needs" > /dev/null; then
    echo "skipped: $needs is not installed ($file)"
    continue
  fi
  echo "== $file"
  bash "$file" < /dev/null
  count=$((count + 1))
done < steps
[ "$count" -ge 10 ] || { echo "error: only $count steps were found in $tutorial" >&2; exit 1; }
echo "$count steps done"
