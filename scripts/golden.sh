#!/usr/bin/env bash
# Writes the pictures of tests/golden anew after a change of the look that is meant, and lists those that changed: look at
# each of them before it is kept.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --build --preset release --target test_golden
rm -rf tests/golden/pictures
mkdir -p tests/golden/pictures
VASA_WRITE_GOLDEN=1 build/release/tests/golden/test_golden
git status --short tests/golden/pictures
