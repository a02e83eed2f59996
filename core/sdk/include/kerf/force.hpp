// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "kerf/abi.h"
#include "kerf/math.hpp"
#include "kerf/sampled_wall.hpp"

/// Types that a force law reads and writes in a tick: bone, channels, the solved motion, actions.
namespace kerf {

/// Time, hand and tool outline of one step: a tick, or a part of a fast tick.
struct Tick {
    double dt = 0.0;                                ///< [s] length of the step
    std::uint64_t number = 0;                       ///< of the tick, from 0; the same in all its parts
    std::uint32_t hand = 0;                         ///< index of the hand on the tool
    std::span<const kerf_profile_point> outline{};  ///< of the held tool: (z, radius) [m], from the tip backwards
};

/// The surface of bone nearest to a point.
struct SurfacePoint : kerf_surface_point {
    /// Returns whether there is a surface and the point lies inside bone or at most `most` [m] outside.
    [[nodiscard]] bool is_within(double most) const noexcept {
        return body >= 0 && distance <= most && !(normal == Vec3{});
    }
};

/// Queries of the bone; points and directions in the tool frame.   [haptic, nonblocking]
class BoneQuery {
public:
    explicit BoneQuery(const kerf_bone_query& query) noexcept : query_(&query) {}
    /// Samples the bone at cutting edges.
    /// @param direction  unit; the gap is measured along it
    void sample(std::span<const Vec3> points, Vec3 direction, std::span<kerf_bone_sample> out) const noexcept {
        sample(points, std::span<const Vec3>(&direction, 1), out);
    }
    /// @param directions  one for all points, or one for each. One query of many points costs less than many queries
    void sample(std::span<const Vec3> points, std::span<const Vec3> directions,
                std::span<kerf_bone_sample> out) const noexcept {
        query_->sample(query_->bone, points.data(), static_cast<std::uint32_t>(points.size()), directions.data(),
                       static_cast<std::uint32_t>(directions.size()), out.data());
    }
    /// Writes the surface nearest to each point.
    void nearest(std::span<const Vec3> points, std::span<kerf_surface_point> out) const noexcept {
        query_->nearest(query_->bone, points.data(), static_cast<std::uint32_t>(points.size()), out.data());
    }
    /// Returns the surface nearest to one point.
    [[nodiscard]] SurfacePoint nearest(Vec3 point) const noexcept {
        SurfacePoint out{};
        query_->nearest(query_->bone, &point, 1, &out);
        return out;
    }
    /// Writes the threads in bodies near the tool. Returns the number written.
    std::size_t threads(std::span<kerf_thread> out) const noexcept {
        if (query_->threads == nullptr) return 0;
        const auto capacity = static_cast<std::uint32_t>(out.size());
        return std::min(query_->threads(query_->bone, out.data(), capacity), capacity);
    }
    [[nodiscard]] std::uint32_t tissue_count() const noexcept { return query_->tissue_count; }
    /// Returns the distance [m] from a surface, on either side, up to which distances are known.
    [[nodiscard]] double reach() const noexcept { return query_->reach; }
    [[nodiscard]] double voxel() const noexcept { return 0.25 * reach(); }  ///< [m] spacing of the grid's samples
    /// Returns the error [m] of the position of a sampled wall.
    [[nodiscard]] double wall_error() const noexcept { return 0.1 * voxel(); }
    /// Returns the error [m] of the position of the sampled wall of a hole of `radius` [m].
    [[nodiscard]] double wall_error(double radius) const noexcept {
        return wall_error() + wall_sagitta(radius, voxel());
    }

private:
    const kerf_bone_query* query_;
};

/// Returns the `d` of a channel along `n` at `point` (tool frame, from the tip): dᵀu is the speed of the point along
/// `n` when the tool moves at the rate u. It is also the wrench about the tip of a unit force along `n` at the point.
[[nodiscard]] constexpr Vec6 rate_at(Vec3 point, Vec3 n) noexcept { return make_vec6(n, cross(point, n)); }

// ---- channels, by named fields ----------------------------------------------------------------------------------

/// A contact: bone pushes back with `stiffness` × depth. `along` points into the bone.
struct ContactSpec {
    std::uint32_t id;      ///< constant over ticks for one resistance
    Vec3 at{};             ///< [m] tool frame
    Vec3 along;            ///< unit, tool frame
    double stiffness;      ///< [N/m]
    double depth;          ///< [m] of penetration; negative outside
    double damping = 0.0;  ///< [N·s/m]
};
/// A cutting edge: bone resists motion along `along` that is faster than needed to cross `gap` in this tick.
struct CutSpec {
    std::uint32_t id;
    Vec3 at{};
    Vec3 along;               ///< unit
    double edge_force = 0.0;  ///< [N] part that builds up over a rate of about `onset`
    double onset = 1e-6;      ///< [m/s] ≥ 1e-6
    double slope;             ///< [N·s/m] of the part that is proportional to the rate
    double gap = 0.0;         ///< [m] to uncut bone
    Vec6 follow{};            ///< wrench on the tool per newton [N/N, N·m/N]
};
/// Friction along `along`, in both directions.
struct FrictionSpec {
    std::uint32_t id;
    Vec3 at{};
    Vec3 along;           ///< unit
    double limit;         ///< [N]
    double onset = 1e-6;  ///< [m/s] ≥ 1e-6: rate at which the limit is reached
};

/// A spring along `d`, in both directions, that yields at `limit`: a thread in bone.
struct HoldSpec {
    std::uint32_t id;
    Vec6 d;                ///< linear [–], angular [m]; tool frame
    double stiffness;      ///< [N/m]
    double stretch;        ///< [m] along `d`; positive: the spring pulls the tool against `d`
    double damping = 0.0;  ///< [N·s/m]
    double limit = 0.0;    ///< [N] in both directions; 0: none
};

/// The channels that a law writes. Channels beyond KERF_MAX_CHANNELS are dropped and counted.
class Channels {
public:
    explicit Channels(kerf_law& law) : law_(&law) { law.count = 0; }

