#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Plants small faults in one source and reports, one by one, which of them a test notices.
# The sources are copied to build/mutate/tree first: the working tree is never changed. There most faults are compiled
# in side by side and chosen by the environment (choice.h); those that cannot be are compiled one at a time.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: ./dev mutate FILE [--limit N] [--seed S] [--line L] [--tests REGEX] [--list]

  FILE           a source of the product, for example core/haptics/law/solve.cpp
  --limit N      stop after N faults that compile (40); 0: all of them
  --seed S       another choice of faults (1); the same seed makes the same choice
  --line L       only the faults on this line
  --tests REGEX  only the test programs whose names match, for example 'field|haptics'
  --list         print the faults and stop

The table is kept in build/mutate/FILE.txt. tests/mutate/equivalent.txt lists faults that change nothing.
TEXT
}
say() { printf '%s\n' "$*" >&2; }
fail() { say "dev mutate: $1"; exit "${2:-2}"; }

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(cd -- "$here/../.." && pwd -P)
work=$root/build/mutate
tree=$work/tree
build=$tree/build/dev
readonly here root work tree build
export LC_ALL=C

file='' limit=40 seed=1 only_line=0 wanted_programs=. only_list=false
while (($# > 0)); do
    case $1 in
        --list) only_list=true; shift; continue ;;
        -h | --help) usage; exit 0 ;;
        --*)
            (($# > 1)) || fail "$1 needs a value"
            case $1 in
                --limit) limit=$2 ;;
                --seed) seed=$2 ;;
                --line) only_line=$2 ;;
                --tests) wanted_programs=$2 ;;
                *) usage >&2; fail "there is no option \"$1\"" ;;
            esac
            shift 2 ;;
        *) file=$1; shift ;;
    esac
done
[[ -n $file ]] || { usage >&2; fail "no file is given"; }
[[ $limit =~ ^[0-9]+$ && $seed =~ ^[0-9]+$ && $only_line =~ ^[0-9]+$ ]] || fail "--limit, --seed and --line take whole numbers"
given=$file
[[ -f $file ]] || file=$root/$file
[[ -f $file ]] || fail "$given: there is no such file"
file=$(realpath --relative-to="$root" -- "$file")
[[ $file =~ ^(core|text|documents|session|bone|run|plugins|devices|app|studies)/.*\.(cpp|h|hpp)$ ]] || fail "$given: must be a C++ source of the product"
readonly file limit seed only_line wanted_programs

# ---- the faults --------------------------------------------------------------------------------------------------

