#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Finds words that this project uses wrongly (CONTRIBUTING.md, "Words").
#
#   prose.sh [ROOT]                        checks the whole tree; exit status 1 if a folder has more findings than allowed
#   prose.sh --list [PATH …]               lists all findings in files and folders, allowed or not
#   prose.sh --words [--limit N] FILE …    prints the mean number of words a sentence; 1 if a file is above N
#
# Checked: Markdown and string literals (words); comments of .h, .hpp and .cpp (words and comment_words); names in code
# and names of tests (names). prose-allowed.txt lists how many findings a folder may still have: the numbers only fall.
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
readonly comment_words='
said|reported, stated, except where
says|reports, returns, prints
question|query
goes on|continues
go on|continue
come to|total
comes to|totals
holds|contains, carries, is true
look at|check, inspect
look for|search
looks at|checks, inspects
looks for|searches
beside|next to, in addition to
besides|in addition
likewise|also
way|distance, path, direction, travel, method
place|point, position, index
share|fraction, weight, ratio
shared out|divided among
by a share|proportionally
all but|nearly
each for itself|separately
of each of the two|per direction
makes room|allocates, reserves
make room|allocate, reserve
has room|has capacity
room for|capacity for
whoever|the caller, the user
nobody|no one, the user
somebody|someone, the user
must not be so|(delete)
that is so|(delete)
'
# Parts of names: `way` finds way_out, is_way_ and NoWayOut.
readonly name_parts='
told|reported, commanded
tells|reports
ask|query, evaluate
asks|queries, evaluates
asked|queried, requested
way|distance, path, direction, travel
gone|removed
look|sample, check, inspect
looks|samples, checks
looked|sampled, checked
share|fraction, weight, ratio
felt|touched
most|max
least|min
'

