#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# own_device.sh KERF SOURCE OUT LANGUAGE COMMAND…
#
# The device of examples/07_device leads the awl for 8 s on the wall clock. The session must replay to the same bits.
set -euo pipefail
readonly kerf=$1 source=$2 out=$3 language=$4
shift 4

if ! command -v "$1" > /dev/null; then
    echo "skipped: $1 is not installed"
    exit 0
fi
rm -rf "$out" && mkdir -p "$out"
readonly port=$((20000 + $$ % 20000))   # of this test alone
readonly awl=(run "$source/procedures/pedicle-awl.yaml" --set "time_limit=8 s")

fail() {
    echo "FAILED: $1"
    cat "$out"/*.txt
    exit 1
}

"$kerf" "${awl[@]}" --device "udp/port-$port" --out "$out/led" > "$out/led.txt" 2>&1 &
readonly run=$!
timeout 60 "$@" --port "$port" --path 12:8 > "$out/device.txt" 2>&1 ||
    fail "the device ended with an error"
wait "$run" && fail "an operation of 8 s passed"
grep -q "verdict: incomplete" "$out/led.txt" || fail "the run has no verdict"
grep -q "connected" "$out/device.txt" || fail "the device did not connect"
grep -q "\"device\": \"udp $language example\"" "$out/led/summary.json" || fail "the summary does not name the device"
"$kerf" "${awl[@]}" --replay "$out/led/session.db" --out "$out/again" > "$out/again.txt" 2>&1 || true
grep -q "replay: the same bits" "$out/again.txt" || fail "the replay has other bits"
awk '/removed/ && $2 > 0 { found = 1 } END { exit !found }' "$out/led.txt" || fail "the drill has removed nothing"
echo "the $language device drilled, and its session replays to the same bits"
