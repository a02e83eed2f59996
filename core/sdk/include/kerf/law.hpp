// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>
#include <variant>

#include "kerf/describe.hpp"
#include "kerf/force.hpp"

namespace kerf {

/// The held tool as a law gets it: its parameters and drives as members, and the tick.
template <class... Tools>
struct Held;
template <class Tool>
struct Held<Tool> : Tool {
    Tick tick;
};
/// The held tool of a law that takes several tools of its plugin.
template <class First, class Second, class... Rest>
struct Held<First, Second, Rest...> {
    Tick tick;
    std::variant<First, Second, Rest...> tool;

    template <class Tool>
    [[nodiscard]] bool is() const noexcept {
        return std::holds_alternative<Tool>(tool);
    }
    /// Returns the held tool as `Base`, from which all the tools must derive.
    template <class Base>
    [[nodiscard]] const Base& as() const noexcept {
        return visit([](const auto& held) -> const Base& { return held; });
    }
    /// Returns the result of `function`, called with the held tool.
    template <class Function>
    decltype(auto) visit(Function function) const noexcept {
        return visit_from<0>(function);
    }

private:
    template <std::size_t i, class Function>
    decltype(auto) visit_from(Function& function) const noexcept {
        if constexpr (i + 1 == 2 + sizeof...(Rest)) {
            return function(*std::get_if<i>(&tool));
        } else {
            if (tool.index() == i) return function(*std::get_if<i>(&tool));
            return visit_from<i + 1>(function);
        }
    }
};

/// The tool of a law that accepts any tool and reads none of its parameters: Held<AnyTool>.
struct AnyTool {
    static constexpr auto needs() noexcept { return describe_needs(); }
};

namespace detail {

struct NoState {};
struct NoNotes {};
struct NoSignals {};

template <class Resist>
struct ResistForm {
    static_assert(!std::is_same_v<Resist, Resist>,
                  "write `void resist(const Held<Tool>&, const BoneQuery&, const State&, Channels&) const noexcept`; "
                  "it may return notes for its commit, and a law without State leaves that argument out");
};
template <class L, class R, class H, class S>
struct ResistForm<R (L::*)(const H&, const BoneQuery&, const S&, Channels&) const noexcept> {
    using Tool = H;
    using State = S;
    using Notes = std::conditional_t<std::is_void_v<R>, NoNotes, R>;
    static constexpr bool returns_notes = !std::is_void_v<R>;
};
template <class L, class R, class H>
struct ResistForm<R (L::*)(const H&, const BoneQuery&, Channels&) const noexcept> {
    using Tool = H;
    using State = NoState;
    using Notes = std::conditional_t<std::is_void_v<R>, NoNotes, R>;
    static constexpr bool returns_notes = !std::is_void_v<R>;
};

template <class Law>
struct SignalsOf {
    using type = NoSignals;
};
template <class Law>
requires requires { typename Law::Signals; }
struct SignalsOf<Law> {
    using type = typename Law::Signals;
};

template <class H>
struct Holding;
template <class Tool>
struct Holding<Held<Tool>> {
    static constexpr bool by_needs = Needs<Tool>;
    static constexpr auto ids = [] {
        if constexpr (by_needs)
            return std::array<const char*, 0>{};
        else
            return std::array<const char*, 1>{Tables<Tool>::about.id};
    }();
    [[nodiscard]] static Held<Tool> held(const kerf_tick_in& in, const Tick& tick) noexcept {
        if constexpr (by_needs)
            return {Tables<Tool>::value(in), tick};
        else
            return {Tables<Tool>::value(in.tool_params, in.drive), tick};
    }
    template <class... Components>
    static constexpr bool are_among = by_needs || (std::is_same_v<Tool, Components> || ...);
};
template <class First, class Second, class... Rest>
struct Holding<Held<First, Second, Rest...>> {
    static constexpr bool by_needs = false;
    static constexpr std::array<const char*, 2 + sizeof...(Rest)> ids{Tables<First>::about.id, Tables<Second>::about.id,
                                                                      Tables<Rest>::about.id...};
    using Result = Held<First, Second, Rest...>;
    [[nodiscard]] static Result held(const kerf_tick_in& in, const Tick& tick) noexcept {
        Result result{tick, First{}};
        pick<0, First, Second, Rest...>(in, result);
        return result;
    }
    template <class... Components>
    static constexpr bool is_among(auto* tool) noexcept {
        return (std::is_same_v<decltype(tool), Components*> || ...);
    }
    template <class... Components>
    static constexpr bool are_among = is_among<Components...>(static_cast<First*>(nullptr)) &&
                                      is_among<Components...>(static_cast<Second*>(nullptr)) &&
                                      (is_among<Components...>(static_cast<Rest*>(nullptr)) && ...);

private:
    template <std::size_t i, class Tool, class... Others>
    static void pick(const kerf_tick_in& in, Result& result) noexcept {
        if (in.tool == i)
            result.tool.template emplace<i>(Tables<Tool>::value(in.tool_params, in.drive));
        else if constexpr (sizeof...(Others) > 0)
            pick<i + 1, Others...>(in, result);
    }
};

/// Builds the C table of a law.
template <class Law>
struct LawTable {
    using Form = ResistForm<decltype(&Law::resist)>;
    using Tool = typename Form::Tool;
    using State = typename Form::State;
    using Notes = typename Form::Notes;
    using Signals = typename SignalsOf<Law>::type;
    static constexpr bool has_state = !std::is_same_v<State, NoState>,
                          has_signals = !std::is_same_v<Signals, NoSignals>;
    static_assert(std::is_trivially_copyable_v<State>,
                  "the host saves, restores and moves a State: keep it trivially copyable");
    static_assert(std::is_default_constructible_v<State>, "a law begins with a State{}");

