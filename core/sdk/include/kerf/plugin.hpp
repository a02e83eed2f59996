// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "kerf/abi.h"
#include "kerf/assert.hpp"
#include "kerf/describe.hpp"
#include "kerf/force.hpp"
#include "kerf/host.hpp"
#include "kerf/law.hpp"
#include "kerf/outline.hpp"

/// Tools and laws of a plugin as plain structs, and KERF_PLUGIN, which exports them. A plugin with a remeshing strategy
/// includes kerf/strategy.hpp too, one with a device kerf/device_driver.hpp.
///
///     a tool: struct whose members are parameters and drives
///         static constexpr auto about();
///         Outline outline() const;
///     a law: struct whose members are parameters
///         static constexpr auto about();
///         void resist(const Held<Tool>&, const BoneQuery&, const State&, Channels&) const noexcept;
///         void commit(const Held<Tool>&, const BoneQuery&, const Advance&, State&, Signals&, Actions&) const noexcept;
///
/// `resist` evaluates the law at the present pose as a few monotone channels. The core then finds the one motion at
/// which hand and law balance. `resist` is pure, and the core may call it again. Notes that it returns reach the commit
/// as `Noted<Notes>::notes`. `commit` takes the solved motion, once for each motion; a fast tick has several motions.
/// Optional: State, Signals, commit, and `void begin(const Held<Tool>&, const BoneQuery&, State&) const noexcept`,
/// which computes values that depend on parameters and resolution alone. begin, resist and commit are
/// [haptic, nonblocking].
///
/// A law that takes any tool with the right parameters names them in a struct with `static constexpr auto needs()`, and
/// takes `Held<ThatStruct>`.
namespace kerf {

template <class T>
concept ToolComponent = requires(const T& tool) {
    T::about();
    { tool.outline() } -> std::same_as<Outline>;
};
template <class T>
concept LawComponent = requires {
    T::about();
    &T::resist;
};

namespace detail {

/// The kind, version and table of a component; `put_into` sets the table. A header for another kind of components
/// specializes it.
template <class T>
struct ComponentTable;

/// Returns the item of type `Item` in the description of `T`, or `otherwise` if it has none.
template <class T, class Item>
constexpr Item find_item(Item otherwise) noexcept {
    std::apply(
        [&](const auto&... item) {
            const auto take = [&](const auto& one) {
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype(one)>, Item>) otherwise = one;
            };
            (take(item), ...);
            static_cast<void>(take);
        },
        Tables<T>::about.items);
    return otherwise;
}

template <ToolComponent Tool>
struct ComponentTable<Tool> {
    static kerf_status shape(const double* params, kerf_tool_shape* out) {
        std::array<double, KERF_MAX_DRIVES> idle{};
        for (std::size_t i = 0; i < Tables<Tool>::drives.size(); ++i) idle[i] = Tables<Tool>::drives[i].def;
        return Tables<Tool>::value(params, idle.data()).outline().write(*out);
    }
    static constexpr Strategies strategies = find_item<Tool>(Strategies{});

    static constexpr std::uint32_t kind = KERF_KIND_TOOL, version = KERF_TOOL_VERSION;
    static constexpr kerf_tool table{.size = sizeof(kerf_tool),
                                     .drive_count = Tables<Tool>::drives.size(),
                                     .drives = first_of(Tables<Tool>::drives),
                                     .strategies = strategies.count > 0 ? strategies.ids : nullptr,
                                     .strategy_count = strategies.count,
                                     .feed = find_item<Tool>(Feed{}).how,
                                     .shape = &shape};
    static constexpr void put_into(kerf_component& component) noexcept { component.tool = &table; }
};

template <LawComponent Law>
struct ComponentTable<Law> {
    using L = LawTable<Law>;
    static constexpr Work max_work = find_item<Law>(Work{});
    static constexpr auto tools = Holding<typename L::Tool>::ids;
    static constexpr auto needs = [] {
        if constexpr (Holding<typename L::Tool>::by_needs)
            return []<class Tool>(std::type_identity<Held<Tool>>) {
                return Tables<Tool>::needs;
            }(std::type_identity<typename L::Tool>{});
        else
            return std::array<kerf_need, 0>{};
    }();
    static constexpr std::uint32_t kind = KERF_KIND_FORCE, version = KERF_FORCE_VERSION;
    static constexpr kerf_force table{.size = sizeof(kerf_force),
                                      .state_size = sizeof(typename L::State),
                                      .state_align = alignof(typename L::State),
                                      .signals = first_of(Tables<Law>::signals),
                                      .signal_count = Tables<Law>::signals.size(),
                                      .events = first_of(Tables<Law>::events),
                                      .event_count = Tables<Law>::events.size(),
                                      .tools = first_of(tools),
                                      .tool_count = tools.size(),
                                      .needs = first_of(needs),
                                      .need_count = needs.size(),
                                      .budget_ns = find_item<Law>(Budget{20000}).ns,
                                      .max_channels = max_work.channels,
                                      .max_points = max_work.points,
                                      .max_queries = max_work.queries,
                                      .does_not = find_item<Law>(DoesNot{}).bits,
                                      .begin = &L::begin,
                                      .resist = &L::resist,
                                      .commit = &L::commit};
    static constexpr void put_into(kerf_component& component) noexcept { component.force = &table; }
};

/// Returns whether an event's id begins with its plugin's name, so that it cannot collide with other plugins' events.
constexpr bool is_own_event(std::string_view event, std::string_view plugin) noexcept {
    const auto is_under = [&](std::string_view name) {
        return event.size() > name.size() + 1 && event.starts_with(name) && event[name.size()] == '.';
    };
    return is_under(plugin) || is_under(plugin.substr(plugin.rfind('.') + 1));
}

}  // namespace detail

