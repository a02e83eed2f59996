// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "kerf/abi.h"
#include "kerf/units.hpp"

/// Descriptions of tools and laws: one line per member, checked when it is compiled.
///
///     struct Awl {
///         double diameter;
///         static constexpr auto about() {
///             return describe("awl", "A round awl.",
///                 param(&Awl::diameter, {.id = "diameter", .help = "Diameter of the shaft.", .unit = unit::mm,
///                                        .min = 1_mm, .max = 10_mm, .def = 4_mm, .source = "assumed"}));
///         }
///     };
///
/// The compiler stops at a `throw` below, whose text names the mistake.
namespace kerf {

/// A bound or a default: a number with its unit (`3.2_mm`), or a plain number where there is no unit.
struct Amount {
    double si;
    kerf_dimension dimension;

    constexpr Amount(Quantity quantity) noexcept : si(quantity.si), dimension(quantity.dimension) {}
    constexpr Amount(double plain) noexcept : si(plain), dimension(dimension::none) {}
};

// ---- texts that describe parameters, drives, signals, events, features and needs --------------------------------

struct ParamText {
    const char* id;    ///< snake_case, unique within the component
    const char* help;  ///< one sentence
    DisplayUnit unit = unit::none;
    Amount min, max, def;
    const char* source;  ///< origin of the default, and whether it is calibrated or assumed
};
struct DriveText {
    const char* id;
    const char* help;
    DisplayUnit unit = unit::none;
    Amount min, max, def;
    Amount least = 0.0;  ///< magnitude below which the tool runs but does not cut; 0: no such limit
};
struct SignalText {
    const char* id;
    const char* help;
    DisplayUnit unit = unit::none;
};
struct EventText {
    const char* id;  ///< "<plugin>.<name>", where <plugin> is the plugin's id or the part of it after its last dot
    const char* help;
    bool is_damage = false;  ///< the event damages the tool: the step fails, unless the procedure allows it
};
struct FeatureText {
    const char* id;    ///< parameters with the same id are one feature and are switched together
    const char* help;  ///< one sentence: the effect of the feature
    Amount off = 0.0;  ///< value of the parameter that switches the feature off
};
struct NeedText {
    const char* id;
    const char* help;
    DisplayUnit unit = unit::none;
};

// ---- members with their texts -----------------------------------------------------------------------------------

template <class T>
struct Param {
    double T::*member;
    double& (*access)(T&);  ///< used for an element of an array, where `member` is null
    ParamText text;
};
template <class T>
struct Drive {
    double T::*member;
    DriveText text;
};
template <class S>
struct Signal {
    double S::*member;
    SignalText text;
};
template <class E>
struct Event {
    E which;
    EventText text;
};
template <class T>
struct Feature {
    double T::*member;
    std::uint32_t kind;
    FeatureText text;
};
template <class T>
struct Need {
    double T::*member;
    std::uint32_t kind;
    NeedText text;
};
struct Budget {
    std::uint32_t ns;
};
/// Maximum work of one evaluation of a law, for any parameters; 0: not declared. `kerf check` counts it.
struct Work {
    std::uint32_t channels = 0;
    std::uint32_t points = 0;   ///< of all its queries together
    std::uint32_t queries = 0;  ///< of the bone
};
/// What a law leaves out on purpose.
struct DoesNot {
    std::uint32_t bits = 0;  ///< KERF_DOES_NOT_…
};
/// Remeshing strategies that suit the cut of a tool.
struct Strategies {
    static constexpr std::size_t max_count = 8;
    const char* ids[max_count] = {};
    std::uint32_t count = 0;
};
/// The direction in which a hand feeds a tool: KERF_FEED_….
struct Feed {
    std::uint32_t how = KERF_FEED_AXIS;
};
/// Input of a remeshing strategy, and the versions on which its results depend (kerf/strategy.hpp).
struct Remeshes {
    std::uint32_t scope = 0;  ///< KERF_REMESH_PATCH or KERF_REMESH_WHOLE
    const char* kernel = "";
};
template <class... Items>
struct Group {
    std::tuple<Items...> items;
};

/// Describes a parameter: a member that the procedure sets before the operation.
template <class T>
[[nodiscard]] constexpr Param<T> param(double T::*member, ParamText text) noexcept {
    return {member, nullptr, text};
}
/// Describes a parameter that is not a member itself: `access` returns a reference to its value.
template <class T>
[[nodiscard]] constexpr Param<T> param(double& (*access)(T&), ParamText text) noexcept {
    return {nullptr, access, text};
}
/// Describes a drive of a tool: a member that the trigger or the procedure sets while the tool is used.
template <class T>
[[nodiscard]] constexpr Drive<T> drive(double T::*member, DriveText text) noexcept {
    return {member, text};
}
/// Describes a signal of a law: a quantity that the law reports each tick.
template <class S>
[[nodiscard]] constexpr Signal<S> signal(double S::*member, SignalText text) noexcept {
    return {member, text};
}
/// Describes an event of a law. The values of the enumeration count from 0, and the events are described in that order.
template <class E>
[[nodiscard]] constexpr Event<E> event(E which, EventText text) noexcept {
    return {which, text};
}
/// Describes an effect that a planner may leave out by setting the parameter to `off`.
template <class T>
[[nodiscard]] constexpr Feature<T> effect(double T::*member, FeatureText text) noexcept {
    return {member, KERF_FEATURE_EFFECT, text};
}
/// Describes a parameter that is a resolution: coarser and cheaper towards `off`.
template <class T>
[[nodiscard]] constexpr Feature<T> resolution(double T::*member, FeatureText text) noexcept {
    return {member, KERF_FEATURE_RESOLUTION, text};
}
/// Describes a parameter that a law needs of any tool that it is used with.
template <class T>
[[nodiscard]] constexpr Need<T> need(double T::*member, NeedText text) noexcept {
    return {member, KERF_NEED_PARAM, text};
}
/// Describes a drive that a law needs of any tool that it is used with.
template <class T>
[[nodiscard]] constexpr Need<T> need_drive(double T::*member, NeedText text) noexcept {
    return {member, KERF_NEED_DRIVE, text};
}
/// States the maximum time of one evaluation of a law. Default: 20 µs.
[[nodiscard]] constexpr Budget budget_us(std::uint32_t microseconds) noexcept { return {1000 * microseconds}; }
/// States the maximum work of one evaluation of a law. `kerf check` prints the numbers to write.
[[nodiscard]] constexpr Work work(Work max_work) noexcept { return max_work; }
/// States what a law leaves out on purpose: the sum of KERF_DOES_NOT_…. `kerf check` skips the tests of that, and the
/// plugin's badge shows it.
[[nodiscard]] constexpr DoesNot does_not(std::uint32_t bits) noexcept { return {bits}; }
/// States the remeshing strategies that suit the cut of a tool, by full id: best first, the one of highest accuracy
/// last. The host tries the next one where a strategy is not installed or declines a cut.
template <class... Id>
[[nodiscard]] constexpr Strategies strategies(Id... id) {
    static_assert(sizeof...(Id) <= Strategies::max_count, "a tool names at most 8 strategies");
    for (const std::string_view one : {std::string_view(id)...})
        if (one.find('.') == one.npos) throw "a strategy needs its full id, as \"example.burring.groove\"";
    return {{id...}, sizeof...(Id)};
}
/// States that a tool is fed across its axis, towards its +x: a file. Default: along its axis, tip first.
[[nodiscard]] constexpr Feed fed_sideways() noexcept { return {KERF_FEED_SIDE}; }
/// States that a tool is fed by turning it: a screw, a tap.
[[nodiscard]] constexpr Feed fed_by_turning() noexcept { return {KERF_FEED_TURN}; }
/// Joins descriptions that several components have in common.
template <class... Items>
[[nodiscard]] constexpr Group<Items...> group(Items... items) noexcept {
    return {{items...}};
}

namespace detail {
template <class Item>
constexpr auto flat(const Item& item) noexcept {
    return std::tuple<Item>(item);
}
template <class... Items>
constexpr auto flat(const Group<Items...>& group) noexcept {
    return std::apply([](const auto&... item) { return std::tuple_cat(flat(item)...); }, group.items);
}
}  // namespace detail

template <class Items>
struct Description {
    const char* id;
    const char* help;
    Items items;
};

/// Describes a component: its id, one sentence of help, and its parameters, drives, signals, events and features.
template <class... Items>
[[nodiscard]] constexpr auto describe(const char* id, const char* help, const Items&... items) noexcept {
    auto all = std::tuple_cat(detail::flat(items)...);
    return Description<decltype(all)>{id, help, all};
}
/// Describes the needs of a law that takes any tool: `static constexpr auto needs()` of the struct in its Held<…>.
template <class... Items>
[[nodiscard]] constexpr auto describe_needs(const Items&... items) noexcept {
    return describe("", "", items...);
}

// ---- from descriptions to the C tables --------------------------------------------------------------------------

namespace detail {

template <class Item, template <class> class Kind>
struct is_a : std::false_type {};
template <class T, template <class> class Kind>
struct is_a<Kind<T>, Kind> : std::true_type {};

/// Returns the items of one kind, each converted to an `Out` by `convert`.
template <template <class> class Kind, class Out, class Items, class Convert>
constexpr auto collect(const Items& items, Convert convert) {
    constexpr std::size_t count = []<class... I>(std::type_identity<std::tuple<I...>>) {
        return (std::size_t{0} + ... + (is_a<I, Kind>::value ? 1u : 0u));
    }(std::type_identity<Items>{});
    std::array<Out, count> out{};
    std::apply(
        [&](const auto&... item) {
            std::size_t at = 0;
            const auto take = [&](const auto& one) {
                if constexpr (is_a<std::remove_cvref_t<decltype(one)>, Kind>::value) out[at++] = convert(one);
            };
            (take(item), ...);
            static_cast<void>(at), static_cast<void>(take);
        },
        items);
    return out;
}

constexpr bool is_same_text(const char* a, const char* b) noexcept { return std::string_view(a) == b; }

constexpr void check_text(const char* id, const char* help) {
    if (id == nullptr || *id == '\0') throw "an id is missing: write .id = \"…\"";
    if (help == nullptr || *help == '\0') throw "a help text is missing: write .help = \"…\"";
    for (const char* c = id; *c != '\0'; ++c)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') || *c == '_' || *c == '.' || *c == '-'))
            throw "an id has other characters than a-z, 0-9, _, - and .";
}
constexpr void check_amount(Amount amount, DisplayUnit unit) {
    if (amount.si != 0.0 && !(amount.dimension == unit.dimension))
        throw "a bound or default has another dimension than its unit";
}
template <class Text>
constexpr void check_range(const Text& text) {
    check_text(text.id, text.help);
    check_amount(text.min, text.unit);
    check_amount(text.max, text.unit);
    check_amount(text.def, text.unit);
    if (!(text.min.si <= text.def.si && text.def.si <= text.max.si)) throw "a default lies outside its range";
}
constexpr void check_drive(const DriveText& text) {
    check_range(text);
    check_amount(text.least, text.unit);
    const double fastest = text.max.si > -text.min.si ? text.max.si : -text.min.si;
    if (!(text.least.si >= 0.0 && text.least.si <= fastest))
        throw "`least` of a drive lies outside its range: the tool would never cut";
}
template <class Table>
constexpr void check_unique(const Table& table) {
    for (std::size_t i = 0; i < table.size(); ++i)
        for (std::size_t j = i + 1; j < table.size(); ++j)
            if (is_same_text(table[i].id, table[j].id)) throw "two ids are equal";
}

/// Access to a parameter or drive that `T` or a base of `T` declares: by `member`, or by `access` if that is null.
template <class T>
struct ParamAccess {
    double T::*member = nullptr;
    double& (*access)(T&) = nullptr;
};
template <class T, class B>
constexpr ParamAccess<T> access_of(const Param<B>& p) noexcept {
    if constexpr (std::is_same_v<T, B>)
        return {p.member, p.access};
    else
        return {p.member, nullptr};
}

template <class T>
concept Needs = requires {
    T::needs();
};

/// The C tables of one component or of one set of needs.
template <class T>
struct Tables {
    static constexpr auto about = [] {
        if constexpr (Needs<T>)
            return T::needs();
        else
            return T::about();
    }();