# Reads files; prints "file:line: word → suggestion". `kind` is text (all words of a file) or code (C++).
find_words() {   # KIND FILE…
    local kind=$1
    shift
    (($# > 0)) || return 0
    WORDS=$words COMMENT_WORDS=$comment_words NAME_PARTS=$name_parts awk -v kind="$kind" '
        BEGIN {
            read_table(ENVIRON["WORDS"], word, 1)
            words = count
            read_table(ENVIRON["COMMENT_WORDS"], word, 1)
            all_words = count
            count = 0
            read_table(ENVIRON["NAME_PARTS"], part, 0)
        }
        function read_table(text, key, is_list,    entry, lines, field, i) {
            lines = split(text, entry, "\n")
            for (i = 1; i <= lines; ++i)
                if (split(entry[i], field, "|") == 2) {
                    ++count
                    if (is_list) { key[count] = field[1]; better[count] = field[2] }
                    else key[field[1]] = field[2]
                }
        }
        FNR == 1 { tail = comment_tail = ""; in_comment = 0 }
        kind == "text" {
            check($0, words, tail)
            tail = last_words($0)
        }
        kind == "code" {
            split_line($0)
            check(strings, words, "")
            check(comment, all_words, comment_tail)
            comment_tail = comment == "" ? "" : last_words(comment)
            check_names(code)
        }

        # Finds words 1 … number in a line. The last two words of the line before are put in front, so that words which
        # reach over the end of a line are found.
        function check(text, number, before,    all, from, i, at, first, end) {
            if (text == "") return
            all = " " tolower(before " " text) " "
            gsub(/[ \t]+/, " ", all)
            from = before == "" ? 1 : length(" " tolower(before) " ")
            for (i = 1; i <= number; ++i) {
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

        function last_words(text,    n, field) {
            sub(/^[ \t]*(\/\/+<?|\*|#+)[ \t]*/, "", text)
            n = split(text, field, /[ \t]+/)
            if (n == 0) return ""
            return n == 1 ? field[1] : field[n - 1] " " field[n]
        }

        # Splits a line into `code`, the contents of its `strings`, and its `comment`.
        function split_line(line,    i, c, in_string, size) {
            code = strings = comment = ""
            if (line ~ /^[ \t]*#[ \t]*include/) return
            if (!in_comment && line !~ /["\047\/]/) { code = line; return }
            in_string = 0
            size = length(line)
            for (i = 1; i <= size; ++i) {
                c = substr(line, i, 1)
                if (in_comment) {
                    if (c == "*" && substr(line, i + 1, 1) == "/") { in_comment = 0; ++i }
                    else comment = comment c
                } else if (in_string) {
                    if (c == "\\") { strings = strings " "; ++i }
                    else if (c == "\"") { in_string = 0; strings = strings " | " }
                    else strings = strings c
                } else if (c == "\"") { in_string = 1; code = code " " }
                else if (c == "\047" && substr(line, i + 1, 3) ~ /^(\\.\047|[^\\]\047)/)
                    i += substr(line, i + 1, 1) == "\\" ? 3 : 2
                else if (c == "/" && substr(line, i + 1, 1) == "/") { comment = substr(line, i); return }
                else if (c == "/" && substr(line, i + 1, 1) == "*") { in_comment = 1; ++i }
                else code = code c
            }
        }

        # Names of the project, in snake_case or CamelCase; `std::` names and at_least, at_most are others.
        function check_names(text,    names, n, i, parts, number, p) {
            gsub(/std::[a-z_:]+/, " ", text)
            gsub(/at_least|at_most|LeastSquares/, " ", text)
            if (tolower(text) !~ /told|tells|ask|way|gone|look|share|felt|most|least/) return
            n = split(text, names, /[^A-Za-z0-9_]+/)
            for (i = 1; i <= n; ++i) {
                name = names[i]
                gsub(/[A-Z]/, "_&", name)
                number = split(tolower(name), parts, "_")
                for (p = 1; p <= number; ++p)
                    if (parts[p] in part)
                        print FILENAME ":" FNR ": name " names[i] ": " parts[p] " → " part[parts[p]]
            }
        }
    ' "$@"
}

files() {   # NAME-PATTERN PATH…: those that exist
    local pattern=$1 path
    shift
    for path in "$@"; do
        [[ -e $path ]] || continue
        find "$path" -type f -name "$pattern" -not -path '*/build/*'
    done | sort
}

list_findings() {   # PATH…
    local -a markdown sources
    mapfile -t markdown < <(files '*.md' "$@")
    mapfile -t sources < <({ files '*.h' "$@"; files '*.hpp' "$@"; files '*.cpp' "$@"; } | sort)
    find_words text "${markdown[@]}"
    find_words code "${sources[@]}"
}

readonly rooms=(README.md CONTRIBUTING.md CHANGELOG.md docs procedures core text documents session bone run app plugins
    devices conformance bench studies examples tests)

check_tree() {   # ROOT
    local list=$here/prose-allowed.txt
    cd -- "$1"
    list_findings "${rooms[@]}" | awk -v list="$list" '
        BEGIN {
            while ((getline line < list) > 0) {
                ++number
                if (line ~ /^[ \t]*(#|$)/) continue
                if (split(line, field, /[ \t]+/) != 2 || field[2] !~ /^[0-9]+$/) {
                    print "prose-allowed.txt:" number ": got `" line "`, expected a folder and a number."
                    failed = 1
                    continue
                }
                if (field[1] in allowed) { print "prose-allowed.txt:" number ": " field[1] " is listed twice."; failed = 1 }
                allowed[field[1]] = field[2]
            }
        }
        {
            folder = substr($0, 1, index($0, ":") - 1)
            while (!(folder in allowed) && folder ~ /\//) sub(/\/[^\/]*$/, "", folder)
            ++found[folder]
            if (!(folder in allowed)) { print; failed = 1 }
            else last[folder] = last[folder] $0 "\n"
        }
        END {
            for (folder in allowed) {
                total += found[folder]
                if (found[folder] > allowed[folder]) {
                    printf "%s", last[folder]
                    print "prose: " folder " has " found[folder] " findings, " allowed[folder] " are allowed. Reword new text."
                    failed = 1
                } else if (found[folder] < allowed[folder]) {
                    print "prose: " folder " has " found[folder] + 0 " findings. Lower its number in prose-allowed.txt from " allowed[folder] "."
                    failed = 1
                }
            }
            if (!failed) print "prose: no finding outside the " total + 0 " that prose-allowed.txt still allows"
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
elif [[ ${1:-} == --list ]]; then
    shift
    cd -- "$here/../.."
    if (($# == 0)); then set -- "${rooms[@]}"; fi
    list_findings "$@"
else
    check_tree "${1:-$here/../..}"
fi
