// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/solve.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

/// Replaces a symmetric positive definite matrix by its lower Cholesky factor, with inverted diagonal elements. Returns
/// false if a pivot is not positive.
bool factorise(Mat6& a) noexcept {
    for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
        if (!(a[j][j] > 0.0)) return false;
        a[j][j] = 1.0 / std::sqrt(a[j][j]);
        for (std::size_t i = j + 1; i < 6; ++i) {
            for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] *= a[j][j];
        }
    }
    return true;
}

Vec6 forward(const Mat6& l, Vec6 b) noexcept {
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
        b[i] *= l[i][i];
    }
    return b;
}

Vec6 backward(const Mat6& l, Vec6 b) noexcept {
    for (std::size_t i = 6; i-- > 0;) {
        for (std::size_t k = i + 1; k < 6; ++k) b[i] -= l[k][i] * b[k];
        b[i] *= l[i][i];
    }
    return b;
}

Vec6 stepped(const Vec6& u, double t, const Vec6& p) noexcept {
    Vec6 out;
    for (std::size_t i = 0; i < 6; ++i) out[i] = u[i] + t * p[i];
    return out;
}

/// Returns the velocity of the centre [m/s] at the rate `u` of the tool, about the tip.
Vec3 centre_velocity(const Balance& b, const Vec6& u) noexcept { return linear(u) + cross(angular(u), b.centre); }
/// Returns the wrench about the tip of a force and a torque at the centre.
Vec6 at_tip(const Balance& b, Vec3 force, Vec3 torque) noexcept {
    return make_vec6(force, torque + cross(b.centre, force));
}

using Mat3 = std::array<std::array<double, 3>, 3>;

/// Returns the fraction of a block's drag that the Hessian keeps in a direction in which the block is at its limit.
/// Near the solution the exact fraction, nearly 0, is best. If nothing else resists that direction, such steps are too
/// long and jump to and fro across the kinks of the channels. Later iterations therefore also try larger fractions.
double saturated_drag_fraction(int iteration) noexcept {
    constexpr double usual = 1e-3, other[] = {1e-3, 0.1, 1.0};
    return iteration <= 12 ? usual : other[iteration % 3];
}

/// Returns −∂f/∂(velocity) of a block whose force before clamping is `y`: its drag, reduced in the direction of a part
/// of `y` that is above its limit.
Mat3 stiffness(const CouplingBlock& block, Vec3 y, double kept_when_saturated) noexcept {
    Mat3 d{};
    d[2][2] = (std::abs(y.z) > block.limit.along ? kept_when_saturated : 1.0) * block.drag.along;
    const double size = std::sqrt(y.x * y.x + y.y * y.y);
    if (size <= block.limit.across) {
        d[0][0] = d[1][1] = block.drag.across;
        return d;
    }
    const double around = block.drag.across * block.limit.across / size;
    const double outwards = kept_when_saturated * block.drag.across;
    const double n[2] = {y.x / size, y.y / size};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) d[i][j] = (i == j ? around : 0.0) + (outwards - around) * n[i] * n[j];
    return d;
}

/// Adds Jᵀ diag(f, t) J to the Hessian `h`, which is about the tip. `f` and `t` are the blocks' drags at the centre.
void add_coupling(const Balance& b, const Mat3& f, const Mat3& t, Mat6& h) noexcept {
    // centre velocity = v + ω × r = v − [r]ω
    const double r[3][3] = {{0, -b.centre.z, b.centre.y}, {b.centre.z, 0, -b.centre.x}, {-b.centre.y, b.centre.x, 0}};
    double fr[3][3] = {};  // f (−[r])
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) fr[i][j] -= f[i][k] * r[k][j];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            h[i][j] += f[i][j];
            h[i][3 + j] += fr[i][j];
            h[3 + j][i] += fr[i][j];
            double rfr = 0.0;
            for (std::size_t k = 0; k < 3; ++k) rfr -= r[k][i] * fr[k][j];
            h[3 + i][3 + j] += rfr + t[i][j];
        }
}

/// Adds M/T to the Hessian `h`, with the tool's mass matrix M about the tip.
void add_inertia(const Balance& b, Mat6& h) noexcept {
    const double m = b.inertia.mass / b.dt, c = b.inertia.centre_z, k = b.inertia.gyration;
    for (const std::size_t i : {0u, 1u}) {
        h[i][i] += m;
        h[3 + i][3 + i] += m * (k * k + c * c);
    }
    h[0][4] += m * c;
    h[4][0] += m * c;
    h[1][3] -= m * c;
    h[3][1] -= m * c;
}