# In an order that depends on the seed alone.
shuffled() {
    awk -v seed="$seed" '
        { line[NR] = $0 }
        END {
            state = (seed * 7919 + 12345) % 2147483647
            for (i = NR; i > 1; --i) {
                state = (state * 16807) % 2147483647
                j = 1 + state % i
                kept = line[i]; line[i] = line[j]; line[j] = kept
            }
            for (i = 1; i <= NR; ++i) print line[i]
        }'
}
# Faults that cannot change the behaviour, with reasons: see the head of equivalent.txt.
is_equivalent() {   # TEXT-OF-THE-LINE CHANGE
    KERF_FILE=$file KERF_TEXT=$1 KERF_CHANGE=$2 awk '
        function value(line) { sub(/^ *[a-z]+: */, "", line); return line }
        /^[^ #]/ { is_here = ($0 == ENVIRON["KERF_FILE"]) }
        is_here && /^ *line: / { is_line = (value($0) == ENVIRON["KERF_TEXT"]) }
        is_here && is_line && /^ *change: / && value($0) == ENVIRON["KERF_CHANGE"] { found = 1 }
        END { exit !found }' "$here/equivalent.txt"
}

# The number of a fault is its place here, from 1 on.
mapfile -t -O 1 faults < <(awk -f "$here/faults.awk" "$root/$file" |
    awk -F '\t' -v line="$only_line" 'line == 0 || $3 == line' | shuffled)
((${#faults[@]} > 0)) || fail "$file: no fault can be planted there"
if $only_list; then
    printf '%s\n' "${faults[@]}" | sort | awk -F '\t' '{ print $3 "\t" $4 }'
    exit 0
fi

# ---- the copy and its build --------------------------------------------------------------------------------------

mkdir -p -- "$tree"
if command -v flock >/dev/null; then
    exec 8>"$work/lock"
    flock --nonblock 8 || fail "another ./dev mutate is running in this tree"
fi

update_copy() {
    local from name
    while IFS= read -r from; do
        case $from in
            "Only in $tree"*) name=${from#"Only in $tree"}; name=${name/: //}; rm -rf -- "${tree:?}/$name" ;;
            "Only in $root"*) name=${from#"Only in $root"}; name=${name/: //}; cp -R -- "$root/$name" "$tree/$name" ;;
            "Files "*) name=${from#"Files $root/"}; name=${name%%" and $tree/"*}; cp -- "$root/$name" "$tree/$name" ;;
        esac
    done < <(diff -rq -x .git -x build -x out -x shared "$root" "$tree" || true)
}
restore() { cmp -s -- "$root/$file" "$tree/$file" || cp -- "$root/$file" "$tree/$file"; }

update_copy
trap restore EXIT
trap 'exit 130' INT TERM
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root} CCACHE_NOHASHDIR=1
if [[ ! -f $build/build.ninja ]]; then
    launcher=()
    if command -v ccache >/dev/null; then
        launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    fi
    cmake -S "$tree" --preset dev -DKERF_TESTS=ON "${launcher[@]}" >"$work/configure.log" 2>&1 ||
        fail "configuring failed; see ${work#"$root"/}/configure.log" 3
fi
ninja -C "$build" build.ninja >"$work/configure.log" 2>&1 || fail "configuring failed; see ${work#"$root"/}/configure.log" 3

# ---- the tests that know the file --------------------------------------------------------------------------------

# One a line: all that a program depends on, plugins that it loads too.
inputs_of() { ninja -C "$build" -t inputs "bin/$1" 2>/dev/null || true; }

mirrored=tests/${file%.*}_test.cpp
[[ -e $mirrored ]] || mirrored=tests/$(dirname -- "$(dirname -- "$file")")/$(basename -- "${file%.*}")_test.cpp   # of a folder inside a layer
# A program knows a source that it is made of, and a header when it is made of a source of the same folder.
knows() {   # INPUTS
    case $file in
        *.cpp) grep -q -F -x -- "$tree/$file" <<<"$1" ;;
        *) grep -q -F -- "$tree/$(dirname -- "$file")/" <<<"$1" ;;
    esac
}
programs=() near=() far=()
while IFS= read -r program; do
    [[ $program =~ $wanted_programs ]] || continue
    inputs=$(inputs_of "$program")
    knows "$inputs" || continue
    if grep -q -F -x -- "$tree/$mirrored" <<<"$inputs"; then programs+=("$program")
    elif grep -q -F -- "$tree/tests/$(dirname -- "$file")/" <<<"$inputs"; then near+=("$program")
    else far+=("$program"); fi
done < <(ninja -C "$build" -t targets all | sed -n 's|^bin/\([a-z0-9_]*_test\): .*|\1|p' | sort)
programs+=("${near[@]}" "${far[@]}")
((${#programs[@]} > 0)) || fail "$file: no test program is made of it"
suites=''
if [[ -f $root/$mirrored ]]; then
    suites=$(sed -n -E 's/^(TEST|TEST_F|TEST_P|TYPED_TEST)\(([A-Za-z0-9_]+),.*/\2.*:*\/\2.*/p' "$root/$mirrored" | sort -u | paste -sd: -)
fi
say "dev mutate: $file is known by ${programs[*]}"

# Compiles what changed and links one program. No fault goes into the compiler's cache.
may_cache=true
make_program() {
    if $may_cache; then ninja -C "$build" "bin/$1" >"$work/build.log" 2>&1
    else CCACHE_DISABLE=1 ninja -C "$build" "bin/$1" >"$work/build.log" 2>&1; fi
}

# run PROGRAM SECONDS FILTER FAULT: 0 when all tests passed; the output is in run.log
run() {
    (cd -- "$build" && KERF_FAULT=$4 timeout --kill-after=5 "$2" "bin/$1" --gtest_fail_fast --gtest_filter="$3") \
        >"$work/run.log" 2>&1 </dev/null
}
failed_test() { sed -n -E 's/^\[ +FAILED +\] ([A-Za-z0-9_/.]+).*/\1/p' "$work/run.log" | head -n 1; }

# Runs a program without a fault once, so that failures count and its time is known [s].
declare -A seconds=()
take_baseline() {   # PROGRAM
    [[ -z ${seconds[$1]:-} ]] || return 0
    say "dev mutate: running $1 without a fault"
    local start=$SECONDS
    run "$1" 1800 '*' 0 || {
        cp -- "$work/run.log" "$work/baseline.log"
        fail "$1 fails without a fault: $(failed_test). See ${work#"$root"/}/baseline.log" 3
    }
    seconds[$1]=$((SECONDS - start + 1))
}

# Runs the tests of a program until one fails, those of the mirrored file first. Sets `outcome` to what noticed.
judge() {   # PROGRAM FAULT
    local allowed=$((seconds[$1] * 3 + 10)) filter status
    local -a filters=('*')
    if [[ -n $suites && $1 == "${programs[0]}" ]]; then filters=("$suites" "-$suites"); fi
    for filter in "${filters[@]}"; do
        status=0
        run "$1" "$allowed" "$filter" "$2" || status=$?
        case $status in
            0) ;;
            124 | 137) outcome="$1 did not end"; return 0 ;;
            *) outcome=$(failed_test); outcome=${outcome:-"$1 ended with status $status"}; return 0 ;;
        esac
    done
    return 1
}

# ---- the table ---------------------------------------------------------------------------------------------------

table=$work/${file//\//.}.txt
: >"$table"
noticed=0 not_noticed=0 equivalent=0 not_built=0
fields() { IFS=$'\t' read -r offset count line change replacement mode _ <<<"${faults[$1]}"; }
text_of() { sed -n "$1{s/^ *//;p}" -- "$root/$file"; }
record() {   # FAULT OUTCOME
    fields "$1"
    case $2 in
        'does not compile') not_built=$((not_built + 1)); return ;;
        'NOT NOTICED') not_noticed=$((not_noticed + 1)) ;;
        *) noticed=$((noticed + 1)) ;;
    esac
    printf '%-5s %-34s %-60s %s\n' "$line" "$change" "$2" "$(text_of "$line")" | tee -a -- "$table"
}