/// Returns the C table of a component.
template <class T>
[[nodiscard]] constexpr kerf_component component_of() noexcept {
    using Tables = detail::Tables<T>;
    using Table = detail::ComponentTable<T>;
    kerf_component component{.size = sizeof(kerf_component),
                             .kind = Table::kind,
                             .version = Table::version,
                             .param_count = Tables::params.size(),
                             .feature_count = Tables::features.size(),
                             .reserved = 0,
                             .id = Tables::about.id,
                             .help = Tables::about.help,
                             .params = detail::first_of(Tables::params),
                             .features = detail::first_of(Tables::features),
                             .table = nullptr};
    Table::put_into(component);
    return component;
}

/// Builds the tables of a plugin.
template <class... Components>
struct PluginTables {
    static constexpr std::array<kerf_component, sizeof...(Components)> components{component_of<Components>()...};

    template <class Law>
    static constexpr bool has_its_tools = [] {
        if constexpr (LawComponent<Law>)
            return detail::Holding<typename detail::LawTable<Law>::Tool>::template are_among<Components...>;
        else
            return true;
    }();
    static_assert((has_its_tools<Components> && ...),
                  "a law takes Held<Tool> of a tool that this KERF_PLUGIN does not list");

    /// Returns the checked entry of the plugin `id`.
    [[nodiscard]] static constexpr kerf_entry entry(const char* id, const char* version, const char* licence) {
        detail::check_unique(components_by_kind(KERF_KIND_TOOL));
        detail::check_unique(components_by_kind(KERF_KIND_FORCE));
        detail::check_unique(components_by_kind(KERF_KIND_REMESHER));
        detail::check_unique(components_by_kind(KERF_KIND_DEVICE));
        (check_events<Components>(id), ...);
        return {.magic = KERF_MAGIC,
                .abi = KERF_ABI_VERSION,
                .size = sizeof(kerf_entry),
                .component_count = sizeof...(Components),
                .layout = KERF_LAYOUT_INIT,
                .plugin_id = id,
                .plugin_version = version,
                .licence = licence,
                .toolchain = __VERSION__,
                .components = components.data(),
                .open = &detail::open_plugin};
    }

private:
    struct Name {
        const char* id;
    };
    /// Returns one name for each component: its id if it is of this kind, else a unique text that no id can equal.
    static constexpr auto components_by_kind(std::uint32_t kind) {
        constexpr const char* others[] = {"#0", "#1", "#2",  "#3",  "#4",  "#5",  "#6",  "#7",
                                          "#8", "#9", "#10", "#11", "#12", "#13", "#14", "#15"};
        static_assert(sizeof...(Components) <= 16, "a plugin has at most 16 components");
        std::array<Name, sizeof...(Components)> names{};
        for (std::size_t i = 0; i < names.size(); ++i)
            names[i].id = components[i].kind == kind ? components[i].id : others[i];
        return names;
    }
    template <class T>
    static constexpr void check_events(std::string_view plugin) {
        for (const kerf_event& e : detail::Tables<T>::events)
            if (!detail::is_own_event(e.id, plugin))
                throw "an event does not begin with the name of its plugin and a dot";
    }
};

/// Returns a component with these parameters and drives, in the order of its description. Drives that are left out
/// have their defaults.   [any]
template <class T>
[[nodiscard]] T value_of(std::span<const double> params, std::span<const double> drives = {}) noexcept {
    using Tables = detail::Tables<T>;
    KERF_ASSERT(params.size() == Tables::params.size(), "give one value for each parameter that is described");
    std::array<double, KERF_MAX_DRIVES> drive{};
    for (std::size_t i = 0; i < Tables::drives.size(); ++i)
        drive[i] = i < drives.size() ? drives[i] : Tables::drives[i].def;
    return Tables::value(params.data(), drive.data());
}
/// Returns a component with its defaults.   [any]
template <class T>
[[nodiscard]] T defaults_of() noexcept {
    using Tables = detail::Tables<T>;
    std::array<double, Tables::params.size() + 1> values{};
    for (std::size_t i = 0; i < Tables::params.size(); ++i) values[i] = Tables::params[i].def;
    return value_of<T>({values.data(), Tables::params.size()});
}
/// Returns the signals of a law from the values that its commit wrote.   [any]
template <class Law>
[[nodiscard]] typename Law::Signals signals_of(const double* values) noexcept {
    typename Law::Signals signals{};
    std::size_t at = 0;
    std::apply(
        [&](const auto&... item) {
            const auto read = [&](const auto& one) {
                if constexpr (detail::is_a<std::remove_cvref_t<decltype(one)>, Signal>::value)
                    signals.*one.member = values[at++];
            };
            (read(item), ...);
            static_cast<void>(read);
        },
        detail::Tables<Law>::about.items);
    return signals;
}

template <class Law>
[[nodiscard]] typename Law::Signals signals_of(std::span<const double> values) noexcept {
    return signals_of<Law>(values.data());
}

}  // namespace kerf

/// Exports the plugin with its tools, laws and strategies. Use it once in a shared library, outside of all namespaces:
///
///     KERF_PLUGIN("example.awl", "0.1.0", "Apache-2.0", Awl, Press)
#define KERF_PLUGIN(id, version, licence, ...)                                            \
    extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry; \
    extern "C" constinit const kerf_entry kerf_plugin_entry =                             \
        ::kerf::PluginTables<__VA_ARGS__>::entry(id, version, licence);