    void contact(const ContactSpec& spec) noexcept {
        kerf_channel* c = add(KERF_CONTACT, spec.id, rate_at(spec.at, spec.along));
        if (c == nullptr) return;
        c->k = spec.stiffness;
        c->b = spec.damping;
        c->delta = spec.depth;
    }
    void cut(const CutSpec& spec) noexcept {
        kerf_channel* c = add(KERF_CUT, spec.id, rate_at(spec.at, spec.along));
        if (c == nullptr) return;
        c->tau = spec.edge_force;
        c->w = std::max(1e-6, spec.onset);
        c->eta = spec.slope;
        c->gap = spec.gap;
        std::copy(spec.follow.begin(), spec.follow.end(), c->follow);
    }
    void friction(const FrictionSpec& spec) noexcept {
        kerf_channel* c = add(KERF_FRICTION, spec.id, rate_at(spec.at, spec.along));
        if (c == nullptr) return;
        c->tau = spec.limit;
        c->w = std::max(1e-6, spec.onset);
    }
    void hold(const HoldSpec& spec) noexcept {
        kerf_channel* c = add(KERF_HOLD, spec.id, spec.d);
        if (c == nullptr) return;
        c->k = spec.stiffness;
        c->b = spec.damping;
        c->delta = spec.stretch;
        c->tau = spec.limit;
    }
    /// Adds an empty channel. Returns null if there are KERF_MAX_CHANNELS already.
    /// @param id  constant over ticks for one resistance
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
    kerf_channel* add(std::uint32_t kind, std::uint32_t id, const Vec6& d) noexcept {
        kerf_channel* c = add(kind, id);
        if (c != nullptr) std::copy(d.begin(), d.end(), c->d);
        return c;
    }
    /// Adds a wrench on the tool, about its tip, that is not a resistance, such as a motor's reaction. Force [N],
    /// torque [N·m].
    void push(Vec3 force, Vec3 torque) noexcept {
        const Vec6 wrench = make_vec6(force, torque);
        for (std::size_t i = 0; i < 6; ++i) law_->wrench[i] += wrench[i];
    }
    [[nodiscard]] std::size_t count() const noexcept { return law_->count; }
    [[nodiscard]] int dropped() const noexcept { return dropped_; }

private:
    kerf_law* law_;
    int dropped_ = 0;
};

/// Sums edge elements that move at a common rate into one cut channel. The channel's onset is the mean of the elements'
/// onsets, weighted by edge force.
struct ChannelSum {
    double tau = 0.0, eta = 0.0, tau_w = 0.0;

