// SPDX-License-Identifier: Apache-2.0
// Faults that are compiled in side by side; KERF_FAULT names the one that acts. Put before a source by mutate.sh, and
// part of no other build. Without KERF_FAULT all of them do what was written.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <initializer_list>

namespace kerf_fault {

inline int chosen() noexcept {
    const char* text = std::getenv("KERF_FAULT");
    return text != nullptr ? std::atoi(text) : 0;
}
inline const int fault = chosen();
inline bool is_on(int id) noexcept { return fault == id; }

template <int id, class T>
T choose(T as_written, T other) noexcept {
    return is_on(id) ? other : as_written;
}

// An operator in two halves: `a < Less<1>{} > b`. The first half keeps the left operand.
template <class Op, class L>
struct Half {
    const L& left;
};

#define KERF_FAULT_INFIX(Name, first, second, written, other)                                    \
    template <int id>                                                                            \
    struct Name {};                                                                              \
    template <int id, class L>                                                                   \
    constexpr Half<Name<id>, L> operator first(const L& left, Name<id>) noexcept {               \
        return {left};                                                                           \
    }                                                                                            \
    template <int id, class L, class R>                                                          \
    requires requires(const L& l, const R& r) { l other r; }                                     \
    auto operator second(Half<Name<id>, L> half, const R& right) noexcept {                      \
        using Result = decltype(half.left written right);                                        \
        return is_on(id) ? static_cast<Result>(half.left other right) : half.left written right; \
    }

KERF_FAULT_INFIX(Less, <, <, <, <=)
KERF_FAULT_INFIX(AtMost, <=, <=, <=, <)
KERF_FAULT_INFIX(Greater, >, >, >, >=)
KERF_FAULT_INFIX(AtLeast, >=, >=, >=, >)
KERF_FAULT_INFIX(Equal, ==, ==, ==, !=)
KERF_FAULT_INFIX(Unequal, !=, !=, !=, ==)
KERF_FAULT_INFIX(Plus, +, +, +, -)
KERF_FAULT_INFIX(Minus, -, -, -, +)
KERF_FAULT_INFIX(Times, *, *, *, /)
KERF_FAULT_INFIX(Over, /, /, /, *)
#undef KERF_FAULT_INFIX

// `a += Add<1>{} += b`: assignments bind from the right.
#define KERF_FAULT_ASSIGN(Name, op, other)                          \
    template <class R>                                              \
    struct Name##Right {                                            \
        const R& right;                                             \
        bool is_on;                                                 \
    };                                                              \
    template <int id>                                               \
    struct Name {                                                   \
        template <class R>                                          \
        Name##Right<R> operator op(const R& right) const noexcept { \
            return {right, kerf_fault::is_on(id)};                  \
        }                                                           \
    };                                                              \
    template <class L, class R>                                     \
    requires requires(L & l, const R& r) { l other r; }             \
    L& operator op(L& left, Name##Right<R> half) noexcept {         \
        if (half.is_on)                                             \
            left other half.right;                                  \
        else                                                        \
            left op half.right;                                     \
        return left;                                                \
    }

KERF_FAULT_ASSIGN(Add, +=, -=)
KERF_FAULT_ASSIGN(Subtract, -=, +=)
KERF_FAULT_ASSIGN(Multiply, *=, /=)
KERF_FAULT_ASSIGN(Divide, /=, *=)
#undef KERF_FAULT_ASSIGN

template <int id>
struct Negative {};
template <int id, class T>
auto operator*(Negative<id>, const T& value) noexcept -> decltype(-value) {
    using Result = decltype(-value);
    return is_on(id) ? static_cast<Result>(value) : -value;
}

template <int id>
struct Not {};
template <int id, class T>
bool operator*(Not<id>, const T& value) noexcept {
    return is_on(id) ? static_cast<bool>(value) : !value;
}

template <int id>
struct Min {
    template <class T>
    T operator()(const T& a, const T& b) const noexcept {
        return is_on(id) ? std::max(a, b) : std::min(a, b);
    }
    template <class T>
    T operator()(std::initializer_list<T> all) const noexcept {
        return is_on(id) ? std::max(all) : std::min(all);
    }
};
template <int id>
struct Max {
    template <class T>
    T operator()(const T& a, const T& b) const noexcept {
        return is_on(id) ? std::min(a, b) : std::max(a, b);
    }
    template <class T>
    T operator()(std::initializer_list<T> all) const noexcept {
        return is_on(id) ? std::min(all) : std::max(all);
    }
};

}  // namespace kerf_fault
