#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# template_sets.sh BUILD [COUNT [FIRST]]: builds the plugin template (examples/02_round_burr) with COUNT sets of random
# defaults, and runs `kerf check --level 4` on each. Each must pass. Not a test of its own: a set takes some seconds.
set -eu
build=$1 count=${2:-200} first=${3:-1}
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
n=$first
while [ "$n" -lt $((first + count)) ]; do
  # Even ratios over the range of `chip`, even steps over diameter and speed.
  set -- $(awk -v seed="$n" 'BEGIN { srand(seed); rand(); printf "%.3f %.0f %.2f", 1 + 9 * rand(), 3000 + 57000 * rand(), exp(log(5000) * rand()) }')
  sed -e "s/\.def = 4_mm/.def = $1_mm/; s/\.def = 40000_rpm/.def = $2_rpm/; s/\.def = 200_N_per_mm2/.def = $3_N_per_mm2/" \
    "$root/examples/02_round_burr/round_burr.cpp" > "$work/template.cpp"
  c++ -std=c++20 -O1 -fPIC -shared -ffp-contract=off -fno-gnu-unique -fvisibility=hidden -I"$root/core/sdk/include" \
    -Wl,--version-script="$root/cmake/kerf_plugin.map" -o "$work/template.so" "$work/template.cpp"
  if "$build/bin/kerf" check "$work/template.so" --level 4 > "$work/report" 2>&1; then
    echo "set $n passes: diameter $1 mm, speed $2 rpm, chip $3 N/mm2"
  else
    echo "set $n FAILS: diameter $1 mm, speed $2 rpm, chip $3 N/mm2"
    grep -A 3 '^FAILED' "$work/report" || tail -5 "$work/report"
    failed=$((failed + 1))
  fi
  n=$((n + 1))
done
echo "$failed of $count sets fail"
[ "$failed" -eq 0 ]