    static Tick tick_of(const kerf_tick_in& in) noexcept {
        Tick tick{.dt = in.dt, .number = in.tick, .hand = in.hand, .outline = {}};
        if (in.outline != nullptr) tick.outline = {in.outline->profile, in.outline->profile_count};
        return tick;
    }
    static Law law_of(const kerf_tick_in& in) noexcept { return Tables<Law>::value(in.force_params, nullptr); }
    static Tool tool_of(const kerf_tick_in& in) noexcept { return Holding<Tool>::held(in, tick_of(in)); }

    static void begin(const kerf_tick_in* in, void* state) {
        State& fresh = *new (state) State{};
        if constexpr (requires { &Law::begin; }) {
            const Law law = law_of(*in);
            const Tool tool = tool_of(*in);
            static_assert(noexcept(law.begin(tool, BoneQuery(*in->bone), fresh)), "begin must be noexcept");
            law.begin(tool, BoneQuery(*in->bone), fresh);
        }
    }
    static kerf_status resist(const kerf_tick_in* in, const void* state, kerf_law* out) {
        Channels channels(*out);
        const Law law = law_of(*in);
        const Tool tool = tool_of(*in);
        const BoneQuery bone(*in->bone);
        const auto call = [&] {
            if constexpr (has_state)
                return law.resist(tool, bone, *static_cast<const State*>(state), channels);
            else
                return law.resist(tool, bone, channels);
        };
        if constexpr (Form::returns_notes) {
            const Notes notes = call();
            std::memcpy(out->note, &notes, sizeof notes);
        } else {
            call();
        }
        return channels.dropped() == 0 ? KERF_OK : KERF_CAPACITY;
    }
    static kerf_status commit(const kerf_tick_in* in, const kerf_advance* a, void* state, kerf_commit_out* out) {
        Actions actions(*out);
        Signals signals{};
        if constexpr (requires { &Law::commit; }) {
            Noted<Notes> advance;
            advance.channel = {a->channel, a->channel_count};
            advance.lambda = {a->lambda, a->channel_count};
            std::copy_n(a->rate, 6, advance.rate.begin());
            std::copy_n(a->following, 6, advance.following.begin());
            advance.has_law = a->note != nullptr;
            if (Form::returns_notes && a->note != nullptr) std::memcpy(&advance.notes, a->note, sizeof advance.notes);
            const Law law = law_of(*in);
            const Tool tool = tool_of(*in);
            const BoneQuery bone(*in->bone);
            if constexpr (has_signals) {
                static_assert(noexcept(law.commit(tool, bone, advance, *static_cast<State*>(state), signals, actions)),
                              "commit must be noexcept");
                law.commit(tool, bone, advance, *static_cast<State*>(state), signals, actions);
            } else {
                static_assert(noexcept(law.commit(tool, bone, advance, *static_cast<State*>(state), actions)),
                              "commit must be noexcept");
                law.commit(tool, bone, advance, *static_cast<State*>(state), actions);
            }
        }
        [&]<class... S>(const std::tuple<S...>& items) {
            std::size_t at = 0;
            std::apply([&](const auto&... item) { (write(item, signals, out->signal, at), ...); }, items);
            static_cast<void>(at);
        }(Tables<Law>::about.items);
        return KERF_OK;
    }

private:
    template <class Item>
    static void write(const Item& item, const Signals& signals, double* out, std::size_t& at) noexcept {
        if constexpr (is_a<Item, Signal>::value) out[at++] = signals.*item.member;
    }
};

}  // namespace detail

}  // namespace kerf
