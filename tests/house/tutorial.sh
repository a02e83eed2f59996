#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tutorial.sh KERF ROOT WORK: follows docs/tutorial/02-write-a-procedure.md as a reader would.
# Each block of YAML is taken from the page; what the page quotes must be what the program prints.
set -euo pipefail
kerf=$1 root=$2 work=$3
page=$root/docs/tutorial/02-write-a-procedure.md
file=procedures/left-pedicle.yaml

fail() { printf 'tutorial: %s\n' "$1"; exit 1; }
block() { awk -v wanted="$1" '/^```yaml/ { ++n; inside = 1; next } /^```/ { inside = 0 } inside && n == wanted' "$page"; }
quotes() { grep -qxF -- "$1" "$page" || fail "the page does not quote: $1"; }   # LINE of the program's output

rm -rf -- "$work"
mkdir -p -- "$work/procedures"
cp -r -- "$root/procedures/anatomy" "$work/procedures/"
cd -- "$work"

block 2 >"$file"
"$kerf" validate "$file" || fail "the first file is refused"

# Two mistakes on purpose.
sed -i -e 's/axis: left_pedicle/axis: left_pedicel/' -e 's/{depth: 27 mm}/{depth: 27}/' "$file"
"$kerf" validate "$file" >mistakes.txt 2>&1 && fail "mistakes are accepted"
while IFS= read -r line; do quotes "$line"; done < <(head -n 3 mistakes.txt)
grep -q '^E0402 ' mistakes.txt || fail "the number without a unit is accepted"

# A rehearsal that fails, and a variant.
{ block 2; block 3; block 4; } | sed 's/landmarks: \[left_pedicle\]/landmarks: [left_pedicle, midline]/' >"$file"
"$kerf" rehearse "$file" >rehearsals.txt 2>&1 || fail "the rehearsals do not end as they say: $(tail -n 3 rehearsals.txt)"
while IFS= read -r line; do quotes "$line"; done < <(tail -n 5 rehearsals.txt)
"$kerf" rehearse "$file" --variant wide >variant.txt 2>&1 || fail "the variant does not end as it says: $(tail -n 3 variant.txt)"
"$kerf" expand "$file" --variant wide >expanded.txt
grep -q 'diameter: 4.5 mm' expanded.txt || fail "expand does not show the variant"
printf 'tutorial 2 works as written\n'
