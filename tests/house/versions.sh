#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# versions.sh [ROOT]: compares the version in standing files with that of the CMake project, and checks that CITATION.cff has
# the keys that the Citation File Format 1.2.0 requires. Exit status 1 if something differs or is missing.
#
# Needs bash, grep and sed alone.
set -euo pipefail
cd -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/../..}"

failed=0
complain() { printf '%s\n' "$1"; failed=1; }

version=$(sed -nE 's/^project\(kerf VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
[[ -n $version ]] || { printf 'CMakeLists.txt: no line begins with "project(kerf VERSION", so no version can be compared. Correct tests/house/versions.sh.\n'; exit 1; }

compare() {   # FILE EXPRESSION: its first group is the version
    local found
    if [[ ! -f $1 ]]; then complain "$1 does not exist. Write it."; return; fi
    found=$(sed -nE "s/$2/\\1/p" -- "$1" | head -n 1)
    [[ $found == "$version" ]] ||
        complain "$1: the version is ${found:-missing}, and CMakeLists.txt has $version. Write $version."
}
compare CITATION.cff '^version: *"?([0-9.]+)"?$'
compare SECURITY.md '.*reported as ([0-9]+\.[0-9]+\.[0-9]+).*'
compare CHANGELOG.md '.*program reports ([0-9]+\.[0-9]+\.[0-9]+).*'

if [[ -f CITATION.cff ]]; then
    for line in 'cff-version: 1\.2\.0' 'message: .+' 'title: .+' 'authors:'; do
        grep -qxE -- "$line" CITATION.cff || complain "CITATION.cff: no line \"${line//\\/}\". The format requires it."
    done
fi
notice='[Ff]or training and research; not for diagnosis, planning or deciding treatment'
for file in CITATION.cff SECURITY.md; do
    [[ ! -f $file ]] || grep -qE -- "$notice" "$file" || complain "$file: the notice line is missing. Copy it from README.md."
done

((failed)) || printf 'the standing files have version %s\n' "$version"
exit "$failed"