# ---- planting ----------------------------------------------------------------------------------------------------

# A fault may leave variables unused or compare what cannot differ: that is no error here. Lines keep their numbers.
head_of_planted() {   # [choice]
    local warning
    for warning in unused unused-parameter unused-variable unused-but-set-variable unused-but-set-parameter unused-function \
        unused-value parentheses type-limits div-by-zero maybe-uninitialized uninitialized empty-body narrowing \
        misleading-indentation tautological-compare array-bounds return-type switch aggressive-loop-optimizations \
        ignored-qualifiers sign-compare conversion float-conversion dangling-else shadow; do
        printf '#pragma GCC diagnostic ignored "-W%s"\n' "$warning"
    done
    [[ ${1:-} != choice ]] || printf '#include "tests/mutate/choice.h"\n'
    printf '#line 1\n'
}
plant_one() {   # FAULT
    fields "$1"
    {
        head_of_planted
        head -c "$((10#$offset))" -- "$root/$file"
        printf '%s' "$replacement"
        tail -c +"$((10#$offset + count + 1))" -- "$root/$file"
    } >"$work/planted"
    cp -- "$work/planted" "$tree/$file"
}
# Those that find room; the others are named in `crowded`. A constant that a fault may change is no constant expression.
plant_side_by_side() {   # FAULT…
    local fault
    : >"$work/crowded"
    {
        head_of_planted choice
        for fault in "$@"; do printf '%s\t%s\n' "$fault" "${faults[$fault]}"; done |
            awk -v source="$root/$file" -v left="$work/crowded" -f "$here/side_by_side.awk" |
            sed -E '/ = /s/^( *)constexpr double /\1const double /'
    } >"$work/planted"
    cp -- "$work/planted" "$tree/$file"
}
# Lines of this source that the compiler complains of, itself or as the place that a template is used from.
lines_with_errors() {
    grep -E 'error:|required from' "$work/build.log" | grep -o -E "${file//./\\.}:[0-9]+" | sed 's/.*://' | sort -un
}
is_listed() { grep -q -x -F -- "$1" "$2"; }