    static constexpr auto param_access =
        collect<Param, ParamAccess<T>>(about.items, [](const auto& p) { return access_of<T>(p); });
    static constexpr auto params = collect<Param, kerf_param>(about.items, [](const auto& p) {
        check_range(p.text);
        if (p.text.source == nullptr || *p.text.source == '\0') throw "a source is missing: write .source = \"…\"";
        if (p.member == nullptr && p.access == nullptr) throw "a parameter has no member";
        return kerf_param{.id = p.text.id,
                          .help = p.text.help,
                          .dimension = p.text.unit.dimension,
                          .display_unit = p.text.unit.name,
                          .min = p.text.min.si,
                          .max = p.text.max.si,
                          .def = p.text.def.si,
                          .source = p.text.source};
    });
    static constexpr auto drive_access = collect<Drive, ParamAccess<T>>(about.items, [](const auto& d) {
        return ParamAccess<T>{d.member, nullptr};
    });
    static constexpr auto drives = collect<Drive, kerf_drive>(about.items, [](const auto& d) {
        check_drive(d.text);
        return kerf_drive{.id = d.text.id,
                          .help = d.text.help,
                          .dimension = d.text.unit.dimension,
                          .display_unit = d.text.unit.name,
                          .min = d.text.min.si,
                          .max = d.text.max.si,
                          .def = d.text.def.si,
                          .least = d.text.least.si};
    });
    static constexpr auto signals = collect<Signal, kerf_signal>(about.items, [](const auto& s) {
        check_text(s.text.id, s.text.help);
        return kerf_signal{
            .id = s.text.id, .help = s.text.help, .dimension = s.text.unit.dimension, .display_unit = s.text.unit.name};
    });
    static constexpr auto events = [] {
        auto table = collect<Event, kerf_event>(about.items, [](const auto& e) {
            check_text(e.text.id, e.text.help);
            const std::uint32_t effect = e.text.is_damage ? KERF_EVENT_DAMAGE : KERF_EVENT_NOTE;
            return kerf_event{.id = e.text.id, .help = e.text.help, .effect = effect, .reserved = 0};
        });
        const auto numbers =
            collect<Event, std::size_t>(about.items, [](const auto& e) { return static_cast<std::size_t>(e.which); });
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (numbers[i] != i) throw "events are missing or not in the order of their enumeration";
        return table;
    }();
    static constexpr auto features = collect<Feature, kerf_feature>(about.items, [](const auto& f) {
        check_text(f.text.id, f.text.help);
        for (std::size_t i = 0; i < param_access.size(); ++i) {
            if (param_access[i].member != static_cast<double T::*>(f.member)) continue;
            if (f.text.off.si != 0.0 && !(f.text.off.dimension == params[i].dimension))
                throw "`off` of a feature has another dimension than its parameter";
            if (!(params[i].min <= f.text.off.si && f.text.off.si <= params[i].max))
                throw "`off` of a feature lies outside the range of its parameter";
            return kerf_feature{.id = f.text.id,
                                .help = f.text.help,
                                .kind = f.kind,
                                .param = static_cast<std::uint32_t>(i),
                                .off = f.text.off.si};
        }
        throw "a feature names a member that is not a parameter of this component";
    });
    static constexpr auto needs = collect<Need, kerf_need>(about.items, [](const auto& n) {
        check_text(n.text.id, n.text.help);
        return kerf_need{.id = n.text.id, .help = n.text.help, .dimension = n.text.unit.dimension, .kind = n.kind};
    });
    static constexpr auto need_access = collect<Need, ParamAccess<T>>(about.items, [](const auto& n) {
        return ParamAccess<T>{n.member, nullptr};
    });

