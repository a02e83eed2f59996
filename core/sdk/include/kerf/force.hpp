// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

#include "kerf/abi.h"
#include "kerf/math.hpp"
#include "kerf/sampled_wall.hpp"

/// The C++ face of a force component: write a plain struct, get the C table.
namespace kerf {

/// One tick as a force law sees it.
struct Tick {
    double dt;                      ///< [s]
    std::span<const double> tool;   ///< parameters of the tool that is held, declared order, SI
    std::span<const double> force;  ///< force parameters, declared order, SI
    std::span<const double> drive;  ///< commanded drive values, declared order, SI
};

/// Batch questions to the bone, tool frame.   [haptic, nonblocking]
class BoneQuery {
public:
    explicit BoneQuery(const kerf_bone_query& query) noexcept : query_(&query) {}
    /// @param direction  unit; the gap is measured along it
    void sample(std::span<const Vec3> points, Vec3 direction, std::span<kerf_bone_sample> out) const noexcept {
        sample(points, std::span<const Vec3>(&direction, 1), out);
    }
    /// @param directions  one for all points, or one for each. One question of many points is cheaper than many
    void sample(std::span<const Vec3> points, std::span<const Vec3> directions,
                std::span<kerf_bone_sample> out) const noexcept {
        query_->sample(query_->bone, points.data(), static_cast<std::uint32_t>(points.size()), directions.data(),
                       static_cast<std::uint32_t>(directions.size()), out.data());
    }
    void nearest(std::span<const Vec3> points, std::span<kerf_surface_point> out) const noexcept {
        query_->nearest(query_->bone, points.data(), static_cast<std::uint32_t>(points.size()), out.data());
    }
    [[nodiscard]] std::uint32_t tissue_count() const noexcept { return query_->tissue_count; }
    /// [m] distances are known as far as this on either side of a surface
    [[nodiscard]] double reach() const noexcept { return query_->reach; }
    [[nodiscard]] double voxel() const noexcept { return 0.25 * reach(); }  ///< [m] between the samples of its grid
    /// [m] a cut's wall may stand so far from where the tool went (B5).
    [[nodiscard]] double wall_error() const noexcept { return 0.1 * voxel(); }
    /// The same of a hole of `radius` [m].
    [[nodiscard]] double wall_error(double radius) const noexcept {
        return wall_error() + wall_sagitta(radius, voxel());
    }

private:
    const kerf_bone_query* query_;
};

/// Where a law writes its channels. Too many are dropped and counted, never written past the end.
class Channels {
public:
    explicit Channels(kerf_law& law) : law_(&law) { law.count = 0; }
    /// @param id  the same number for the same thing in every tick
    kerf_channel* add(std::uint32_t kind, std::uint32_t id) noexcept {
        if (law_->count >= KERF_MAX_CHANNELS) {
            ++dropped_;
            return nullptr;
        }
        kerf_channel& c = law_->channel[law_->count++];
        c = kerf_channel{};
        c.kind = kind;
        c.id = id;
        c.w = 1e-6;
        return &c;
    }
    /// A wrench on the tool, about its tip, that is no resistance: a motor's reaction.   Force [N], torque [N·m].
    void push(Vec3 force, Vec3 torque) noexcept {
        const Vec6 wrench = make_vec6(force, torque);
        for (std::size_t i = 0; i < 6; ++i) law_->wrench[i] += wrench[i];
    }
    [[nodiscard]] std::size_t count() const noexcept { return law_->count; }
    /// Leaves a number for the commit of this law, so that it need not ask the bone again. `i` < KERF_MAX_NOTES.
    void note(std::size_t i, double value) noexcept { law_->note[i] = value; }
    [[nodiscard]] int dropped() const noexcept { return dropped_; }

private:
    kerf_law* law_;
    int dropped_ = 0;
};

/// A unit rate along `n` at `point`, as a rate of the tool about its tip: the `d` of a channel there.
[[nodiscard]] constexpr Vec6 rate_at(Vec3 point, Vec3 n) noexcept { return make_vec6(n, cross(point, n)); }

/// Sum of edge elements that share a rate into one cut channel. They share the width of their onset: the τ-weighted
/// mean (resolutions R1).
struct ChannelSum {
    double tau = 0.0, eta = 0.0, tau_w = 0.0;

