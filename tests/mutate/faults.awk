# SPDX-License-Identifier: Apache-2.0
# Lists the small faults that can be planted in one C++ source, one a line, in the order of the file:
#     OFFSET  LENGTH  LINE  CHANGE  REPLACEMENT  MODE  BEFORE  BEHIND           (separated by tabs)
# Replacing LENGTH bytes at OFFSET with REPLACEMENT plants the fault. CHANGE describes it.
# MODE says how to plant it beside others, to be chosen while the program runs (@ stands for its number, see choice.h):
# `swap` or `token`: BEFORE replaces the bytes; `wrap`: BEFORE and BEHIND are put around them; `-`: it cannot be.
# It reads the layout that .clang-format makes: binary operators have spaces around them, template brackets have none.
# Comments, strings, preprocessor lines and assertions are left alone. Run with LC_ALL=C: offsets are bytes.

{ source = source $0 "\n"; line_text[NR] = $0; code_text[NR] = blanked($0); code = code code_text[NR] "\n" }

END {
    offset = 1
    for (i = 1; i <= NR; ++i) { line_start[i] = offset; offset += length(line_text[i]) + 1 }
    blank_assertions()
    operators(); minus_signs(); negations(); extrema(); clamps(); numbers(); words(); enumerators()
    statements(); neighbours(", "); neighbours(" << "); sort_and_print()
}

# ---- the text ----------------------------------------------------------------------------------------------------

