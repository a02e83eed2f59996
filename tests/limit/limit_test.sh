#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# limit_test.sh KERF-LIMIT: what it ends, what it lets be, and what it counts.
set -uo pipefail
limit=$1
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
failures=0
unset KERF_TEST_TIMES   # what is run here is no test

expect() {   # WHAT STATUS PATTERN COMMAND…: ends with STATUS, and prints a line with PATTERN
    local what=$1 status=$2 pattern=$3 got=0
    shift 3
    "$@" >"$folder/out" 2>&1 || got=$?
    if ((got != status)) || ! grep -q -E -- "$pattern" "$folder/out"; then
        printf '%s: ended with %d, expected %d and "%s":\n' "$what" "$got" "$status" "$pattern"
        cat -- "$folder/out"
        failures=$((failures + 1))
    fi
}

expect "a good test" 0 fine "$limit" --name good --cpu 5 -- echo fine
expect "a failing test" 7 '^$' "$limit" --name bad --cpu 5 -- sh -c 'echo; exit 7'
expect "a crash" 139 'crash: ended by signal 11' "$limit" --name crash --cpu 5 -- sh -c 'kill -SEGV $$'
expect "a loop" 124 'loop: ENDED: it used [0-9]+ s of processor time, and may use 1 s' \
    "$limit" --name loop --cpu 1 -- sh -c 'while :; do :; done'
expect "a loop in a child of a child" 124 'deep: ENDED: it used' \
    "$limit" --name deep --cpu 1 -- sh -c '(sh -c "while :; do :; done"; true); true'
expect "a hang" 124 'hang: ENDED: it hangs' "$limit" --name hang --cpu 5 --idle 2 -- sleep 60
expect "no such command" 127 'no-such-command' "$limit" --name none --cpu 5 -- no-such-command
expect "no options" 2 'NAME' "$limit" --cpu 5

# What a test leaves behind is ended with it.
"$limit" --name leaves --cpu 5 -- sh -c 'setsid sleep 60 & echo $! >"$0"; kill -0 $!' "$folder/child"
child=$(cat -- "$folder/child")
if [[ -z $child ]] || kill -0 "$child" 2>/dev/null; then
    echo "a child of a test outlives it"
    failures=$((failures + 1))
fi

# Children count.
KERF_TEST_TIMES=$folder/times "$limit" --name counts --cpu 20 -- \
    sh -c 'sh -c "i=0; while [ \$i -lt 300000 ]; do i=\$((i+1)); done"'
if ! awk -F '\t' '$1 == "counts" && $2 > 0.02 && $3 >= $2 * 0.5 { found = 1 } END { exit !found }' "$folder/times"; then
    echo "the time of a child is not counted:"
    cat -- "$folder/times"
    failures=$((failures + 1))
fi
exit $((failures > 0))
