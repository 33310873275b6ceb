#!/usr/bin/env bash
# Writes the pictures of tests/golden and tests/view anew after a change of the look that is meant, and lists those that changed: look at
# each of them before it is kept.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --build --preset release --target test_golden test_view
rm -rf tests/golden/pictures tests/view/pictures
mkdir -p tests/golden/pictures tests/view/pictures
VASA_WRITE_GOLDEN=1 build/release/tests/golden/test_golden
VASA_WRITE_GOLDEN=1 build/release/tests/view/test_view --test-case='a session*,on a high-DPI*'
git status --short tests/golden/pictures tests/view/pictures