    static constexpr bool are_sound = [] {
        check_unique(params);
        check_unique(drives);
        check_unique(signals);
        check_unique(events);
        if (drives.size() > KERF_MAX_DRIVES) throw "a tool has more drives than KERF_MAX_DRIVES";
        if (signals.size() > KERF_MAX_SIGNALS) throw "a law has more signals than KERF_MAX_SIGNALS";
        return true;
    }();
    static_assert(are_sound);

    /// Returns a `T` with these values of its parameters and drives.   [haptic, nonblocking]
    [[nodiscard]] static T value(const double* param, const double* drive) noexcept {
        T value{};
        put<param_access>(value, [&](std::size_t i) { return param[i]; });
        put<drive_access>(value, [&](std::size_t i) { return drive[i]; });
        return value;
    }
    /// Returns a set of needs with the values of the parameters and drives of the held tool.   [haptic, nonblocking]
    [[nodiscard]] static T value(const kerf_tick_in& in) noexcept {
        T value{};
        put<need_access>(value, [&](std::size_t i) {
            return needs[i].kind == KERF_NEED_PARAM ? in.tool_params[in.bound[i]] : in.drive[in.bound[i]];
        });
        return value;
    }

private:
    template <const auto& table, class From>
    static void put(T& value, From from) noexcept {
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            const auto put_one = [&]<std::size_t i>(std::integral_constant<std::size_t, i>) {
                if constexpr (table[i].member != nullptr)
                    value.*table[i].member = from(i);
                else
                    table[i].access(value) = from(i);
            };
            (put_one(std::integral_constant<std::size_t, I>{}), ...);
            static_cast<void>(put_one);
        }
        (std::make_index_sequence<table.size()>{});
    }
};

/// Returns the address of the first element; null for an empty table.
template <class Table>
constexpr auto first_of(const Table& table) noexcept -> decltype(table.data()) {
    if constexpr (std::tuple_size_v<Table> == 0)
        return nullptr;
    else
        return table.data();
}

}  // namespace detail

}  // namespace kerf
