#!/usr/bin/env bash
# Installs what is missing, builds, runs the tests.
#   ./test.sh           the release build, all tests
#   ./test.sh format    every source as clang-format has it under .clang-format, the rest without a word of cmake-lint, shellcheck and pyflakes
#   ./test.sh tidy      clang-tidy over engine/ and apps/ with the checks of .clang-tidy: nothing found (half an hour)
#   ./test.sh asan      the readers and the geometry under AddressSanitizer and UBSan, leaks too
#   ./test.sh asan-all  every engine folder, those that draw too; the driver's own leaks are in tests/support/leaks.supp
#   ./test.sh tsan      what runs in parallel under ThreadSanitizer
#   ./test.sh tsan-all  what draws, too; of memory that only a driver's threads touch nothing is told
#   ./test.sh coverage  lines of engine/ and apps/ that the tests run, by folder; fails below 85 and 75 %
#   ./test.sh compilers everything builds with gcc and clang, in release, debug and under the sanitizers (hours)
#   ./test.sh drivers   shaders, pictures and validation on a second driver, SwiftShader of Debian's chromium-common
#   ./test.sh faults [N] every N-th (1) Vulkan call at which a run may fail, some 1,500 in all, a second or two each
#   ./test.sh interrupted [N]  N signals and N memory limits (40) in the middle of each command
#   ./test.sh soak [..] memory and descriptors over 20,000 frames of the app (tests/soak/drift.py)
#   ./test.sh validation  10,000 frames of everything and 300 GPU-assisted ones, 1,000 of the app with 50 resizes: not a message
#   ./test.sh same      the same bytes from 1 to 16 threads, by gcc and clang, release and debug
#   ./test.sh kills [N] N (200) kills in the middle of writing; each resumed to the same bytes, nothing left behind
#   ./test.sh slurm     a film on a Slurm cluster of this machine, with a task that is killed; installs Slurm
#   ./test.sh fuzz [N]  libFuzzer on each reader for N seconds (30); installs clang; finds go to build/fuzz/found
# Further arguments go to ctest, e.g. ./test.sh release -R network
set -euo pipefail
cd "$(dirname "$0")"
preset=${1:-release}
[ $# -gt 0 ] && shift
scripts/install-dependencies.sh
if [ "$preset" = format ]; then
  scripts/install-dependencies.sh clang-format cmake-format shellcheck pyflakes3
  git ls-files -z '*.cpp' '*.h' | xargs -0 clang-format --dry-run --Werror
  git ls-files -z '*CMakeLists.txt' '*.cmake' | xargs -0 cmake-lint --suppress-decorations
  git ls-files -z '*.sh' .ci/run | xargs -0 shellcheck
  git ls-files -z '*.py' | xargs -0 pyflakes3
  echo "format: nothing to change"
  exit 0
fi
if [ "$preset" = tidy ]; then
  scripts/install-dependencies.sh clang-tidy
  cmake --preset release -B build/tidy -DVASA_UNITY=OFF > /dev/null
  cmake --build build/tidy --target vasa_gpu_shaders_spirv vasa_render_shaders_spirv apps/vasa/made/engine_print.h
  git ls-files 'engine/*.cpp' 'apps/*.cpp' | xargs -P "$(nproc)" -n 4 clang-tidy -p build/tidy --quiet
  echo "tidy: nothing found"
  exit 0
fi
if [[ "$preset" = fuzz || "$preset" = compilers ]] && ! command -v clang++ > /dev/null; then scripts/install-dependencies.sh clang; fi
if [ "$preset" = compilers ]; then
  human=()  # the first build's make_human serves them all
  for compiler in "gcc g++" "clang clang++"; do
    read -r c cxx <<< "$compiler"
    for each in release debug asan tsan; do
      folder=build/$c-$each
      cmake --preset "$each" -B "$folder" -DVASA_UNITY=ON -DVASA_BUILD_TESTS=ON -DCMAKE_C_COMPILER="$c" -DCMAKE_CXX_COMPILER="$cxx" "${human[@]}" > /dev/null
      cmake --build "$folder"
      human=(-DVASA_MAKE_HUMAN="$PWD/build/gcc-release/apps/make_human/make_human")
      echo "compilers: $c $each builds without a warning"
    done
  done
  exit 0
fi
if [ "$preset" = drivers ]; then
  scripts/install-dependencies.sh chromium-common
  cmake --preset release -DVASA_BUILD_TESTS=ON > /dev/null
  cmake --build --preset release --target vasa human test_gpu test_render test_golden
  # The package's own ICD file says Vulkan 1.0, and a loader then offers no more.
  export VK_DRIVER_FILES=$PWD/build/swiftshader.json
  export VK_ICD_FILENAMES=$VK_DRIVER_FILES  # loaders before 1.3.207
  echo '{"file_format_version": "1.0.0", "ICD": {"library_path": "/usr/lib/chromium/libvk_swiftshader.so", "api_version": "1.3.0"}}' > "$VK_DRIVER_FILES"
  build/release/bin/vasa devices
  build/release/tests/gpu/test_gpu
  build/release/tests/golden/test_golden --test-case-exclude='a change in any family*'
  # What shows that the other driver computes and draws the same; the rest tests the program, on the first driver.
  build/release/tests/render/test_render --source-file='*parity_test.cpp,*drawn_manifold_test.cpp,*capillary_test.cpp,*everything_test.cpp' \
    --test-case-exclude='a hundred frames*'
  exit 0
fi
if [ "$preset" = slurm ]; then
  scripts/install-dependencies.sh slurm-wlm munge
  cmake --preset release -DVASA_BUILD_TESTS=ON > /dev/null
  cmake --build --preset release --target vasa human
  tests/slurm/film_test.sh build/release/bin/vasa build/slurm
  exit 0
fi
if [ "$preset" = coverage ]; then
  # clang counts in the optimised program: gcc's counters take many times as long, and the tests of whole programs did not end.
  scripts/install-dependencies.sh clang llvm
  cmake --preset release -B build/coverage -DVASA_BUILD_TESTS=ON -DVASA_WERROR=OFF -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS="-fprofile-instr-generate -fcoverage-mapping" > /dev/null
  cmake --build build/coverage
  rm -rf build/coverage/counted
  failed=0
  # A file for each program, into which all its runs are merged.
  LLVM_PROFILE_FILE=$PWD/build/coverage/counted/%m.profraw ctest --test-dir build/coverage --output-on-failure -j2 -E '^(package|faults|fuzz)' "$@" || failed=1
  llvm-profdata merge -sparse build/coverage/counted/*.profraw -o build/coverage/all.profdata
  mapfile -t programs < <(find build/coverage/bin build/coverage/tests -type f -executable ! -name '*.sh' ! -name '*.py')
  llvm-cov export -summary-only -instr-profile build/coverage/all.profdata "${programs[@]/#/-object=}" > build/coverage/lines.json
  scripts/coverage.py build/coverage/lines.json engine 85
  scripts/coverage.py build/coverage/lines.json apps 75
  exit $failed
fi
if [ "$preset" = interrupted ]; then
  cmake --preset release -DVASA_BUILD_TESTS=ON > /dev/null
  cmake --build --preset release --target vasa human
  for what in signals memory; do
    tests/soak/interrupted.py $what build/release/bin/vasa build/release/data/human.glb build/release/data/human.vasa "${1:-40}"
  done
  exit 0
fi
if [ "$preset" = kills ]; then
  cmake --preset release -DVASA_BUILD_TESTS=ON > /dev/null
  cmake --build --preset release --target vasa human
  tests/soak/kills.sh build/release/bin/vasa "${1:-200}"
  exit 0
fi
if [ "$preset" = validation ]; then
  cmake --preset release -DVASA_BUILD_TESTS=ON > /dev/null
  cmake --build --preset release --target vasa human test_render
  VASA_FRAMES_TIMES=100 build/release/tests/render/test_render --test-case='a hundred frames*'
  VASA_FRAMES_TIMES=100 build/release/tests/render/test_render --test-case='frames with everything*'
  tests/soak/drift.py build/release/bin/vasa build/release/data/human.glb build/release/data/human.vasa --validate --frames 1000 --resizes 50 --openings 0
  exit 0
fi
if [ "$preset" = same ]; then
  scripts/install-dependencies.sh clang
  programs=()
  for each in gcc-release clang-release gcc-debug; do
    preset=${each#*-}
    cmake --preset "$preset" -B "build/$each" -DVASA_UNITY=ON -DCMAKE_C_COMPILER="${each%-*}" -DCMAKE_CXX_COMPILER="$([ "${each%-*}" = gcc ] && echo g++ || echo clang++)" > /dev/null
    targets=(vasa)
    [ "$each" = gcc-release ] && targets+=(human)
    cmake --build "build/$each" --target "${targets[@]}"
    programs+=("build/$each/bin/vasa")
  done
  tests/soak/same.sh build/gcc-release/data/human.glb build/gcc-release/data/human.vasa "${programs[@]}"
  exit 0
fi
if [[ "$preset" = faults || "$preset" = soak ]]; then
  cmake --preset release -DVASA_BUILD_TESTS=ON > /dev/null
  cmake --build --preset release --target vasa human test_faults
  if [ "$preset" = faults ]; then
    VASA_FAULTS=${1:-1} build/release/tests/soak/test_faults
  else
    tests/soak/drift.py build/release/bin/vasa build/release/data/human.glb build/release/data/human.vasa "$@"
  fi
  exit 0
fi
folders=$preset
preset=${preset%-all}
cmake --preset "$preset" -DVASA_BUILD_TESTS=ON > /dev/null
if [ "$preset" = fuzz ]; then
  readers=(swc vtk vtp bvh obj stl gltf map rules scene vasa vedit replay)
  cmake --build --preset fuzz --target "${readers[@]/#/fuzz_}"
  mkdir -p build/fuzz/found
  # As many at a time as there are cores.
  # shellcheck disable=SC2016
  printf '%s\n' "${readers[@]}" | xargs -P "$(nproc)" -I{} sh -c 'mkdir -p build/fuzz/corpus/{}
    build/fuzz/tests/fuzz/fuzz_{} -max_total_time="$1" $(test ! -e tests/fuzz/{}.dict || echo -dict=tests/fuzz/{}.dict) -max_len=4096 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
      -artifact_prefix=build/fuzz/found/{}- build/fuzz/corpus/{} tests/fuzz/corpus/{} > build/fuzz/{}.log 2>&1 ||
      { cat build/fuzz/{}.log; exit 1; }
    echo "fuzz {}: $(grep -E "number_of_executed_units" build/fuzz/{}.log | tr -s " " | cut -d" " -f2) runs, nothing found"' sh "${1:-30}"
  exit 0
fi
if [ "$folders" != "$preset" ]; then
  export LSAN_OPTIONS=suppressions=$PWD/tests/support/leaks.supp:print_suppressions=0
  # Drivers and layers are not instrumented: what they do to memory and locks among themselves looks like races.
  export TSAN_OPTIONS=ignore_noninstrumented_modules=1
fi
select=()
targets=()
case "$folders" in
  asan) wanted='core math curve mesh network edit convert body io collide fuzz' ;;
  asan-all) wanted='core math curve mesh network edit convert body io collide solids avoid repair growth surface scene gpu render golden viewer fuzz' ;;
  tsan) wanted='core convert collide' ;;
  tsan-all) wanted='core convert body collide solids avoid repair growth scene gpu render viewer' ;;
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
  ctest --preset "$preset" -j2 -R "$pattern" "$@"
else
  cmake --build --preset "$preset"
  # The driver compiles its shaders once for all tests, also for those with a cache of their own.
  export MESA_SHADER_CACHE_DIR=$PWD/build/$preset/driver_shaders
  export MALLOC_PERTURB_=165  # memory that nobody has written to is not zero by chance, a driver's neither
  ctest --preset "$preset" -j2 "$@"
fi
