#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks C++ sources with clang-tidy, by the file .clang-tidy.
#
#   tidy.sh ROOT [--list] [-j N] [--all | FILE…]
#
# Without FILE and --all: the files that differ from the merge base with origin/main or main; with none, those of the last
# commit. A header is checked through one source that includes it. --list prints the sources and checks nothing.
# -j is the number of sources at a time. CLANG_TIDY names another program.
# Exit status: 0 nothing found, 1 findings, 2 could not check.
#
# Needs ROOT/build/dev/compile_commands.json; git, bash, awk, find, grep, sort and xargs.
set -euo pipefail
export LC_ALL=C.UTF-8 2>/dev/null || export LC_ALL=C

readonly rooms=(core text documents session bone run app plugins devices conformance)   # what the project ships
readonly tidy=${CLANG_TIDY:-clang-tidy}

say() { printf '%s\n' "$*" >&2; }
fail() { say "tidy: $1"; exit 2; }

# ---- arguments ---------------------------------------------------------------------------------------------------

(($# > 0)) || fail "usage: tidy.sh ROOT [--list] [-j N] [--all | FILE…]"
root=$(cd -- "$1" && pwd -P)
shift
mode=changed lists=false jobs=$(nproc)
named=()
while (($# > 0)); do
    case $1 in
        --all) mode=all ;;
        --list) lists=true ;;
        -j) jobs=${2:-}; shift || true ;;
        -j*) jobs=${1#-j} ;;
        -*) fail "there is no option $1. It takes --all, --list, -j N or files" ;;
        *)
            [[ -f $1 ]] || fail "$1: the file does not exist"
            file=$(cd -- "$(dirname -- "$1")" && pwd -P)/${1##*/}
            [[ $file == "$root"/* ]] || fail "$1: the file is outside $root"
            named+=("${file#"$root"/}")
            mode=named ;;
    esac
    shift
done
[[ $jobs =~ ^[1-9][0-9]*$ ]] || fail "-j: the number is wrong: got \"$jobs\", expected 1 or more"
cd -- "$root"
readonly work=$root/build/tidy

# ---- which files -------------------------------------------------------------------------------------------------

is_cpp() { [[ $1 =~ \.(h|hpp|cpp)$ ]]; }
is_in_rooms() {
    local room
    for room in "${rooms[@]}"; do [[ $1 != "$room"/* ]] || return 0; done
    return 1
}

differing() {   # COMMIT: files of the tree that differ from it or are new
    git diff --name-only --diff-filter=d "$1" --
    git ls-files --others --exclude-standard
}

# Prints the commit to compare with.
base_commit() {
    local branch base=''
    for branch in origin/main main; do
        if git rev-parse --quiet --verify "$branch^{commit}" >/dev/null; then
            base=$(git merge-base HEAD "$branch" || true)
            break
        fi
    done
    if [[ -z $base ]] || { [[ $base == "$(git rev-parse HEAD)" ]] && [[ -z $(differing HEAD) ]]; }; then
        base=$(git rev-parse --quiet --verify 'HEAD~1^{commit}') || return 1
    fi
    printf '%s\n' "$base"
}

wanted=()
case $mode in
    named) wanted=("${named[@]}") ;;
    changed)
        base=$(base_commit) || fail "there is no commit to compare with. Use --all, or name files"
        while IFS= read -r file; do
            if is_cpp "$file" && is_in_rooms "$file"; then wanted+=("$file"); fi
        done < <(differing "$base" | sort -u)
        if ((${#wanted[@]} == 0)); then
            say "tidy: no C++ file of the product differs from $(git rev-parse --short "$base"); nothing to check"
            exit 0
        fi ;;
esac

# ---- which sources compile them ----------------------------------------------------------------------------------

readonly commands=$root/build/dev/compile_commands.json
[[ -f $commands ]] || fail "build/dev/compile_commands.json is missing. Run ./dev tidy, which configures the build"
mkdir -p -- "$work"

# One command a source: those of *_as_released compile the same text again.
awk '
    /^\{/ { entry = ""; file = "" }
    /^[\[\]]/ { next }
    { entry = entry $0 "\n" }
    { gsub(/ -fno-gnu-unique/, "", entry) }   # an option of gcc that clang refuses
    /"file":/ { file = $2 }
    /^\}/ {
        sub(/\},?\n$/, "}", entry)
        if (!(file in seen) && entry !~ /_as_released\.dir/) { seen[file] = 1; all = all (all == "" ? "" : ",\n") entry }
    }
    END { print "[\n" all "\n]" }' "$commands" >"$work/compile_commands.json"
grep -oE '"file": *"[^"]*"' "$work/compile_commands.json" | sed -E 's/^"file": *"//; s/"$//' |
    awk -v root="$root/" 'index($0, root) == 1 { print substr($0, length(root) + 1) }' | sort >"$work/units"

# Reads names of files; prints, sorted, the sources that compile them, and names to stderr the files that no source
# includes. `#include "x"` is found next to the file, in the root, or in the SDK.
units_of() {
    local folders=() folder
    for folder in "${rooms[@]}" studies bench examples tests; do
        if [[ -d $folder ]]; then folders+=("$folder"); fi
    done
    find "${folders[@]}" -type f \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) | sort >"$work/files"
    awk -v units="$work/units" -v files="$work/files" '
        function stem(path) { sub(/\.[a-z]+$/, "", path); return path }
        function is_test(path) { return path ~ /^tests\// }
        function resolve(from, name,    folder) {
            folder = from
            sub(/[^\/]*$/, "", folder)
            if ((folder name) in known) return folder name
            if (name in known) return name
            return ("core/sdk/include/" name) in known ? "core/sdk/include/" name : ""
        }
        # The nearest source: that of the same name, else the first of the product, else the first of the tests.
        function unit_for(header,    queue, at, last, reached, n, i, from, best, spare) {
            queue[last = 1] = header
            reached[header] = 1
            spare = ""
            for (at = 1; at <= last; ++at) {
                best = ""
                n = split(includers[queue[at]], list, "\n")
                for (i = 1; i <= n; ++i) {
                    from = list[i]
                    if (from == "" || from in reached) continue
                    reached[from] = 1
                    queue[++last] = from
                    if (!(from in is_unit)) continue
                    if (stem(from) == stem(header)) return from
                    if (is_test(from)) { if (spare == "") spare = from } else if (best == "") best = from
                }
                if (best != "") return best
            }
            return spare
        }
        BEGIN {
            while ((getline path < units) > 0) is_unit[path] = 1
            while ((getline path < files) > 0) { known[path] = 1; all[++count] = path }
            for (i = 1; i <= count; ++i) {
                while ((getline line < all[i]) > 0)
                    if (line ~ /^ *# *include *["<]/) {
                        split(line, part, /["<>]/)
                        target = resolve(all[i], part[2])
                        if (target != "") includers[target] = includers[target] "\n" all[i]
                    }
                close(all[i])
            }
        }
        {
            unit = $0 in is_unit ? $0 : $0 ~ /\.cpp$/ ? "" : unit_for($0)
            if (unit == "") print "tidy: " $0 ": no source of build/dev compiles it; not checked" > "/dev/stderr"
            else print unit
        }' | sort -u
}

if [[ $mode == all ]]; then
    mapfile -t units < <(while IFS= read -r file; do if is_in_rooms "$file"; then printf '%s\n' "$file"; fi; done <"$work/units")
else
    mapfile -t units < <(printf '%s\n' "${wanted[@]}" | units_of)
fi
if $lists; then
    ((${#units[@]} == 0)) || printf '%s\n' "${units[@]}"
    exit 0
fi

# ---- checking ----------------------------------------------------------------------------------------------------

command -v "$tidy" >/dev/null || fail "$tidy is missing. As root: apt-get install --no-install-recommends clang-tidy"

# An exemption names its check and gives a reason: NOLINT(check): reason.
findings=0
if bare=$(grep -rnE --include='*.h' --include='*.hpp' --include='*.cpp' 'NOLINT' "${wanted[@]:-.}" --exclude-dir=build |
    grep -vE 'NOLINT(NEXTLINE)?\([a-z0-9.-]+\): [^ ]'); then
    printf '%s\n' "$bare"
    say "tidy: an exemption gives no check or no reason. Write NOLINT(check): reason"
    findings=1
fi

rm -rf -- "$work/log"
mkdir -p -- "$work/log"
filter="^$(sed 's/[.+*^$(){}|]/\\&/g; s/\[/\\[/g; s/\]/\\]/g' <<<"$root")/($(IFS='|'; printf '%s' "${rooms[*]}"))/"
export tidy work filter

check_one() {   # FILE
    local log=$work/log/${1//\//+} status=0
    "$tidy" -p "$work" --quiet "--header-filter=$filter" --extra-arg=-Wno-error --extra-arg=-O0 \
        --extra-arg=-Wno-unknown-warning-option "$1" >"$log" 2>"$log.err" </dev/null || status=$?
    if ((status != 0)) && [[ ! -s $log ]]; then
        printf '%s: clang-tidy ended with status %s [clang-tidy]\n' "$1" "$status" >"$log"
        tail -n 20 -- "$log.err" >>"$log"
    fi
    printf '%s\n' "$1"
}
export -f check_one

# On a terminal one line that is written over, else a line every 20 s.
show_progress() {   # TOTAL
    local file checked=0 last=$SECONDS
    while IFS= read -r file; do
        checked=$((checked + 1))
        if [[ -t 2 ]]; then
            printf '\r      %d of %d  %s\033[K' "$checked" "$1" "$file" >&2
        elif ((SECONDS - last >= 20)); then
            say "      $checked of $1"
            last=$SECONDS
        fi
    done
    if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

if ((${#units[@]} > 0)); then
    printf '%s\0' "${units[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'check_one "$1"' _ | show_progress "${#units[@]}"
fi

# A finding in a header comes once for each source that includes it.
if ((${#units[@]} > 0)); then
    found=$(for file in "${units[@]}"; do cat -- "$work/log/${file//\//+}"; done | awk -v root="$root/" '
        / (warning|error): .*\[[a-zA-Z0-9.,-]+\]$/ || /\[clang-tidy\]$/ { is_new = !($0 in seen); seen[$0] = 1 }
        is_new { if (index($0, root) == 1) $0 = substr($0, length(root) + 1); print }')
    if [[ -n $found ]]; then
        printf '%s\n' "$found"
        findings=1
    fi
fi
if ((findings)); then
    say "tidy: these findings are in ${#units[@]} sources and their headers. Correct them; .clang-tidy lists the checks"
else
    say "tidy: ${#units[@]} sources and their headers, nothing found"
fi
exit "$findings"
