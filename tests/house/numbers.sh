#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# numbers.sh [ROOT]: refuses sources whose numbers depend on the locale of the process. Exit status 1 if there are any.
#
#   strtod, stod, atof and relatives     read a decimal comma in some locales: std::from_chars does not
#   printf and relatives with %f, %g, …  write one: std::to_chars does not
#   std::locale, imbue, setlocale        change the locale for all of the process
#
# A source that uses text::PlainNumbers (text/plain_numbers.h) may call them. Needs bash, awk and find alone.
set -euo pipefail
export LC_ALL=C
cd -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/../..}"

# Sources that may: the start of the programs; the window, whose program has started so; the watch, which passes calls on;
# the checks of what plugins do with the locale.
allowed='app/program.cpp app/window/window_text.cpp core/haptics/watch/watch.cpp core/plugin/process_state.cpp
    conformance/zoo/animal.cpp conformance/zoo/device_animal.cpp text/plain_numbers.h'
mapfile -t sources < <(find app bone conformance core devices documents plugins run session studies text \
    \( -name '*.cpp' -o -name '*.h' -o -name '*.hpp' \) | sort)
awk -v allowed="$allowed" '
    BEGIN {
        count = split(allowed, names, /[ \n]+/)
        for (i = 1; i <= count; ++i) may[names[i]] = 1
        reads = "(strtod|strtof|strtold|stod|stof|stold|atof|setlocale|uselocale|newlocale|imbue|vprintf|vfprintf|" \
                "vsnprintf|vsprintf)[ ]*[(]"
        scans = "(s|sn|f)?printf[ ]*[(][^;]*;|[sf]?scanf[ ]*[(][^;]*;"
        conversion = "%[-+ #0]*[0-9*]*([.][0-9*]*)?[lL]?[aAeEfFgG]"
    }
    function report(what) {
        print file ": " substr(what, 2, 90)
        found = 1
    }
    function check(   rest, call) {
        if (file == "" || is_plain || file in may) return
        for (rest = code; match(rest, "[^A-Za-z0-9_]" reads "|std::locale[^A-Za-z0-9_]"); rest = substr(rest, RSTART + RLENGTH))
            report(substr(rest, RSTART, RLENGTH))
        for (rest = code; match(rest, "[^A-Za-z0-9_](" scans ")"); rest = substr(rest, RSTART + RLENGTH)) {
            call = substr(rest, RSTART, RLENGTH)
            if (call ~ conversion) report(call)
        }
    }
    FNR == 1 { check(); file = FILENAME; code = ""; is_plain = 0 }
    /PlainNumbers/ { is_plain = 1 }
    /printf|scanf|strto|sto[dfl]|atof|locale|imbue/ && !/^[ \t]*\/\// { wanted = 8 }
    wanted > 0 && !/^[ \t]*\/\// { code = code " " $0; --wanted }
    END {
        check()
        if (found) print "These depend on the locale. Use std::to_chars and std::from_chars, or text::PlainNumbers."
        exit found
    }
' "${sources[@]}"
