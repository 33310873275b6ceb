#!/usr/bin/env bash
# Installs what is missing, builds, runs the tests.
#   ./test.sh           the release build, all tests
#   ./test.sh asan      the readers and the geometry under AddressSanitizer and UBSan
#   ./test.sh tsan      what runs in parallel under ThreadSanitizer
# Further arguments go to ctest, e.g. ./test.sh release -R network
set -euo pipefail
cd "$(dirname "$0")"
preset=${1:-release}
[ $# -gt 0 ] && shift
scripts/install-dependencies.sh
cmake --preset "$preset" -DVASA_BUILD_TESTS=ON > /dev/null
select=()
targets=()
case "$preset" in
  asan) wanted='core math curve mesh network convert body io collide' ;;
  tsan) wanted='core convert collide' ;;
  *) wanted='' ;;
esac
for name in $wanted; do
  [ -e "tests/$name/CMakeLists.txt" ] || continue
  targets+=("test_$name")
  select+=("^$name\$")
done
if [ ${#targets[@]} -gt 0 ]; then
  cmake --build --preset "$preset" --target "${targets[@]}"
  pattern=$(IFS='|'; echo "${select[*]}")
  ctest --preset "$preset" -R "$pattern" "$@"
else
  cmake --build --preset "$preset"
  ctest --preset "$preset" "$@"
fi