# Faults that cannot be compiled beside others go to `alone`.
run_side_by_side() {   # FAULT…
    local -a waiting=("$@") placed living kept
    local try fault program wrong
    while ((${#waiting[@]} > 0)); do
        for ((try = 0; try < 8 && ${#waiting[@]} > 0; ++try)); do
            plant_side_by_side "${waiting[@]}"
            make_program "${programs[0]}" && break
            cp -- "$work/build.log" "$work/side_by_side.log"
            lines_with_errors >"$work/wrong" || true
            kept=()
            for fault in "${waiting[@]}"; do
                fields "$fault"
                if is_listed "$fault" "$work/crowded" || { [[ -s $work/wrong ]] && ! is_listed "$line" "$work/wrong"; }; then
                    kept+=("$fault")
                elif [[ $mode == swap ]]; then
                    record "$fault" 'does not compile'   # the two are of different types
                else
                    alone+=("$fault")   # in a constant expression it compiles alone
                fi
            done
            waiting=("${kept[@]}")
        done
        ((${#waiting[@]} > 0)) || return 0
        if ((try == 8)); then
            alone+=("${waiting[@]}")
            return 0
        fi
        placed=() kept=()
        for fault in "${waiting[@]}"; do
            if is_listed "$fault" "$work/crowded"; then kept+=("$fault"); else placed+=("$fault"); fi
        done
        waiting=("${kept[@]}")
        for program in "${programs[@]}"; do
            ((${#placed[@]} > 0)) || break
            make_program "$program" || fail "building $program failed; see ${work#"$root"/}/build.log" 3
            take_baseline "$program"
            living=()
            for fault in "${placed[@]}"; do
                if judge "$program" "$fault"; then record "$fault" "$outcome"; else living+=("$fault"); fi
            done
            placed=("${living[@]}")
        done
        for fault in "${placed[@]}"; do record "$fault" 'NOT NOTICED'; done
    done
}
run_alone() {   # FAULT
    local program
    for program in "${programs[@]}"; do
        if [[ -z ${seconds[$program]:-} ]]; then
            restore
            make_program "$program" || fail "building $program failed; see ${work#"$root"/}/build.log" 3
            take_baseline "$program"
        fi
        plant_one "$1"
        if ! make_program "$program"; then
            record "$1" 'does not compile'
            return
        fi
        if judge "$program" 0; then
            record "$1" "$outcome"
            return
        fi
    done
    record "$1" 'NOT NOTICED'
}

# ---- one after the other -----------------------------------------------------------------------------------------

make_program "${programs[0]}" || fail "building ${programs[0]} failed; see ${work#"$root"/}/build.log" 3
may_cache=false
next=1
while ((next <= ${#faults[@]} && (limit == 0 || noticed + not_noticed < limit))); do
    together=() alone=()
    wanted=$((limit == 0 ? ${#faults[@]} : limit - noticed - not_noticed))
    for (( ; next <= ${#faults[@]} && ${#together[@]} + ${#alone[@]} < wanted; ++next)); do
        fields "$next"
        if is_equivalent "$(text_of "$line")" "$change"; then
            equivalent=$((equivalent + 1))
        elif [[ $mode == - ]]; then
            alone+=("$next")
        else
            together+=("$next")
        fi
    done
    ((${#together[@]} == 0)) || run_side_by_side "${together[@]}"
    for fault in "${alone[@]}"; do run_alone "$fault"; done
done

sort -n -o "$table" -- "$table"
all=$((noticed + not_noticed))
((all > 0)) || fail "$file: none of the faults compiled" 3
printf '%s: %d of %d faults noticed (%d %%); %d did not compile, %d are listed as equivalent; seed %d\n' \
    "$file" "$noticed" "$all" "$((100 * noticed / all))" "$not_built" "$equivalent" "$seed" | tee -a -- "$table"