/// All forces at one rate: their sum, which is −gradient, and the terms of the Hessian.
struct Evaluation {
    Vec6 out_of_balance;                                     ///< sum of all forces about the tip; zero at the solution
    Vec3 force_pull, torque_pull;                            ///< of the coupling, before clamping
    std::array<ChannelForce, max_balance_channels> channel;  ///< one for each channel of the balance
};

double release_force(const Balance& b, const Vec6& u) noexcept {
    return b.release_damping * std::max(0.0, dot(b.release_along, linear(u)) - b.release_from);
}

Evaluation evaluate(const Balance& b, const Vec6& u) noexcept {
    Evaluation at;  // all members are set below, except unused channels
    at.force_pull = b.force.pull - b.force.drag * centre_velocity(b, u);
    at.torque_pull = b.torque.pull - b.torque.drag * angular(u);
    Vec6 g = at_tip(b, clamped(at.force_pull, b.force.limit), clamped(at.torque_pull, b.torque.limit));
    for (std::size_t i = 0; i < 6; ++i) g[i] += b.following[i];
    if (b.inertia.mass > 0.0) {
        const Vec6 gained = momentum(b.inertia, stepped(u, -1.0, b.previous_rate));
        for (std::size_t i = 0; i < 6; ++i) g[i] -= gained[i] / b.dt;
    }
    for (std::size_t c = 0; c < b.channels.size(); ++c) {
        const Vec6 d = direction(b.channels[c]);
        at.channel[c] = channel_force(b.channels[c], dot(d, u), b.dt);
        for (std::size_t i = 0; i < 6; ++i) g[i] -= d[i] * at.channel[c].lambda;
    }
    const Vec3 release = release_force(b, u) * b.release_along;
    g[0] -= release.x;
    g[1] -= release.y;
    g[2] -= release.z;
    at.out_of_balance = g;
    return at;
}

Mat6 hessian(const Balance& b, const Vec6& u, const Evaluation& at, double kept_when_saturated) noexcept {
    Mat6 h{};
    add_coupling(b, stiffness(b.force, at.force_pull, kept_when_saturated),
                 stiffness(b.torque, at.torque_pull, kept_when_saturated), h);
    add_inertia(b, h);
    for (std::size_t c = 0; c < b.channels.size(); ++c) {
        const Vec6 d = direction(b.channels[c]);
        const double slope = at.channel[c].slope;
        if (slope == 0.0) continue;
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) h[i][j] += slope * d[i] * d[j];
    }
    if (release_force(b, u) > 0.0) {
        const double e[3] = {b.release_along.x, b.release_along.y, b.release_along.z};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) h[i][j] += b.release_damping * e[i] * e[j];
    }
    return h;
}

/// Result of the line search: the multiple of `step` at which the slope along it is nearly zero. `is_last`: the last
/// evaluation was at that multiple.
struct LineSearchResult {
    double fraction;
    bool is_last;
};
// The slope (force out of balance · step) falls monotonically: find a bracket of its zero, then narrow it.
LineSearchResult exact_line_search(const Balance& b, const Vec6& u, const Vec6& step, double slope_at_start,
                                   Evaluation& last) noexcept {
    const auto slope = [&](double t) {
        last = evaluate(b, stepped(u, t, step));
        return dot(last.out_of_balance, step);
    };
    const double small = 1e-3 * slope_at_start;
    double low = 0.0, low_slope = slope_at_start;
    double high = 1.0, high_slope = slope(1.0);
    for (int i = 0; high_slope > small && i < 40; ++i) {
        low = high;
        low_slope = high_slope;
        high *= 2.0;
        high_slope = slope(high);
    }
    if (std::abs(high_slope) <= small) return {high, true};
    // Regula falsi (Illinois variant). The slope is monotone, so the root cannot leave the bracket.
    int kept_side = 0;
    for (int i = 0; i < 80; ++i) {
        double t = (low * high_slope - high * low_slope) / (high_slope - low_slope);
        if (!(t > low && t < high)) t = 0.5 * (low + high);
        const double s = slope(t);
        if (std::abs(s) <= small) return {t, true};
        if (s > 0.0) {
            low = t;
            low_slope = s;
            if (kept_side == 1) high_slope *= 0.5;
            kept_side = 1;
        } else {
            high = t;
            high_slope = s;
            if (kept_side == -1) low_slope *= 0.5;
            kept_side = -1;
        }
        if (i % 8 == 7) {  // a kink can stall regula falsi: bisect
            t = 0.5 * (low + high);
            const double half = slope(t);
            if (half > 0.0) {
                low = t;
                low_slope = half;
            } else {
                high = t;
                high_slope = half;
            }
            kept_side = 0;
        }
    }
    return {low > 0.0 ? low : 0.5 * (low + high), false};
}

