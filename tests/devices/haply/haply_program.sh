#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# haply_program.sh KERF SOURCE OUT PROGRAM: `kerf run --device haply` with a stand-in for the service, whose ports the
# station names. The service ends in mid-run: the run names that, and its session replays to the same bits.
set -euo pipefail
readonly kerf=$1 source=$2 out=$3 program=$4

fail() {
    echo "FAILED: $1"
    cat "$out"/*.txt
    exit 1
}

rm -rf "$out" && mkdir -p "$out"
mkfifo "$out/end"
"$program" 1000 5 < "$out/end" > "$out/ports.txt" &
readonly service=$!
exec 3> "$out/end"   # its input ends when this is closed
for _ in $(seq 600); do [ -s "$out/ports.txt" ] && break; sleep 0.1; done
read -r port events < "$out/ports.txt"
cat > "$out/station.yaml" <<TEXT
apiVersion: kerf/v1
kind: Station
devices:
  - {device: haply, settings: {port: $port, events_port: $events, wait: 20 s}}
TEXT
export KERF_STATION=$out/station.yaml
readonly awl=(run "$source/procedures/pedicle-awl.yaml" --set "time_limit=12 s")

"$kerf" "${awl[@]}" --device haply --out "$out/led" > "$out/led.txt" 2>&1 3>&- &
readonly run=$!
for _ in $(seq 600); do [ -e "$out/led/session.db-wal" ] && break; sleep 0.1; done
sleep 8
exec 3>&-   # the service ends
wait "$service" || true
wait "$run" && fail "an operation of 12 s passed"
grep -q "was never confirmed" "$out/led.txt" || fail "the run does not remind of the force check"
grep -q "the device \`haply Inverse3 049D\`: the service on port $port" "$out/led.txt" || fail "the end of the service is not named"
grep -q "verdict: " "$out/led.txt" || fail "the run has no verdict"
awk '/removed/ && $2 > 0 { found = 1 } END { exit !found }' "$out/led.txt" || fail "the drill has removed nothing"
"$kerf" "${awl[@]}" --replay "$out/led/session.db" --out "$out/again" > "$out/again.txt" 2>&1 || true
grep -q "replay: the same bits" "$out/again.txt" || fail "the replay has other bits"

sed -i "s/$port/1/" "$out/station.yaml"
"$kerf" "${awl[@]}" --device haply --out "$out/none" > "$out/none.txt" 2>&1 && fail "a run without a service passed"
grep -q "the service on port 1: .*systemctl start" "$out/none.txt" || fail "a missing service is not named"
sed -i "s/wait: 20 s/wait: 20 N/" "$out/station.yaml"
"$kerf" "${awl[@]}" --device haply --out "$out/none" > "$out/wrong.txt" 2>&1 && fail "a wait of 20 N was taken"
grep -q "setting .wait. is wrong" "$out/wrong.txt" || fail "a wrong setting is not named"
echo "the arm drilled, the end of the service was named, and the session replays to the same bits"
