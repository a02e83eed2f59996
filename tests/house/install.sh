#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install.sh BUILD [TARGET …]: whether `cmake --install BUILD` works after `./dev run`, which builds only the targets kerf,
# plugins/all and devices/all. Each file of the build tree that an install rule names must come from one of these targets, be
# made by configuring, or be OPTIONAL. Nothing is built or installed. Exit status 1 if a file is missing.
#
# Needs a build tree of Ninja; bash, awk, grep, sed and sort.
set -euo pipefail
build=$(cd -- "$1" && pwd -P)
shift
if (($# == 0)); then set -- kerf plugins/all devices/all; fi
[[ -f $build/build.ninja ]] || { printf 'skipped: %s was not made by Ninja\n' "$build"; exit 0; }

# All files that building the targets makes or needs, as build.ninja names them.
made=$(awk -v wanted="$*" '
    /^build / {
        line = substr($0, 7)
        while (line ~ /\$$/) { getline more; line = substr(line, 1, length(line) - 1) more }
        colon = index(line, ": ")
        count = split(substr(line, 1, colon - 1), outputs, " ")
        for (i = 1; i <= count; ++i) if (outputs[i] != "|") needs[outputs[i]] = substr(line, colon + 2)
    }
    END {
        last = split(wanted, queue, " ")
        for (n = 1; n <= last; ++n) {
            if (queue[n] in seen) continue
            seen[queue[n]] = 1
            if (!(queue[n] in needs)) continue
            print queue[n]
            count = split(needs[queue[n]], words, " ")
            for (i = 2; i <= count; ++i) if (words[i] !~ /^\|+$/) queue[++last] = words[i]   # the first word is the rule
        }
    }' "$build/build.ninja" | sort -u)
for target in "$@"; do
    grep -qxF -- "$target" <<<"$made" || { printf '%s: there is no target %s. Name those that ./dev run builds.\n' "$build" "$target"; exit 1; }
done

# The scripts of the tree itself, not of other trees in its folder.
scripts=("$build/cmake_install.cmake")
for ((i = 0; i < ${#scripts[@]}; ++i)); do
    mapfile -t -O "${#scripts[@]}" scripts < <(sed -nE 's/^ *include\("(.*)"\)$/\1/p' -- "${scripts[i]}")
done

failed=0 files=0
while IFS=$'\t' read -r script file; do
    ((++files))
    grep -qxF -- "${file#"$build"/}" <<<"$made" && continue
    case $file in *.cmake) [[ -f $file ]] && continue ;; esac   # CMake writes these itself
    printf '%s: installs %s, which ./dev run does not build. Add OPTIONAL to the rule.\n' "${script#"$build"/}" "${file#"$build"/}"
    failed=1
done < <(awk -v build="$build/" '
    # Rules may reach over several lines; a rule ends with `)`.
    /file\(INSTALL / { rule = ""; inside = 1 }
    inside { rule = rule " " $0 }
    inside && /\)[ \t]*$/ {
        inside = 0
        if (rule ~ / OPTIONAL /) next
        sub(/^.* FILES/, "", rule)
        while (match(rule, /"[^"]+"/)) {
            path = substr(rule, RSTART + 1, RLENGTH - 2)
            rule = substr(rule, RSTART + RLENGTH)
            if (index(path, build) == 1) print FILENAME "\t" path
        }
    }' "${scripts[@]}")

((files > 0)) || { printf '%s: no install rule names a file of the build tree. Correct tests/house/install.sh.\n' "$build"; exit 1; }
((failed)) || printf '%d files that are installed come from %s\n' "$files" "$*"
exit "$failed"