    /// @param edge_force  [N] that builds up over `w` [m/s]
    /// @param slope       [N·s/m] of the part that is proportional to the rate
    void add(double edge_force, double slope, double w) noexcept {
        tau += edge_force;
        eta += slope;
        tau_w += edge_force * w;
    }
    /// Writes the fraction `fraction` [–] of the sum along `d`; writes nothing if `channel` is null.
    void write(const Vec6& d, double fraction, double gap, kerf_channel* channel) const noexcept {
        if (channel == nullptr) return;
        std::copy(d.begin(), d.end(), channel->d);
        channel->tau = fraction * tau;
        channel->eta = fraction * eta;
        channel->w = std::max(1e-6, tau > 0.0 ? tau_w / tau : 1e-6);
        channel->gap = gap;
    }
};

// ---- after the balance ------------------------------------------------------------------------------------------

/// The solved motion of a step, and its forces.
struct Advance {
    Vec6 rate{};                              ///< tool frame [m/s, rad/s]
    std::span<const kerf_channel> channel{};  ///< the channels of the law that was solved
    std::span<const double> lambda{};         ///< the force λ of each of these channels [N]
    Vec6 following{};      ///< wrench on the tool that the host applied for `follow` and the law's own wrench [N, N·m]
    bool has_law = false;  ///< true if the law was evaluated in this step

    /// Returns the sum of the forces of all channels of one kind [N].
    [[nodiscard]] double force_of_kind(std::uint32_t kind) const noexcept {
        double sum = 0.0;
        for (std::size_t c = 0; c < channel.size(); ++c)
            if (channel[c].kind == kind) sum += lambda[c];
        return sum;
    }
    /// Returns the force of the channel with this id [N]; 0 if there is no such channel.
    [[nodiscard]] double force_of_channel(std::uint32_t id) const noexcept {
        for (std::size_t c = 0; c < channel.size(); ++c)
            if (channel[c].id == id) return lambda[c];
        return 0.0;
    }
    /// Returns the force by which all channels except friction push the tool along −z of its frame [N]; 0 if they push
    /// along +z.
    [[nodiscard]] double axial_thrust() const noexcept {
        double sum = 0.0;
        for (std::size_t c = 0; c < channel.size(); ++c)
            if (channel[c].kind != KERF_FRICTION) sum += channel[c].d[2] * lambda[c];
        return std::max(0.0, sum);
    }
};

/// The motion, with the notes that `resist` returned. If no law was evaluated, the notes are default-constructed.
template <class Notes>
struct Noted : Advance {
    static_assert(std::is_trivially_copyable_v<Notes> && sizeof(Notes) <= KERF_NOTE_BYTES,
                  "the notes of resist must be trivially copyable, of at most KERF_NOTE_BYTES");
    Notes notes{};
};

/// The actions of a law on bone and bodies.
class Actions {
public:
    explicit Actions(kerf_commit_out& out) : out_(&out) { out.action_count = out.thread_count = 0; }
    /// Removes the volume that the cutting part of the tool sweeps in this step.
    void cut() noexcept { add(KERF_ACTION_CUT, KERF_CUT_REGION); }
    /// Removes the cylinder around the tool's thread: bone whose thread is stripped.
    void cut_thread() noexcept { add(KERF_ACTION_CUT, KERF_CUT_THREAD); }
    /// Adds a thread to the bone, or changes an existing one. Only the last call of a commit counts.
    /// @param thread  changed, from `BoneQuery::threads`; or new, with the number `KERF_NEW_THREAD`
    void leave(const kerf_thread& thread) noexcept {
        if (out_->thread == nullptr) return;
        *out_->thread = thread;
        out_->thread_count = 1;
    }
    /// Makes a body rigid to the tool.
    /// @param body  `kerf_bone_sample::body` or `kerf_surface_point::body`
    void hold(std::int32_t body) noexcept { add(KERF_ACTION_HOLD, static_cast<std::uint32_t>(body)); }
    /// Releases the body that is rigid to the tool.
    void release() noexcept { add(KERF_ACTION_RELEASE); }
    /// Reports an event that the law describes.
    template <class E>
    requires std::is_enum_v<E>
    void event(E which) noexcept { add(KERF_ACTION_EVENT, static_cast<std::uint32_t>(which)); }

private:
    void add(std::uint32_t kind, std::uint32_t value = 0) noexcept {
        if (out_->action_count < KERF_MAX_ACTIONS) out_->action[out_->action_count++] = {kind, value};
    }
    kerf_commit_out* out_;
};

}  // namespace kerf
