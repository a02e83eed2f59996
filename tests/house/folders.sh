#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# folders.sh [ROOT]: compares the tables of folders in the documents with the tree, both ways. Exit status 1 if they differ.
#
#   docs/overview.md     each folder of the root has a row; core and bone have one for each of their folders. The rows of
#                        layers have the order of cmake/check_layers.cmake; the lines "inside core:" and "inside bone:"
#                        have the reverse
#   examples/README.md   each folder of examples has a row
#
# A folder counts if it holds a file, unless its name begins with a dot or .gitignore lists it.
# Needs bash, awk, find and grep alone.
set -euo pipefail
export LC_ALL=C.UTF-8 2>/dev/null || export LC_ALL=C
cd -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/../..}"

failed=0
complain() { printf '%s\n' "$1"; failed=1; }

folders_in() {   # FOLDER: prints the names of the folders in it
    local folder
    for folder in "$1"/*/; do
        folder=${folder%/}
        if grep -qxF -e "/${folder#./}/" .gitignore; then continue; fi
        if [[ -n $(find "$folder" -type f -print -quit) ]]; then printf '%s\n' "${folder##*/}"; fi
    done
}

# Prints "line<TAB>first cell" for each row of the tables that begin with `| folder |`.
rows_of() {   # PAGE
    awk '
        /^\| folder \|/ { in_table = 1; next }
        !/^\|/ { in_table = 0 }
        in_table && !/^\|-/ { split($0, cell, "|"); gsub(/^ +| +$/, "", cell[2]); print FNR "\t" cell[2] }' "$1"
}

# A row `x` or [x](…) is the folder PREFIXx. `rows`: the names of the rows, in their order.
compare() {   # PAGE PREFIX NAME…
    local page=$1 prefix=$2 line cell name
    shift 2
    local -A line_of=()
    rows=()
    while IFS=$'\t' read -r line cell; do
        name=$(grep -oE '^`[^`]+`|^\[[^]]+\]' <<<"$cell" | tr -d '[]`' || true)
        if [[ -z $name ]]; then
            complain "$page:$line: the row \"$cell\" names no folder. Write its name in back quotes."
        elif [[ ! -d $prefix$name ]]; then
            complain "$page:$line: the row $name has no folder: $prefix$name does not exist. Remove the row, or correct its name."
        elif [[ -n ${line_of[$name]:-} ]]; then
            complain "$page:$line: the row $name is already in line ${line_of[$name]}. Remove one of them."
        else
            line_of[$name]=$line
            rows+=("$name")
        fi
    done < <(rows_of "$page")
    for name in "$@"; do
        [[ -n ${line_of[$name]:-} ]] ||
            complain "$page: the folder $prefix$name has no row in the table of folders. Add a row $name."
    done
}

# The layers of cmake/check_layers.cmake, without the folders inside one: core/field, but not core/field/cut.
layers=$(awk '/^set\(layers/ { inside = 1 } inside { print } inside && /\)/ { exit }' cmake/check_layers.cmake |
    grep -oE '[a-z_]+(/[a-z_]+)*' | grep -vxE 'set|layers' | grep -vE '/.*/' | paste -s -d ' ')
mapfile -t rooms < <(tr ' ' '\n' <<<"$layers" | sed 's,/.*,,' | sort -u)
mapfile -t split < <(tr ' ' '\n' <<<"$layers" | grep / | sed 's,/.*,,' | sort -u)   # rooms of several layers
is_split() { grep -qxF -e "$1" <<<"$(printf '%s\n' "${split[@]}")"; }   # no pipe: grep -q ends before its writer
mapfile -t wanted < <(folders_in . | while read -r folder; do
    if is_split "$folder"; then folders_in "$folder" | sed "s,^,$folder/,"; else printf '%s\n' "$folder"; fi
done)
compare docs/overview.md '' "${wanted[@]}"
folders=${#rows[@]}

shown=$(printf '%s\n' "${rows[@]}" | while read -r row; do
    if grep -qxF -e "${row%%/*}" <<<"$(printf '%s\n' "${rooms[@]}")"; then printf '%s\n' "$row"; fi
done | paste -s -d ' ')
[[ $shown == "$layers" ]] ||
    complain "docs/overview.md: the rows of the layers are $shown; cmake/check_layers.cmake has the order $layers. Use that order."
for room in "${split[@]}"; do
    drawn=$(sed -n "s,^inside $room: *,,p" docs/overview.md | tr -s ' ─►' '\n' | grep -E '^[a-z]+$' | tac | paste -s -d ' ')
    expected=$(tr ' ' '\n' <<<"$layers" | sed -n "s|^$room/||p" | paste -s -d ' ')
    [[ $drawn == "$expected" ]] ||
        complain "docs/overview.md: the line \"inside $room:\" has, from its end, $drawn; cmake/check_layers.cmake has $expected. Draw these."
done

mapfile -t wanted < <(folders_in examples)
compare examples/README.md examples/ "${wanted[@]}"

((failed)) || printf 'the tables list %d folders, and the tree has them\n' "$((folders + ${#rows[@]}))"
exit "$failed"