# The line with comments and the insides of strings replaced by spaces of the same length. Keeps state across lines.
function blanked(text,    out, n, k, c, two, mark) {
    if (!in_comment && text ~ /^[ \t]*#/) return spaces(length(text))
    n = length(text)
    for (k = 1; k <= n; ++k) {
        c = substr(text, k, 1); two = substr(text, k, 2)
        if (in_comment) {
            if (two == "*/") { in_comment = 0; out = out "  "; ++k } else out = out " "
        } else if (in_raw) {
            if (two == ")\"") { in_raw = 0; out = out " \""; ++k } else out = out " "
        } else if (two == "//") {
            return out spaces(n - k + 1)
        } else if (two == "/*") {
            in_comment = 1; out = out "  "; ++k
        } else if (substr(text, k, 3) == "R\"(") {
            in_raw = 1; out = out "R\" "; k += 2
        } else if (c == "\"" || (c == "'" && substr(text, k - 1, 1) !~ /[0-9]/)) {
            mark = c; out = out mark
            for (++k; k <= n && substr(text, k, 1) != mark; ++k) {
                if (substr(text, k, 1) == "\\") { out = out " "; ++k }
                out = out " "
            }
            out = out mark
        } else out = out c
    }
    return out
}
function spaces(n,    s) { s = sprintf("%" n "s", ""); return n > 0 ? s : "" }

function blank_assertions(    p, open, close_at) {
    p = 1
    while ((p = next_of(code, "KERF_ASSERT(", p)) > 0) { open = p + 11; close_at = closing(open); erase(p, close_at); p = close_at }
    p = 1
    while ((p = next_of(code, "static_assert(", p)) > 0) { open = p + 13; close_at = closing(open); erase(p, close_at); p = close_at }
}
function erase(from, to) { code = substr(code, 1, from - 1) spaces(to - from + 1) substr(code, to + 1) }

function next_of(text, what, from,    k) { k = index(substr(text, from), what); return k > 0 ? k + from - 1 : 0 }
function at(k) { return substr(code, k, 1) }
function is_word(c) { return c ~ /[A-Za-z0-9_]/ }
function before(k) { for (--k; k > 0 && at(k) ~ /[ \n]/;) --k; return k }   # of the last character that is no space
function after(k) { for (++k; at(k) ~ /[ \n]/;) ++k; return k }
function closing(open,    depth, k, c) {   # of the bracket that closes the one at `open`
    for (k = open; k <= length(code); ++k) {
        c = at(k)
        if (c ~ /[({\[]/) ++depth
        if (c ~ /[)}\]]/ && --depth == 0) return k
    }
    return open
}
function line_of(k,    low, high, middle) {
    low = 1; high = NR
    while (low < high) { middle = int((low + high + 1) / 2); if (line_start[middle] <= k) low = middle; else high = middle - 1 }
    return low
}
function trimmed(s) { gsub(/^[ \n]+|[ \n]+$/, "", s); return s }
function one_line(s) { gsub(/[ \n\t]+/, " ", s); return s }

function fault(offset, count, change, replacement, mode, front, behind) {
    replacement = one_line(replacement)
    if (mode == "") mode = "-"
    if (replacement == "") replacement = " "   # no column is empty
    if (front == "") front = " "
    if (behind == "") behind = " "
    found[++fault_count] = sprintf("%08d\t%d\t%d\t%s\t%s\t%s\t%s\t%s", offset - 1, count, line_of(offset), one_line(change), \
        replacement, mode, one_line(front), one_line(behind))
}

# ---- the kinds of faults -----------------------------------------------------------------------------------------

function operators() {
    exchange("<", "<="); exchange("<=", "<"); exchange(">", ">="); exchange(">=", ">"); exchange("==", "!="); exchange("!=", "==")
    exchange("&&", "||"); exchange("||", "&&"); exchange("+", "-"); exchange("-", "+"); exchange("*", "/"); exchange("/", "*")
    exchange("+=", "-="); exchange("-=", "+="); exchange("*=", "/="); exchange("/=", "*=")
}
function exchange(from, to,    p, n, mark) {
    n = length(from); p = 1
    while ((p = next_of(code, " " from, p)) > 0) {
        ++p
        if (at(p + n) !~ /[ \n]/) continue
        if (from == "+" && (at(before(p)) == "\"" || at(after(p)) == "\"")) continue   # of texts
        if (at(before(p)) ~ /[(,{;]/) continue                                           # a pointer, or no operator
        fault(p, n, from " → " to, to, from ~ /^(&&|\|\|)$/ ? "-" : "token", infix(from))
    }
}
# `a < b` becomes `a < fault::Less<@>{} > b`: the object in the middle decides. So precedence stays as it is.
function infix(op,    name) {
    name["<"] = "Less"; name["<="] = "AtMost"; name[">"] = "Greater"; name[">="] = "AtLeast"; name["=="] = "Equal"; name["!="] = "Unequal"
    name["+"] = "Plus"; name["-"] = "Minus"; name["*"] = "Times"; name["/"] = "Over"
    name["+="] = "Add"; name["-="] = "Subtract"; name["*="] = "Multiply"; name["/="] = "Divide"
    return op " kerf_fault::" name[op] "<@>{} " op
}
function minus_signs(    p, b) {
    p = 1
    while ((p = next_of(code, "-", p)) > 0) {
        b = before(p)
        if (at(p + 1) ~ /[A-Za-z0-9_(.]/ && (at(b) ~ /[(,=?:{\[<>&|*\/+]/ || substr(code, b - 5, 6) == "return"))
            fault(p, 1, "- dropped", "", at(b) ~ /[*\/+]/ ? "-" : "token", "kerf_fault::Negative<@>{} * ")
        ++p
    }
}
function negations(    p) {
    p = 1
    while ((p = next_of(code, "!", p)) > 0) {
        if (at(p + 1) ~ /[A-Za-z_(]/) fault(p, 1, "! dropped", "", "token", "kerf_fault::Not<@>{} * ")
        ++p
    }
}
function extrema() { rename("std::min", "std::max"); rename("std::max", "std::min") }
function rename(from, to,    p, n) {
    n = length(from); p = 1
    while ((p = next_of(code, from, p)) > 0) {
        if (at(p + n) ~ /[(<]/)
            fault(p, n, from " → " to, to, at(p + n) == "(" ? "token" : "-", from == "std::min" ? "kerf_fault::Min<@>{}" : "kerf_fault::Max<@>{}")
        p += n
    }
}

# Calls that bound a value: only the value is left.
function clamps() {
    unbound("std::clamp(", 1); unbound("clamped(", 1); unbound("limited(", 0); unbound("std::abs(", 1); unbound("std::fabs(", 1)
    unbound("std::min(", 2); unbound("std::max(", 2)
}
function unbound(call, kept,    p, open, close_at, n, k, depth, c, begin, arg, keep) {
    p = 1
    while ((p = next_of(code, call, p)) > 0) {
        open = p + length(call) - 1; close_at = closing(open)
        if (is_word(at(p - 1)) || at(p - 1) == ":") { p = open; continue }
        n = 0; begin = open + 1; depth = 0
        for (k = open + 1; k <= close_at; ++k) {
            c = at(k)
            if (k == close_at || (c == "," && depth == 0)) { arg[++n] = trimmed(substr(source, begin, k - begin)); begin = k + 1 }
            else if (c ~ /[({\[]/) ++depth
            else if (c ~ /[)}\]]/) --depth
        }
        keep = ""
        if (kept == 1) keep = arg[1]
        if (kept == 0 && n == 2) keep = arg[2]
        if (kept == 2 && n == 2 && arg[1] ~ /^-?[0-9.]/ && arg[1] !~ / /) keep = arg[2]
        if (kept == 2 && n == 2 && arg[2] ~ /^-?[0-9.]/ && arg[2] !~ / /) keep = arg[1]
        if (keep != "" && keep !~ /^(const )?[A-Za-z_:]+[&*]? [A-Za-z_]+$/)
            fault(p, close_at - p + 1, substr(call, 1, length(call) - 1) " dropped", "(" keep ")", "wrap", "(kerf_fault::is_on(@) ? (" keep ") : ", ")")
        p = open
    }
}

function numbers(    p, n, text, core, suffix, value, changed) {
    n = length(code)
    for (p = 1; p <= n; ++p) {
        if (at(p) !~ /[0-9]/) continue
        if (is_word(at(p - 1)) || at(p - 1) == ".") { while (is_word(at(p))) ++p; continue }
        if (!match(substr(code, p, 60), /^[0-9][0-9.]*(e[+-]?[0-9]+)?[A-Za-z_0-9]*/)) continue
        text = substr(code, p, RLENGTH)
        if (text ~ /^0x/) { p += RLENGTH - 1; continue }
        match(text, /^[0-9][0-9.]*(e[+-]?[0-9]+)?/)
        core = substr(text, 1, RLENGTH); suffix = substr(text, RLENGTH + 1)
        changed = ""
        if (core ~ /[.e]/) {
            value = core + 0
            if (value >= 1e-6) { changed = sprintf("%.6g", value * 1.2); if (changed !~ /[.e]/) changed = changed ".0" }
        } else if (at(p - 1) == "[" && at(p + length(text)) == "]")
            changed = core > 0 ? core - 1 : 1
        else if (at(p + length(text)) != ">")   # no template argument
            changed = core + 1
        if (changed != "") fault(p, length(text), text " → " changed suffix, changed suffix, "token", "kerf_fault::choose<@>(" text ", " changed suffix ")")
        p += length(text) - 1
    }
}

function words() { word("true", "false"); word("false", "true") }
function word(from, to,    p, n) {
    n = length(from); p = 1
    while ((p = next_of(code, from, p)) > 0) {
        if (!is_word(at(p - 1)) && !is_word(at(p + n))) fault(p, n, from " → " to, to, "token", "kerf_fault::choose<@>(" from ", " to ")")
        p += n
    }
}

# Values of an enumeration, return codes: another one that this file uses.
function enumerators(    p, rest, text, prefix, k, n, where, name, group, next_one, i, j) {
    p = 1; n = 0
    while (match(rest = substr(code, p), /[A-Za-z_]+(::[A-Za-z_]+)*::[a-z][a-z0-9_]*|exit_[a-z_]+|KERF_[A-Z]+/)) {
        text = substr(rest, RSTART, RLENGTH); p += RSTART - 1
        if (!is_word(at(p - 1)) && text !~ /^std::|^KERF_(ASSERT|MAX)/ && at(p + RLENGTH) !~ /[A-Za-z0-9_(<:{]/) {
            prefix = text; if (text ~ /::/) sub(/::[a-z0-9_]+$/, "", prefix); else sub(/_.*/, "", prefix)
            ++n; where[n] = p; name[n] = text; group[n] = prefix
        }
        p += RLENGTH
    }
    for (i = 1; i <= n; ++i) {
        next_one = ""
        for (j = i + 1; j <= n + i - 1 && next_one == ""; ++j) {
            k = (j - 1) % n + 1
            if (group[k] == group[i] && name[k] != name[i]) next_one = name[k]
        }
        if (next_one != "") fault(where[i], length(name[i]), name[i] " → " next_one, next_one, "token", "(kerf_fault::is_on(@) ? " next_one " : " name[i] ")")
    }
}

# Calls and assignments whose result no declaration keeps.
function statements(    i, text, start, rest, end, last_text, callee, last_callee, last_start, last_length, was_adjacent) {
    last_callee = ""
    for (i = 1; i <= NR; ++i) {
        text = substr(code, line_start[i], length(line_text[i]))
        if (text ~ /^ *$/) { continue }
        start = line_start[i]; while (at(start) == " ") ++start
        if (!begins_statement(start)) { last_callee = ""; continue }
        # Behind the head of a condition or a loop on the same line
        while (match(substr(code, start, 12), /^(if|for|while) \(|^else /)) {
            if (substr(code, start, 5) == "else ") start += 5
            else start = closing(start + index(substr(code, start), "(") - 1) + 1
            if (at(start) != " ") break
            while (at(start) == " ") ++start
        }
        if (start > line_start[i] + length(text)) { last_callee = ""; continue }
        end = end_of_statement(start)
        if (end == 0) { last_callee = ""; continue }
        rest = one_line(substr(code, start, end - start + 1))
        callee = ""
        if (rest ~ /^(return|if|for|while|do|else|using|namespace|break|continue|throw|case|default|delete|goto|public|private|static_cast|catch|try)[^A-Za-z0-9_]/) ;
        else if (rest ~ /^[A-Za-z_][A-Za-z0-9_:.>\[\]-]*\(.*\);$/) {
            callee = rest; sub(/\(.*/, "", callee)
            fault(start, end - start + 1, "statement dropped", ";", "wrap", "{ if (!kerf_fault::is_on(@)) ", " }")
        } else if (rest ~ /^[A-Za-z_*][A-Za-z0-9_.>()\[\]:, -]* ([-+*\/|&]|<<)?= .*;$/ && rest !~ /^(const |auto |constexpr |static |[A-Za-z_][A-Za-z0-9_:<>, ]*[&*]* [a-zA-Z_]+( [-+*\/|&]?=|\[))/)
            fault(start, end - start + 1, "statement dropped", ";", "wrap", "{ if (!kerf_fault::is_on(@)) ", " }")
        else if (rest ~ /^(\+\+|--)[A-Za-z_][^ ]*;$/)
            fault(start, end - start + 1, "statement dropped", ";", "wrap", "{ if (!kerf_fault::is_on(@)) ", " }")
        # Two neighbours in a list of calls of the same function
        if (callee != "" && callee == last_callee)
            fault(last_start, end - last_start + 1, "neighbours exchanged", substr(source, start, end - start + 1) " " substr(source, last_start, last_length))
        last_callee = callee; last_start = start; last_length = end - start + 1
    }
}
function begins_statement(k,    b) { b = before(k); return b <= 0 || at(b) ~ /[;{})>:]/ || substr(code, b - 3, 4) == "else" }
function end_of_statement(k,    depth, c, from) {
    from = k
    for (; k <= length(code) && k < from + 600; ++k) {
        c = at(k)
        if (c ~ /[({\[]/) ++depth
        if (c ~ /[)}\]]/ && --depth < 0) return 0
        if (c == ";" && depth == 0) return k
        if (c == "{" && depth == 1 && at(before(k)) == ")") return 0   # the body of a function
    }
    return 0
}

# Neighbouring names in a list: arguments, the members of a braced list, what goes into a row of a table.
function neighbours(separator,    p, left, right, a, b, m, k) {
    p = 1; m = substr(trimmed(separator), 1, 1) == "," ? "," : "<<"
    while ((p = next_of(code, m, p)) > 0) {
        if (m == "<<" && (at(p - 1) !~ /[ \n]/ || at(p + 2) != " ")) { p += 2; continue }
        left = before(p); a = name_ending(left)
        right = after(p + length(m) - 1); b = name_beginning(right)
        if (a != "" && b != "" && a != b && ends_element(left - length(a) + 1, right + length(b) - 1, m))
            fault(left - length(a) + 1, right + length(b) - left + length(a) - 1, a " ↔ " b, b (m == "," ? ", " : " << ") a, "swap", \
                "(kerf_fault::is_on(@) ? " b " : " a ")" (m == "," ? ", " : " << ") "(kerf_fault::is_on(@) ? " a " : " b ")")
        p += length(m)
    }
}
function ends_element(first, last, m,    b, a) {
    b = before(first); a = after(last)
    if (m == ",") return at(b) ~ /[,({]/ && at(a) ~ /[,)}]/
    return substr(code, b - 1, 2) == "<<" && (at(a) == ";" || substr(code, a, 2) == "<<")
}
function name_ending(k,    depth, c, to) {
    to = k
    for (; k > 0; --k) {
        c = at(k)
        if (c ~ /[)\]]/) ++depth
        else if (c ~ /[(\[]/) { if (--depth < 0) break }
        else if (depth == 0 && c !~ /[A-Za-z0-9_.:>&*-]/) break
        else if (c == " " || c == "\n") return ""
    }
    c = substr(code, k + 1, to - k)
    return c ~ /^[&*]?[A-Za-z_][A-Za-z0-9_.:()\[\]>-]*$/ && c !~ /^(true|false|nullptr|int|double|float|bool|char|auto)$/ ? c : ""
}
function name_beginning(k,    depth, c, from) {
    from = k
    for (; k <= length(code); ++k) {
        c = at(k)
        if (c ~ /[(\[]/) ++depth
        else if (c ~ /[)\]]/) { if (--depth < 0) break }
        else if (depth == 0 && c !~ /[A-Za-z0-9_.:>&*-]/) break
        else if (c == " " || c == "\n") return ""
    }
    c = substr(code, from, k - from)
    return c ~ /^[&*]?[A-Za-z_][A-Za-z0-9_.:()\[\]>-]*$/ && c !~ /^(true|false|nullptr|int|double|float|bool|char|auto)$/ ? c : ""
}

function sort_and_print(    i, j, one) {   # by offset; the lists are nearly sorted runs, and short
    for (i = 2; i <= fault_count; ++i) {
        one = found[i]
        for (j = i - 1; j > 0 && found[j] > one; --j) found[j + 1] = found[j]
        found[j + 1] = one
    }
    for (i = 1; i <= fault_count; ++i) print found[i]
}
