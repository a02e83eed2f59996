#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy_test.sh WORK: checks which sources tidy.sh chooses and how it ends, in a small repository that is made in WORK.
# Exit status 1 if something is wrong.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
command -v git >/dev/null || { printf 'skipped: git is not installed\n'; exit 0; }

failed=0
complain() { printf '%s\n' "$1"; failed=1; }

rm -rf -- "$1"
mkdir -p -- "$1"
cd -- "$1"
work=$(pwd -P)
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null GIT_CEILING_DIRECTORIES=${work%/*}
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@example.org GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@example.org
commit() { git add -A && git commit -q -m "$1"; }
list() { "$here/tidy.sh" "$work" --list "$@" 2>"$work/build/said" | paste -s -d ' '; }
expect() {   # WHAT EXPECTED GOT
    [[ $2 == "$3" ]] || complain "$1: got \"$3\", expected \"$2\"."
}

# `size` has a source of its own; only `use` includes `deep`, through `wrap`; only a test includes `alone`.
mkdir -p core/part core/sdk/include/kerf text tests build/dev docs
printf '/build/\n' >.gitignore
printf 'notes\n' >docs/notes.md
printf '#pragma once\nint size();\n' >core/part/size.h
printf '#include "core/part/size.h"\nint size() { return 1; }\n' >core/part/size.cpp
printf '#pragma once\n' >core/part/deep.h
printf '#pragma once\n#include "deep.h"\n' >core/part/wrap.h
printf '#pragma once\n' >core/sdk/include/kerf/api.hpp
printf '#include <kerf/api.hpp>\n#include "core/part/size.h"\n#include "core/part/wrap.h"\nint use() { return size(); }\n' >text/use.cpp
printf '#pragma once\n' >core/part/alone.h
printf '#include "core/part/alone.h"\n#include "core/part/size.h"\nint test() { return 0; }\n' >tests/size_test.cpp
printf '#pragma once\n' >core/part/unused.h
cp -- "$here/../../.clang-tidy" .
{
    printf '[\n'
    separator=''
    for file in core/part/size.cpp text/use.cpp tests/size_test.cpp; do
        for target in kerf kerf_as_released; do
            # shellcheck disable=SC2059  # the separator is ours
            printf "$separator"'{\n  "directory": "%s",\n  "command": "c++ -std=c++20 -I%s -I%s/core/sdk/include -Werror -o CMakeFiles/%s.dir/%s.o -c %s/%s",\n  "file": "%s/%s"\n}' \
                "$work/build/dev" "$work" "$work" "$target" "$file" "$work" "$file" "$work" "$file"
            separator=',\n'
        done
    done
    printf '\n]\n'
} >build/dev/compile_commands.json

git init -q -b main .
commit first
printf '// changed\n' >>text/use.cpp
commit second

# Which files
expect 'on main, the last commit' text/use.cpp "$(list)"
printf '// changed\n' >>core/part/size.cpp
expect 'on main, a changed file' core/part/size.cpp "$(list)"
git checkout -q -b topic
commit third
printf '// changed\n' >>core/part/wrap.h
expect 'on a branch, commits and changes' 'core/part/size.cpp text/use.cpp' "$(list)"
printf 'int fresh() { return 0; }\n' >core/part/fresh.cpp
expect 'a file that is not in the build' 'core/part/size.cpp text/use.cpp' "$(list)"
grep -q 'core/part/fresh.cpp: no source' build/said || complain 'a file that is not in the build: no note names it.'
rm -- core/part/fresh.cpp core/part/size.cpp
expect 'a deleted file' text/use.cpp "$(list)"
git checkout -q -- core/part/size.cpp core/part/wrap.h
git checkout -q main
printf 'more\n' >>docs/notes.md
printf '// changed\n' >>tests/size_test.cpp
commit fourth
expect 'no file of the product changed' '' "$(list)"
grep -q 'nothing to check' build/said || complain 'no file of the product changed: no note is printed.'
expect '--all' 'core/part/size.cpp text/use.cpp' "$(list --all)"

# Which sources a header is checked through
expect 'a header with a source of its own' core/part/size.cpp "$(list core/part/size.h)"
expect 'a header behind a header' text/use.cpp "$(list core/part/deep.h)"
expect 'a header of the SDK' text/use.cpp "$(list core/sdk/include/kerf/api.hpp)"
expect 'a header that a test includes' tests/size_test.cpp "$(list core/part/alone.h)"
expect 'two headers of one source' text/use.cpp "$(list core/part/deep.h core/part/wrap.h)"
expect 'a header that no source includes' '' "$(list core/part/unused.h)"

# How it ends
ends() {   # STATUS WHAT WORDS ARGS…: the status, and words of the output
    local expected=$1 what=$2 words=$3 status=0
    shift 3
    "$here/tidy.sh" "$work" "$@" >build/said 2>&1 </dev/null || status=$?
    ((status == expected)) || complain "$what: the exit status is $status, expected $expected."
    grep -q -e "$words" build/said || { complain "$what: the output lacks \"$words\":"; cat build/said; }
}
ends 2 'no such file' 'does not exist' core/none.cpp
ends 2 'no such option' 'no option --every' --every
ends 2 'no jobs' 'expected 1 or more' -j 0
CLANG_TIDY=clang-tidy-is-not-here ends 2 'no clang-tidy' 'apt-get install --no-install-recommends clang-tidy' --all
if command -v "${CLANG_TIDY:-clang-tidy}" >/dev/null; then
    ends 0 'a clean tree' '2 sources and their headers, nothing found' --all
    printf '#include <string>\ninline bool is_none(const std::string& text) { return text.size() == 0; }\n' >>core/part/size.h
    ends 1 'a finding in a header' 'core/part/size.h:4.*readability-container-size-empty' --all
    expect 'a finding in two sources' 1 "$(grep -c container-size-empty build/said)"
    git checkout -q -- core/part/size.h
    printf 'int wrong() { return missing; }\n' >>core/part/size.cpp
    ends 1 'a source that does not compile' 'undeclared identifier' core/part/size.cpp
    git checkout -q -- core/part/size.cpp
    printf '// NOLINT\n' >>core/part/size.cpp
    ends 1 'an exemption without a reason' 'no check or no reason' core/part/size.cpp
fi
((failed)) || printf 'tidy.sh chooses sources and ends as described\n'
exit "$failed"
