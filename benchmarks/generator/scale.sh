#!/usr/bin/env bash
# scale.sh BUILD [UNITS]: what the generator and the compiler take for an application of many units (default 500, with
# two output slots each): generation, build, the largest compiler process, the executable. BUILD has been built; GNU
# time is needed.
set -eu -o pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(readlink -f "$1") units=${2-500}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >/dev/null
python3 "$here/scale.py" "$work/scale" "$units" 2
generate() {
  "$work/prefix/bin/config-gen" --application "$work/scale/scale.toml" --types "$work/scale/types" \
    --units "$work/scale/units" --output "$work/generated" 2>/dev/null
}
generate
echo "generation of $units units and $((units * 2)) slots:"
(TIMEFORMAT='  %R s'; time generate)

printf 'cmake_minimum_required(VERSION 3.25)\nproject(Scale LANGUAGES CXX)\nfind_package(FlexRF REQUIRED)\nadd_subdirectory(scale)\n' \
  >"$work/CMakeLists.txt"
printf '#!/bin/sh\nexec /usr/bin/time -a -o %s -f %%M "$@"\n' "$work/peaks" >"$work/launcher"
chmod +x "$work/launcher"
cmake -S "$work" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$work/launcher" >/dev/null
echo "build on 2 cores:"
(TIMEFORMAT='  %R s'; time ninja -C "$work/build" -j2 >"$work/log" 2>&1) || { cat "$work/log" >&2; exit 1; }
echo "largest compiler process: $(($(sort -n "$work/peaks" | tail -1) / 1024)) MiB"
echo "executable: $(($(stat -c %s "$work/build/scale/scale") / 1024)) KiB"
"$work/build/scale/scale" --virtual-time 1s >/dev/null
