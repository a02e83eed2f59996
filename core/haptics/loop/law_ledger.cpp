// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/law_ledger.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/haptics/law/channel.h"

namespace kerf {

namespace {

constexpr double second = 1.0;     // [s]
constexpr double max_made = 0.4;   // [–] of the work through the law [assumed]
constexpr double max_swung = 0.5;  // [–] of the work of a wrench that no bone carries [assumed]

/// Returns the part of a push that the bone's forces, of this sum, cannot carry.
double part_beyond(Vec3 push, double forces) noexcept {
    const double size = length(push), bound = LawLedger::carried * forces;
    if (forces == 0.0) return 1.0;
    return size > bound ? 1.0 - bound / size : 0.0;
}

/// Returns the energy that a channel stores after a step at the rate `s` along it [J].
double stored_in(const kerf_channel& c, double s, double dt) noexcept {
    const double end = c.delta + s * dt;
    if (c.kind == KERF_CONTACT) return 0.5 * c.k * std::max(end, 0.0) * std::max(end, 0.0);
    if (c.kind != KERF_HOLD || !(c.k > 0.0)) return 0.0;
    const double force = c.tau > 0.0 ? std::min(std::abs(c.k * end), c.tau) : c.k * end;
    return 0.5 * force * force / c.k;
}

}  // namespace

bool LawLedger::add(const EvaluatedLaw& law, const AppliedMotion& applied, bool is_driven) noexcept {
    double taken = 0.0, through = 0.0, stored = 0.0, impulse = 0.0;
    for (std::uint32_t i = 0; i < law.law_count; ++i) {
        const kerf_channel& channel = law.channel[i];
        const double s = dot(direction(channel), applied.rate), work = applied.lambda[i] * s * applied.dt;
        taken += work;
        through += std::abs(work);
        impulse += std::abs(applied.lambda[i]) * applied.dt;
        stored += stored_in(channel, s, applied.dt);
    }
    impulse_ += impulse;
    work_ += through;

    const double pushed = dot(applied.following, applied.rate) * applied.dt;
    if (!is_driven) {
        taken -= pushed;
        through += std::abs(pushed);
    } else if (const double beyond = part_beyond(linear(applied.following), impulse / applied.dt); beyond > 0.0) {
        shaken_ += beyond * pushed;
        swung_ += beyond * std::abs(pushed);
    }
    available_ += taken;
    through_ += through;
    if (to_settle_ <= 0.0) made_ += std::max(0.0, -available_);
    available_ = to_settle_ > 0.0 ? stored : std::clamp(available_, 0.0, stored);
    to_settle_ -= applied.dt;
    elapsed_ += applied.dt;
    return elapsed_ >= second && close_second();
}

bool LawLedger::close_second() noexcept {
    const double shaken = shaken_ > max_swung * swung_ ? shaken_ : 0.0;
    last_ = {made_ + shaken, through_ + swung_};
    if (last_.made > largest_.made) largest_ = last_;
    const bool is_odd = (made_ > floor && made_ > max_made * through_) || shaken > floor_in_air;
    made_ = through_ = shaken_ = swung_ = elapsed_ = 0.0;
    return is_odd && !std::exchange(is_reported_, true);
}

void LawLedger::restart() noexcept {
    available_ = made_ = through_ = shaken_ = swung_ = elapsed_ = 0.0;
    to_settle_ = settling;
    is_reported_ = false;
}

}  // namespace kerf
