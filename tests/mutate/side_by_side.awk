# SPDX-License-Identifier: Apache-2.0
# Plants many faults in one source, side by side. Input: the lines of faults.awk, each with its number in front, and
# -v source=FILE. Output: the source. Numbers of faults that overlap another go to the file -v left=FILE. LC_ALL=C.
BEGIN { FS = "\t" }
{
    first = $2 + 0; last = first + $3 - 1
    if ($7 == "wrap") { if (is_free_of_crossing(first, last)) { keep($1, first, last, 1); put(first, 0, 2, -$3, numbered($8, $1)); put(last + 1, 0, 1, $3, numbered($9, $1)) } else print $1 > left }
    else if (is_free(first, last)) { keep($1, first, last, 0); put(first, $3, 3, 0, numbered($8, $1)) }
    else print $1 > left
}
END {
    while ((getline line < source) > 0) text = text line "\n"
    # Edits by place; at one place ends come before beginnings, inner ends before outer, outer beginnings before inner.
    for (i = 2; i <= edits; ++i) {
        one = edit[i]
        for (j = i - 1; j > 0 && order(edit[j], one) > 0; --j) edit[j + 1] = edit[j]
        edit[j + 1] = one
    }
    at = 0
    for (i = 1; i <= edits; ++i) {
        split(edit[i], e, "\t")
        printf "%s%s", substr(text, at + 1, e[1] - at), e[5]
        at = e[1] + e[2]
    }
    printf "%s", substr(text, at + 1)
}
function numbered(s, id) { gsub(/@/, id, s); return s }
function put(place, count, rank, size, s) { edit[++edits] = place "\t" count "\t" rank "\t" size "\t" s }
function order(a, b,    x, y, k) {
    split(a, x, "\t"); split(b, y, "\t")
    for (k = 1; k <= 4; ++k) { if (k == 2) continue; if (x[k] + 0 != y[k] + 0) return x[k] - y[k] }
    return 0
}
function keep(id, a, b, is_wrap) { ++kept; from[kept] = a; to[kept] = b; wraps[kept] = is_wrap }
# A replacement overlaps nothing, but may lie within what is wrapped.
function is_free(a, b,    k) {
    for (k = 1; k <= kept; ++k) {
        if (b < from[k] || a > to[k]) continue
        if (!(wraps[k] && from[k] <= a && b <= to[k])) return 0
    }
    return 1
}
# What is wrapped may hold others, or lie within what is wrapped; it crosses none.
function is_free_of_crossing(a, b,    k) {
    for (k = 1; k <= kept; ++k) {
        if (b < from[k] || a > to[k]) continue
        if (a == from[k] && b == to[k] && wraps[k]) return 0
        if (a <= from[k] && to[k] <= b) continue
        if (wraps[k] && from[k] <= a && b <= to[k]) continue
        return 0
    }
    return 1
}
