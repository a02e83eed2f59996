#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# links.sh [ROOT]: follows what Markdown files point at, and the pages that sources name. Exit status 1 if something is
# missing.
#
#   [text](path#heading)   the file and the heading exist; addresses on the web are not followed
#   `core/field/grid/grid.h`    a path of the repository, in back quotes, exists
#   | file | … |           each name in back quotes in the first column of such a table is a file beside the page
#   | … | function | file | …   in such a table, each function is named in a file of its row
#   --gtest_filter='A.*'   some test has such a name; the same for: filter `A*`
#   <!-- quotes FILE -->   the block of code below is a part of the file; folders that the tree lacks are passed over
#   docs/a.md, "Heading"   in a source: the page exists, and has the heading if one is named
#
# Needs bash, awk, find, grep and sort alone.
set -euo pipefail
export LC_ALL=C.UTF-8 2>/dev/null || export LC_ALL=C
cd -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/../..}"

mapfile -t pages < <({ find . -maxdepth 1 -name '*.md'; find docs plugins devices studies examples conformance tests bench \
    procedures -name '*.md' -not -path '*/build/*' 2>/dev/null; } | sed 's,^\./,,' | sort)

# Prints "page:line<TAB>kind<TAB>target" for each link, path and filter; "page<TAB>heading<TAB>anchor" for each heading.
facts=$(awk '
    # As GitHub makes anchors: lower case, no punctuation, spaces become hyphens.
    function anchor(text) {
        gsub(/\]\([^)]*\)/, "]", text)
        text = tolower(text)
        gsub(/[`.,:;!?()\[\]{}"\047*=\/+<>&|$%#@~^]/, "", text)
        gsub(/…|–|×|°/, "", text)
        gsub(/[ \t]/, "-", text)
        return text
    }
    # Prints what is in back quotes in `text`, as facts of one kind.
    function quoted(text, kind, suffix,    rest) {
        rest = text
        while (match(rest, /`[^`]+`/)) {
            print FILENAME ":" FNR "\t" kind "\t" substr(rest, RSTART + 1, RLENGTH - 2) suffix
            rest = substr(rest, RSTART + RLENGTH)
        }
    }
    function without_quotes(text) { gsub(/`/, "", text); gsub(/,/, " ", text); return text }
    FNR == 1 { in_code = in_files = function_at = 0; delete seen }
    /^[ \t]*```/ { in_code = !in_code; next }
    /^\| file \|/ { in_files = 1 }
    !/^\|/ { in_files = function_at = 0 }
    in_files { split($0, cell, "|"); quoted(cell[2], "file", "") }
    function_at { split($0, cell, "|"); quoted(cell[function_at], "function", " " without_quotes(cell[function_at + 1])) }
    /\| function \| file \|/ {
        n = split($0, cell, "|")
        for (i = 1; i <= n; ++i) if (cell[i] == " function ") function_at = i
    }
    !in_code && /^#+ / {
        heading = $0
        sub(/^#+ +/, "", heading)
        sub(/[ \t]+$/, "", heading)
        name = anchor(heading)
        print FILENAME "\theading\t" name (seen[name]++ ? "-" (seen[name] - 1) : "")
    }
    !in_code {
        rest = $0
        while (match(rest, /\]\([^) ]+\)/)) {
            print FILENAME ":" FNR "\tlink\t" substr(rest, RSTART + 2, RLENGTH - 3)
            rest = substr(rest, RSTART + RLENGTH)
        }
        rest = $0
        while (match(rest, /`[^`]+`/)) {
            code = substr(rest, RSTART + 1, RLENGTH - 2)
            before = substr(rest, 1, RSTART - 1)
            if (before ~ /filter $/) print FILENAME ":" FNR "\tfilter\t" code
            else if (code ~ /^\.?\/?(app|bench|cmake|core|devices|docs|plugins|procedures|run|studies|tests|examples|conformance)(\/[A-Za-z0-9_.-]+)+\/?$/)
                print FILENAME ":" FNR "\tpath\t" code
            rest = substr(rest, RSTART + RLENGTH)
        }
    }
    {
        rest = $0
        while (match(rest, /--gtest_filter=\047[^\047]+\047/)) {
            print FILENAME ":" FNR "\tfilter\t" substr(rest, RSTART + 16, RLENGTH - 17)
            rest = substr(rest, RSTART + RLENGTH)
        }
    }' "${pages[@]}")

declare -A headings=()
while IFS= read -r line; do headings[$line]=1; done < <(awk -F '\t' '$2 == "heading" { print $1 "#" $3 }' <<<"$facts")
tests=$(find tests -name '*.cpp' -exec grep -hoE '^TEST(_F|_P)?\([A-Za-z0-9_]+, *[A-Za-z0-9_]+' {} + |
    sed -E 's/^TEST(_F|_P)?\(//; s/, */./' | sort -u)

failed=0
complain() { printf '%s\n' "$1"; failed=1; }

folder_of() { if [[ $1 == */* ]]; then REPLY=${1%/*}; else REPLY=.; fi; }

# REPLY: the path without "." and "..".
make_plain() {
    local -a out=() parts
    local part
    IFS=/ read -ra parts <<<"$1"
    for part in "${parts[@]}"; do
        case $part in
            '' | .) ;;
            ..) if ((${#out[@]} > 0)); then unset 'out[-1]'; else out=(outside); fi ;;
            *) out+=("$part") ;;
        esac
    done
    local IFS=/
    REPLY="${out[*]}"
}

check_link() {   # PLACE TARGET
    local page=${1%:*} target=$2 path heading=''
    case $target in
        http://* | https://* | mailto:*) return ;;
    esac
    if [[ $target == *'#'* ]]; then heading=${target#*#}; fi
    path=${target%%#*}
    if [[ -z $path ]]; then
        path=$page
    else
        folder_of "$page"
        make_plain "$REPLY/$path"
        path=$REPLY
    fi
    if [[ ! -e $path ]]; then
        complain "$1: the link to $target leads to $path, which does not exist. Correct it."
    elif [[ -n $heading && -z ${headings["$path#$heading"]:-} ]]; then
        complain "$1: $path has no heading #$heading. Correct the link."
    fi
}

check_file() {   # PLACE NAME: with or without its ending; * matches
    folder_of "${1%:*}"
    compgen -G "$REPLY/$2" >/dev/null || compgen -G "$REPLY/$2.*" >/dev/null ||
        complain "$1: there is no file $2 in $REPLY. Correct the table."
}

check_function() {   # PLACE "Class::name file …"
    local -a words files=()
    local word
    read -ra words <<<"$2"
    for word in "${words[@]:1}"; do if [[ -f $word ]]; then files+=("$word"); fi; done
    ((${#files[@]} > 0)) || { complain "$1: no file is named for ${words[0]}. Name it."; return; }
    grep -qwF -- "${words[0]##*::}" "${files[@]}" || complain "$1: ${words[0]} is not in ${files[*]}. Correct the table."
}

check_filter() {   # PLACE PATTERNS
    local pattern expression
    local -a patterns
    IFS=: read -ra patterns <<<"$2"
    for pattern in "${patterns[@]}"; do
        [[ $pattern == *[A-Za-z]* ]] || continue
        expression=${pattern//./\\.}
        expression="^${expression//\*/.*}\$"
        grep -qE -- "$expression" <<<"$tests" || complain "$1: no test has a name like $pattern. Correct the filter."
    done
}

while IFS=$'\t' read -r place kind target; do
    case $kind in
        link) check_link "$place" "$target" ;;
        path) [[ -e $target ]] || complain "$place: $target does not exist. Correct the path." ;;
        file) check_file "$place" "$target" ;;
        function) check_function "$place" "$target" ;;
        filter) check_filter "$place" "$target" ;;
    esac
done <<<"$facts"
check_named_page() {   # PLACE 'docs/a.md' or 'docs/a.md, "Heading"'
    local page=${2%%,*} heading=''
    if [[ $2 == *'"'* ]]; then heading=${2#*\"}; heading=${heading%\"}; fi
    if [[ ! -f $page ]]; then
        complain "$1: $page does not exist. Correct the comment."
    elif [[ -n $heading ]] && ! grep -qE "^#+ +$heading\$" -- "$page"; then
        complain "$1: $page has no heading \"$heading\". Correct the comment."
    fi
}

while IFS= read -r line; do
    place=${line%%:docs/*}
    check_named_page "$place" "${line#"$place":}"
done < <({
    find app bench cmake core devices examples plugins procedures run studies tests -type f \( -name '*.h' -o -name '*.hpp' \
        -o -name '*.cpp' -o -name '*.cmake' -o -name '*.txt' -o -name '*.yaml' \) -not -path '*/build/*' -print0 2>/dev/null
    printf 'dev\0'
} | xargs -0 grep -noE 'docs/[A-Za-z0-9_/.-]+\.md(, "[^"]+")?')

# A page's block of code, compared with the file that it quotes.
while IFS=$'\t' read -r place file; do
    [[ -d ${file%%/*} ]] || continue
    if [[ ! -f $file ]]; then
        complain "$place: $file, which is quoted, does not exist. Correct the page."
        continue
    fi
    quoted=$(tail -n "+${place##*:}" -- "${place%:*}" | awk '/^```/ { ++fences; next } fences == 1')
    whole=$(<"$file")
    [[ -n $quoted && $whole == *"$quoted"* ]] || complain "$place: the code below is not a part of $file. Copy it again."
done < <(grep -noE '<!-- quotes [^ ]+ -->' -- "${pages[@]}" | sed -E 's/^([^:]+:[0-9]+):<!-- quotes ([^ ]+) -->/\1\t\2/')

((failed)) || printf 'all links, paths and test filters of %d pages lead somewhere\n' "${#pages[@]}"
exit "$failed"
