#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Finds words that this project uses wrongly (CONTRIBUTING.md, "Words").
#
#   prose.sh [ROOT]                        checks docs, messages and public headers; exit status 1 if there is a finding
#   prose.sh --words [--limit N] FILE …    prints the mean number of words a sentence; 1 if a file is above N
#
# Checked: Markdown files; string literals of all product rooms; all text of the public headers.
# A file in prose-allowed.txt is exempt. It must have a finding: then the list only gets shorter.
# Needs bash, awk, find and sort alone: a bare Debian has no more.
set -euo pipefail
export LC_ALL=C.UTF-8 2>/dev/null || export LC_ALL=C

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
readonly here

# word|suggestion. A word that ends in _ is the beginning of a name.
readonly words='
told|reported, returned, described
tells|reports, returns, describes
asked|queried, sampled, requested
asks|queries, samples, requests
stands|is, lies, is defined in
gone|removed, expired
bears|withstands, carries, supports
looked at|checked, inspected
looked for|searched
held against|compared with, validated against
in the mean|on average
most_|max_
least_|min_
'

# Reads files; prints "file:line: word → suggestion". `kind` is text (all of it) or strings (C++ string literals).
find_words() {   # KIND FILE…
    local kind=$1
    shift
    (($# > 0)) || return 0
    WORDS=$words awk -v kind="$kind" '
        BEGIN {
            count = 0
            lines = split(ENVIRON["WORDS"], entry, "\n")
            for (i = 1; i <= lines; ++i)
                if (split(entry[i], part, "|") == 2) { ++count; word[count] = part[1]; better[count] = part[2] }
        }
        FNR == 1 { tail = ""; in_comment = 0 }
        {
            text = kind == "strings" ? strings_of($0) : $0
            check(text)
            if (kind != "strings") tail = last_words(text)
        }

        # Words that reach over the end of a line: the last two words of the line before are put in front.
        function check(text,    all, from, i, at, first, end) {
            all = " " tolower(tail " " text) " "
            gsub(/[ \t]+/, " ", all)
            from = length(" " tolower(tail) " ")
            if (tail == "") from = 1
            for (i = 1; i <= count; ++i) {
                at = 0
                while ((first = index(substr(all, at + 1), word[i])) > 0) {
                    first += at
                    end = first + length(word[i])
                    at = end - 1
                    if (end <= from) continue
                    if (substr(all, first - 1, 1) ~ /[a-z0-9_]/) continue
                    if (word[i] !~ /_$/ && substr(all, end, 1) ~ /[a-z0-9_]/) continue
                    print FILENAME ":" FNR ": " word[i] " → " better[i]
                }
            }
        }

        function last_words(text,    n, part) {
            sub(/^[ \t]*(\/\/+<?|\*|#+)[ \t]*/, "", text)
            n = split(text, part, /[ \t]+/)
            if (n == 0) return ""
            return n == 1 ? part[1] : part[n - 1] " " part[n]
        }

        # The contents of the string literals of a line, outside comments.
        function strings_of(line,    out, i, c, in_string, length_of_line) {
            if (line ~ /^[ \t]*#[ \t]*include/) return ""
            out = ""
            in_string = 0
            length_of_line = length(line)
            for (i = 1; i <= length_of_line; ++i) {
                c = substr(line, i, 1)
                if (in_comment) {
                    if (c == "*" && substr(line, i + 1, 1) == "/") { in_comment = 0; ++i }
                } else if (in_string) {
                    if (c == "\\") { out = out " "; ++i }
                    else if (c == "\"") { in_string = 0; out = out " | " }
                    else out = out c
                } else if (c == "\"") in_string = 1
                else if (c == "\047" && substr(line, i + 1, 3) ~ /^(\\.\047|[^\\]\047)/)
                    i += substr(line, i + 1, 1) == "\\" ? 3 : 2
                else if (c == "/" && substr(line, i + 1, 1) == "/") break
                else if (c == "/" && substr(line, i + 1, 1) == "*") { in_comment = 1; ++i }
            }
            return out
        }
    ' "$@"
}

files() {   # NAME-PATTERN FOLDER…: that are there
    local pattern=$1 folder
    shift
    for folder in "$@"; do
        [[ -e $folder ]] || continue
        find "$folder" -type f -name "$pattern" -not -path '*/build/*'
    done | sort
}

all_findings() {
    local -a markdown headers sources
    mapfile -t markdown < <(files '*.md' README.md CONTRIBUTING.md CHANGELOG.md docs plugins devices studies examples \
        conformance tests bench procedures)
    mapfile -t headers < <(files '*.h*' core/sdk/include)
    mapfile -t sources < <({
        files '*.cpp' core text documents session bone run app plugins studies devices
        files '*.h' core text documents session bone run app plugins studies devices
        files '*.hpp' core text documents session bone run app plugins studies devices
    } | grep -v '^core/sdk/include/')
    find_words text "${markdown[@]}" "${headers[@]}"
    find_words strings "${sources[@]}"
}

check_tree() {   # ROOT
    local list=$here/prose-allowed.txt
    cd -- "$1"
    all_findings | awk -v list="$list" '
        BEGIN {
            while ((getline line < list) > 0) {
                ++number
                if (line ~ /^[ \t]*(#|$)/) continue
                at = index(line, "#")
                file = at > 0 ? substr(line, 1, at - 1) : line
                gsub(/[ \t]+/, "", file)
                reason = at > 0 ? substr(line, at + 1) : ""
                if (reason !~ /[a-z]/) { print "prose-allowed.txt:" number ": " file " has no reason. Write one after `#`."; failed = 1 }
                if (file in allowed) { print "prose-allowed.txt:" number ": " file " is listed twice. Remove one."; failed = 1 }
                allowed[file] = number
            }
        }
        {
            file = substr($0, 1, index($0, ":") - 1)
            if (file in allowed) { used[file] = 1; next }
            print
            failed = 1
        }
        END {
            for (file in allowed)
                if (!(file in used)) {
                    print "prose-allowed.txt:" allowed[file] ": " file " has no finding, or is not a checked file. Remove the line."
                    failed = 1
                }
            if (!failed) {
                for (file in allowed) ++exempt
                print "prose: nothing found; " exempt + 0 " files are exempt (tests/house/prose-allowed.txt)"
            }
            exit failed
        }'
}

# Sentences of paragraphs and list items. Tables, headings, code blocks and comments are left out; code in a line and a
# link count as they are read.
mean_words() {   # LIMIT FILE…
    local limit=$1
    shift
    awk -v limit="$limit" '
        function finish(    n, i, sentence, words, part) {
            gsub(/\]\([^)]*\)/, "]", text)
            gsub(/[][*]/, "", text)
            n = split_sentences(text, sentence)
            for (i = 1; i <= n; ++i) {
                words = split(sentence[i], part, /[ \t]+/)
                if (words == 0) continue
                ++sentences
                total += words
                if (words > longest) { longest = words; longest_at = line_of_text }
            }
            text = ""
        }
        function split_sentences(all, out,    n, at) {
            n = 0
            gsub(/^[ \t]+|[ \t]+$/, "", all)
            while (match(all, /[.?!][)"]?[ \t]+/)) {
                at = RSTART + RLENGTH
                out[++n] = substr(all, 1, RSTART)
                all = substr(all, at)
            }
            if (all != "") out[++n] = all
            return n
        }
        function report() {
            if (name == "") return
            finish()
            mean = sentences > 0 ? total / sentences : 0
            printf "%s: %d sentences, %.1f words on average, longest %d (paragraph at line %d)\n", name, sentences, mean, longest, longest_at
            if (limit > 0 && mean > limit) { printf "%s: the average is above %s words. Write shorter sentences.\n", name, limit; failed = 1 }
            sentences = total = longest = longest_at = 0
        }
        FNR == 1 { report(); name = FILENAME; in_code = 0; text = "" }
        /^```/ { finish(); in_code = !in_code; next }
        in_code || /^    / || /^[ \t]*$/ || /^#/ || /^[ \t]*\|/ || /^<!--/ || /^!\[/ { finish(); next }
        /^[ \t]*([*-]|[0-9]+\.)[ \t]/ { finish(); sub(/^[ \t]*([*-]|[0-9]+\.)[ \t]+/, "") }
        { if (text == "") line_of_text = FNR; text = text " " $0 }
        END { report(); exit failed }
    ' "$@"
}

if [[ ${1:-} == --words ]]; then
    shift
    limit=0
    if [[ ${1:-} == --limit ]]; then limit=$2; shift 2; fi
    (($# > 0)) || { printf 'prose: --words needs a file\n' >&2; exit 2; }
    mean_words "$limit" "$@"
else
    check_tree "${1:-$here/../..}"
fi