    /// @param edge_force  [N] that builds up over `w` [m/s]
    /// @param slope       [N·s/m] of what grows with the rate
    void add(double edge_force, double slope, double w) noexcept {
        tau += edge_force;
        eta += slope;
        tau_w += edge_force * w;
    }
    /// Writes a `share` [–] of it along `d`; nothing where there is no channel left.
    void write(const Vec6& d, double share, double gap, kerf_channel* channel) const noexcept {
        if (channel == nullptr) return;
        std::copy(d.begin(), d.end(), channel->d);
        channel->tau = share * tau;
        channel->eta = share * eta;
        channel->w = std::max(1e-6, tau > 0.0 ? tau_w / tau : 1e-6);
        channel->gap = gap;
    }
};

/// What happened in the tick.
struct Advance {
    Vec6 rate;                              ///< tool frame [m/s, rad/s]
    std::span<const kerf_channel> channel;  ///< the law that was solved
    std::span<const double> lambda;         ///< what each of its channels carried [N]
    std::span<const double> note;           ///< what `resist` left; empty when no law was asked
    Vec6
        following{};  ///< on the tool: what was given of what follows the channels and of the law's own wrench [N, N·m]

    /// What all channels of one kind carried together [N].
    [[nodiscard]] double carried_by(std::uint32_t kind) const noexcept {
        double sum = 0.0;
        for (std::size_t c = 0; c < channel.size(); ++c)
            if (channel[c].kind == kind) sum += lambda[c];
        return sum;
    }
};

class Actions {
public:
    explicit Actions(kerf_commit_out& out) : out_(&out) { out.action_count = 0; }
    void cut() noexcept { add(KERF_ACTION_CUT); }
    /// @param body  as the bone's answers name it
    void hold(std::int32_t body) noexcept { add(KERF_ACTION_HOLD, static_cast<std::uint32_t>(body)); }
    void release() noexcept { add(KERF_ACTION_RELEASE); }
    /// @param which  of the events that the law's table declares
    void event(std::size_t which) noexcept { add(KERF_ACTION_EVENT, static_cast<std::uint32_t>(which)); }

private:
    void add(std::uint32_t kind, std::uint32_t value = 0) noexcept {
        if (out_->action_count < KERF_MAX_ACTIONS) out_->action[out_->action_count++] = {kind, value};
    }
    kerf_commit_out* out_;
};

/// A force law: what resists the tool in this tick, as a few monotone channels.
///
/// `resist` states the law at the present pose; the core then finds the one motion at which hand and law balance. So
/// it is pure, and may be asked again. `commit` is told once which motion happened. A law may have besides
///
///     static void begin(const Tick&, const BoneQuery&, State& fresh) noexcept    [haptic, nonblocking]
///
/// to work out once what follows from parameters alone: they stay as they are until it begins again.
template <class L>
concept ForceLaw = requires(const Tick& tick, const BoneQuery& bone, const typename L::State& state,
                            typename L::State& next, Channels& channels, const Advance& advance,
                            std::span<double> signals, Actions& actions) {
    { L::resist(tick, bone, state, channels) }
    noexcept;  // [haptic, nonblocking] pure
    { L::commit(tick, bone, advance, next, signals, actions) }
    noexcept;                                                  // [haptic, nonblocking]
    requires std::is_trivially_copyable_v<typename L::State>;  // the host saves, restores and moves it
    requires std::is_default_constructible_v<typename L::State>;
};

/// The C table of a law.
template <ForceLaw L>
struct ForceTable {
    static Tick tick_of(const kerf_tick_in& in) noexcept {
        return {in.dt,
                {in.tool_params, in.tool_param_count},
                {in.force_params, L::force_parameter_count},
                {in.drive, L::drive_count}};
    }
    static void begin(const kerf_tick_in* in, void* state) {
        auto& fresh = *new (state) typename L::State{};
        if constexpr (requires { &L::begin; }) {
            static_assert(noexcept(L::begin(tick_of(*in), BoneQuery(*in->bone), fresh)));
            L::begin(tick_of(*in), BoneQuery(*in->bone), fresh);
        }
    }
    static kerf_status resist(const kerf_tick_in* in, const void* state, kerf_law* out) {
        Channels channels(*out);
        L::resist(tick_of(*in), BoneQuery(*in->bone), *static_cast<const typename L::State*>(state), channels);
        return channels.dropped() == 0 ? KERF_OK : KERF_CAPACITY;
    }
    static kerf_status commit(const kerf_tick_in* in, const kerf_advance* a, void* state, kerf_commit_out* out) {
        Actions actions(*out);
        Advance advance{{}, {a->channel, a->channel_count}, {a->lambda, a->channel_count}, {}, {}};
        if (a->note != nullptr) advance.note = {a->note, KERF_MAX_NOTES};
        for (std::size_t i = 0; i < 6; ++i) advance.rate[i] = a->rate[i];
        for (std::size_t i = 0; i < 6; ++i) advance.following[i] = a->following[i];
        L::commit(tick_of(*in), BoneQuery(*in->bone), advance, *static_cast<typename L::State*>(state),
                  {out->signal, L::signal_count}, actions);
        return KERF_OK;
    }
};

}  // namespace kerf