/// Stores the rate, and the forces of coupling, release damper and channels at this rate.
void store_forces(const Balance& b, const Vec6& rate, const Evaluation& at, Motion& motion) noexcept {
    motion.rate = rate;
    motion.force = clamped(at.force_pull, b.force.limit);
    motion.torque = clamped(at.torque_pull, b.torque.limit);
    motion.release = release_force(b, rate);
    for (std::size_t c = 0; c < b.channels.size(); ++c) motion.lambda[c] = at.channel[c].lambda;
}

}  // namespace

Motion solve(const Balance& balance) noexcept { return solve_from(balance, Vec6{}); }

Motion solve_from(const Balance& b, const Vec6& start) noexcept {
    constexpr double tolerance = 1e-8;
    // A channel with the smallest w, 1 µm/s, has slopes of 3e8 N·s/m: rounding of the rate alone can leave this
    // residual.
    constexpr double rounding = 1e-6;
    // Without forces the rounding of a rate of 1e-14 m/s is all that is left. Norm below: 1e-12 is about 1e-11 N.
    constexpr double negligible = 1e-12;
    Motion motion;

    // The norm √(xᵀA⁻¹x) makes newtons and newton metres comparable. A is the Hessian of coupling and inertia without
    // limits.
    Mat6 norm{};
    Mat3 force_drag{}, torque_drag{};
    for (std::size_t i = 0; i < 3; ++i) {
        force_drag[i][i] = i < 2 ? b.force.drag.across : b.force.drag.along;
        torque_drag[i][i] = i < 2 ? b.torque.drag.across : b.torque.drag.along;
    }
    add_coupling(b, force_drag, torque_drag, norm);
    add_inertia(b, norm);
    if (!factorise(norm)) return motion;
    const auto size = [&norm](const Vec6& x) {
        const Vec6 y = forward(norm, x);
        return std::sqrt(dot(y, y));
    };
    // The residual is relative to the sum of the sizes of all forces at rate 0. Their vector sum is no scale: in
    // contact at rest it is nearly zero.
    double scale = 1e-9 + size(at_tip(b, b.force.pull, b.torque.pull)) + size(b.following) +
                   size(scaled(1.0 / b.dt, momentum(b.inertia, b.previous_rate)));
    for (const auto& channel : b.channels) {
        const double lambda = channel_force(channel, 0.0, b.dt).lambda;
        if (lambda != 0.0) scale += size(scaled(lambda, direction(channel)));
    }

    Vec6 u = start;
    Evaluation at = evaluate(b, u);
    for (; motion.iterations < iteration_cap; ++motion.iterations) {
        const double before = motion.residual;
        const double unbalanced = size(at.out_of_balance);
        motion.residual = unbalanced / scale;
        const bool is_rounding = motion.iterations > 0 && motion.residual <= rounding && motion.residual > 0.5 * before;
        if (motion.residual <= tolerance || is_rounding || unbalanced <= negligible) {
            motion.has_converged = true;
            break;
        }
        Mat6 h = hessian(b, u, at, saturated_drag_fraction(motion.iterations));
        if (!factorise(h)) break;
        const Vec6 step = backward(h, forward(h, at.out_of_balance));
        const double slope = dot(at.out_of_balance, step);
        if (!(slope > 0.0)) break;
        const LineSearchResult found = exact_line_search(b, u, step, slope, at);
        u = stepped(u, found.fraction, step);
        if (!found.is_last) at = evaluate(b, u);
    }

    store_forces(b, u, at, motion);
    return motion;
}

Motion at_rate(const Balance& b, const Vec6& rate) noexcept {
    Motion motion;
    store_forces(b, rate, evaluate(b, rate), motion);
    return motion;
}

}  // namespace kerf
