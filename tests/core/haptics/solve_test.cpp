// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/haptics/loop/following.h"

namespace kerf {
namespace {

Balance hand_that_pulls(Vec3 pull) {
    Balance b;
    b.force = {.pull = pull, .drag = 100.0, .limit = 1e6};
    b.torque = {.pull = {}, .drag = 0.25, .limit = 1e6};
    return b;
}

kerf_channel cut_along_z(double tau, double w, double eta, double gap = 0.0) {
    kerf_channel c{};
    c.kind = KERF_CUT;
    c.d[2] = 1.0;
    c.tau = tau;
    c.w = w;
    c.eta = eta;
    c.gap = gap;
    return c;
}

TEST(Solve, InAirTheToolFollowsTheHand) {
    const Motion m = solve(hand_that_pulls({0, 0, 5.0}));
    EXPECT_NEAR(m.rate[2], 5.0 / 100.0, 1e-12);
    EXPECT_TRUE(m.has_converged);
}

TEST(Solve, ALinearCutGivesTheRateOfTwoDampersInParallel) {
    // 5 N pull, 100 N·s/m to the hand, 900 N·s/m in the bone: 5 mm/s, 4.5 N on the bone
    const kerf_channel cut = cut_along_z(0.0, 1e-6, 900.0);
    Balance b = hand_that_pulls({0, 0, 5.0});
    b.channels = {&cut, 1};
    const Motion m = solve(b);
    EXPECT_NEAR(m.rate[2], 5e-3, 1e-12);
    EXPECT_NEAR(m.lambda[0], 4.5, 1e-9);
}

TEST(Solve, PushingLessThanTheEdgeForceStillCreepsAsTheLawSays) {
    // τ(1 − e^(−s/w)) + η s = 10 with τ = 100 N
    const kerf_channel cut = cut_along_z(100.0, 1e-3, 1e4);
    Balance b = hand_that_pulls({0, 0, 10.0});
    b.channels = {&cut, 1};
    const Motion m = solve(b);
    EXPECT_GT(m.rate[2], 0.0);
    EXPECT_NEAR(100.0 * (1.0 - std::exp(-m.rate[2] / 1e-3)) + 1e4 * m.rate[2], 10.0 - 100.0 * m.rate[2], 1e-7);
}

/// Next to nothing holds it.
Balance free_body(double mass, double centre_z, double gyration) {
    Balance b;
    b.force = {.pull = {}, .drag = 1e-9, .limit = 1e6};
    b.torque = {.pull = {}, .drag = 1e-12, .limit = 1e6};
    b.inertia = {mass, centre_z, gyration};
    return b;
}

TEST(Solve, ABlowAtTheTipMovesAFreeBodyAndTurnsItAboutItsCentre) {
    // 10 N for 1 ms across 0.5 kg, 120 mm from its centre, radius of gyration 50 mm: v = F T (1/m + c²/(m k²)), ω = F T
    // c/(m k²)
    Balance b = free_body(0.5, -0.12, 0.05);
    b.following = {10.0, 0, 0, 0, 0, 0};
    const Motion m = solve(b);
    ASSERT_TRUE(m.has_converged);
    EXPECT_NEAR(m.rate[0], 0.01 * (2.0 + 0.0144 / 0.00125), 1e-6);
    EXPECT_NEAR(m.rate[4], 0.01 * 0.12 / 0.00125, 1e-5);
    for (const std::size_t other : {1u, 2u, 3u, 5u}) EXPECT_NEAR(m.rate[other], 0.0, 1e-9) << other;
}

TEST(Solve, AcrossItsAxisAFreeBodyGoesOnAsItWentAndAlongItNot) {
    Balance b = free_body(0.5, -0.12, 0.05);
    b.previous_rate = {0.01, -0.02, 0.03, 0.4, -0.5, 0.6};
    const Motion m = solve(b);
    for (const std::size_t across : {0u, 1u, 3u, 4u})
        EXPECT_NEAR(m.rate[across], b.previous_rate[across], 1e-6) << across;
    for (const std::size_t along : {2u, 5u}) EXPECT_NEAR(m.rate[along], 0.0, 1e-12) << along;
}

TEST(Solve, KineticEnergyIsThatOfAMassOnItsWayAndInItsTurn) {
    // 0.5 kg whose centre goes at 20 + 120 · 0.1 = 32 mm/s while it turns at 0.1 rad/s; along the axis it has none
    const Inertia body{0.5, 0.12, 0.05};
    EXPECT_NEAR(kinetic_energy(body, {0.02, 0, 0.5, 0, 0.1, 3.0}), 0.25 * (0.032 * 0.032 + 0.0025 * 0.01), 1e-15);
    EXPECT_NEAR(kinetic_energy(body, {0, 0.02, 0, -0.1, 0, 0}), 0.25 * (0.032 * 0.032 + 0.0025 * 0.01), 1e-15);
}

TEST(Solve, AcrossAGapThereIsNoForce) {
    const kerf_channel cut = cut_along_z(100.0, 1e-4, 1e4, 1e-4 /* 0.1 m/s for a tick */);
    Balance b = hand_that_pulls({0, 0, 5.0});  // 0.05 m/s
    b.channels = {&cut, 1};
    EXPECT_EQ(solve(b).lambda[0], 0.0);
    EXPECT_NEAR(solve(b).rate[2], 0.05, 1e-12);
}

TEST(Solve, TheCouplingNeverPullsHarderThanItsLimit) {
    const kerf_channel cut = cut_along_z(100.0, 1e-3, 1e4);
    Balance b = hand_that_pulls({0, 0, 500.0});
    b.force.limit = 20.0;
    b.channels = {&cut, 1};
    const Motion m = solve(b);
    EXPECT_TRUE(m.has_converged);
    EXPECT_NEAR(length(m.force), 20.0, 1e-9);
    EXPECT_NEAR(m.lambda[0], 20.0, 1e-6);
}

TEST(Solve, TheLeverTurnsASidewaysPullIntoRotation) {
    Balance b = hand_that_pulls({1.0, 0, 0});
    b.centre = {0, 0, -0.1};
    const Motion m = solve(b);
    // Nothing holds the tool: the grip moves with the pull, and the torque block resists the rotation it would take.
    EXPECT_NEAR(m.rate[0], 0.01, 1e-9);
    EXPECT_NEAR(m.rate[4], 0.0, 1e-9);
}

// ---- a hundred thousand random laws -----------------------------------------------------------------------------

struct RandomLaw {
    std::mt19937_64 random;
    std::vector<kerf_channel> channels;

    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }
    double logarithmic(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }

    Balance make() {
        channels.clear();
        const int count = static_cast<int>(uniform(0.0, 16.999));
        for (int i = 0; i < count; ++i) {
            kerf_channel c{};
            c.kind = static_cast<std::uint32_t>(uniform(0.0, 2.999));
            Vec3 d = normalized(Vec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
            const Vec3 lever{uniform(-0.003, 0.003), uniform(-0.003, 0.003), uniform(-0.03, 0.0)};
            const Vec3 turn = cross(lever, d);
            const Vec6 six = make_vec6(d, turn);
            std::copy(six.begin(), six.end(), c.d);
            c.tau = uniform(0, 1) < 0.2 ? 0.0 : logarithmic(0.01, 300.0);
            c.w = logarithmic(1e-6, 1e-1);
            c.eta = uniform(0, 1) < 0.3 ? 0.0 : logarithmic(1.0, 1e5);
            c.gap = uniform(0, 1) < 0.5 ? 0.0 : logarithmic(1e-9, 1e-3);
            c.k = logarithmic(1e2, 1e6);
            c.b = uniform(0, 1) < 0.5 ? 0.0 : logarithmic(0.1, 1e3);
            c.delta = uniform(-1e-4, 1e-4);
            channels.push_back(c);
        }
        const double scale = logarithmic(1.0 / 400.0, 1.0);
        const double k = 480.0 / scale, damping = 1.5 / scale;
        Balance b;
        b.force.pull = uniform(0.0, 200.0) * normalized(Vec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
        b.force.drag = damping + 1e-3 * k;
        b.force.limit = uniform(0, 1) < 0.3 ? uniform(1.0, 100.0) : 1e4;
        b.torque.pull = uniform(0.0, 5.0) * normalized(Vec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
        b.torque.drag = 0.0025 * b.force.drag;
        b.torque.limit = uniform(0, 1) < 0.3 ? uniform(0.05, 2.0) : 1e3;
        b.centre = {0, 0, -uniform(0.0, 0.15)};
        b.channels = channels;
        if (uniform(0, 1) < 0.5) {  // softer across than along, as in a hand, and with limits of its own
            b.force.drag.across *= logarithmic(1e-2, 1.0);
            b.torque.drag.across *= logarithmic(1e-2, 1.0);
            b.force.limit.across = uniform(0, 1) < 0.3 ? uniform(1.0, 100.0) : 1e4;
            b.torque.limit.across = uniform(0, 1) < 0.3 ? uniform(0.05, 2.0) : 1e3;
        }
        if (uniform(0, 1) < 0.5) {
            b.inertia = {logarithmic(0.05, 5.0), -uniform(0.0, 0.2), uniform(0.01, 0.1)};
            for (double& rate : b.previous_rate) rate = uniform(-0.1, 0.1);
        }
        return b;
    }
};

TEST(Solve, AHundredThousandRandomLawsAllBalance) {
    RandomLaw law{.random = std::mt19937_64(20), .channels = {}};
    std::vector<int> iterations;
    for (int i = 0; i < 100000; ++i) {
        const Motion m = solve(law.make());
        ASSERT_TRUE(m.has_converged) << "case " << i << ", residual " << m.residual;
        iterations.push_back(m.iterations);
    }
    std::sort(iterations.begin(), iterations.end());
    EXPECT_LE(iterations[99900], 16);
    RecordProperty("median_iterations", iterations[50000]);
    RecordProperty("p99_9_iterations", iterations[99900]);
    RecordProperty("max_iterations", iterations.back());
}

TEST(Solve, FindsTheSameAnswerFromAnyStart) {
    RandomLaw law{.random = std::mt19937_64(21), .channels = {}};
    for (int i = 0; i < 5000; ++i) {
        const Balance b = law.make();
        const Motion from_rest = solve(b);
        Vec6 start;
        for (auto& s : start) s = law.uniform(-0.2, 0.2);
        const Motion other = solve_from(b, start);
        ASSERT_TRUE(other.has_converged) << i;
        for (std::size_t k = 0; k < 6; ++k)
            ASSERT_NEAR(from_rest.rate[k], other.rate[k],
                        1e-5 * (1.0 + std::abs(from_rest.rate[k])) /* where the coupling slides, hardly held */)
                << i;
    }
}

/// What is out of balance at a motion, worked out here from what each part is said to do; and what the parts sum to.
struct Sum {
    Vec3 force{}, torque{};
    double forces = 0.0, torques = 0.0;  ///< of the sizes

    void add(Vec3 f, Vec3 t) {
        force = force + f;
        torque = torque + t;
        forces += length(f);
        torques += length(t);
    }
};
Sum out_of_balance(const Balance& b, const Vec6& rate) {
    const Vec3 v = linear(rate), w = angular(rate);
    // By parts: across the shaft as a length, along it as a number
    const auto at_most = [](Vec3 pull, Split limit) {
        const double across = std::hypot(pull.x, pull.y), share = across > limit.across ? limit.across / across : 1.0;
        return Vec3{share * pull.x, share * pull.y, std::min(std::max(pull.z, -limit.along), limit.along)};
    };
    const auto dragged = [](Split drag, Vec3 by) {
        return Vec3{drag.across * by.x, drag.across * by.y, drag.along * by.z};
    };
    Sum sum;
    const Vec3 at_grip = at_most(b.force.pull - dragged(b.force.drag, v + cross(w, b.centre)), b.force.limit);
    sum.add(at_grip, cross(b.centre, at_grip));
    sum.add({}, at_most(b.torque.pull - dragged(b.torque.drag, w), b.torque.limit));
    sum.add(linear(b.following), angular(b.following));
    for (const kerf_channel& c : b.channels) {
        const double lambda = channel_force(c, dot(direction(c), rate), b.dt).lambda;
        sum.add(-lambda * linear(direction(c)), -lambda * angular(direction(c)));
    }
    const double faster = dot(b.release_along, v) - b.release_from;
    if (faster > 0.0) sum.add(-b.release_damping * faster * b.release_along, {});

    // What the mass gains in the tick, across the axis alone: its centre's momentum, and its own turn
    const Vec3 dv = v - linear(b.previous_rate), dw = w - angular(b.previous_rate);
    const Vec3 centre{0, 0, b.inertia.centre_z};
    Vec3 gained = b.inertia.mass * (dv + cross(dw, centre));
    gained.z = 0.0;
    Vec3 turned = (b.inertia.mass * b.inertia.gyration * b.inertia.gyration) * dw + cross(centre, gained);
    turned.z = 0.0;
    sum.add((-1.0 / b.dt) * gained, (-1.0 / b.dt) * turned);
    return sum;
}

TEST(Solve, EveryPartOfTheBalanceCountsWithItsSign) {
    RandomLaw law{.random = std::mt19937_64(22), .channels = {}};
    int released = 0, saturated = 0;
    for (int i = 0; i < 3000; ++i) {
        Balance b = law.make();
        b.centre = {law.uniform(-0.05, 0.05), law.uniform(-0.05, 0.05), -law.uniform(0.0, 0.15)};
        Vec6 following;
        for (std::size_t k = 0; k < 6; ++k) following[k] = law.uniform(-1.0, 1.0) * (k < 3 ? 5.0 : 0.1);
        b.following = Following().wrench(b, following);  // no more than the coupling can hold
        b.release_along = normalized(Vec3{law.uniform(-1, 1), law.uniform(-1, 1), law.uniform(-1, 1)});
        b.release_damping = law.uniform(0.0, 200.0);
        b.release_from = law.uniform(0.0, 0.01);
        const Motion m = solve(b);
        ASSERT_TRUE(m.has_converged) << i;

        const Sum sum = out_of_balance(b, m.rate);
        ASSERT_LT(length(sum.force), 1e-5 * sum.forces + 1e-9) << i;
        ASSERT_LT(length(sum.torque), 1e-5 * (sum.torques + 0.15 * sum.forces) + 1e-9) << i;
        released += m.release > 0.0;
        saturated += std::abs(m.force.z) > 0.999 * b.force.limit.along;

        // And it reports what each part carries there
        const Motion same = at_rate(b, m.rate);
        ASSERT_EQ(length(same.force - m.force), 0.0);
        ASSERT_EQ(length(same.torque - m.torque), 0.0);
        ASSERT_EQ(same.release, m.release);
        ASSERT_LE(std::hypot(m.force.x, m.force.y), b.force.limit.across * (1.0 + 1e-12));
        ASSERT_LE(std::abs(m.force.z), b.force.limit.along * (1.0 + 1e-12));
        ASSERT_LE(std::hypot(m.torque.x, m.torque.y), b.torque.limit.across * (1.0 + 1e-12));
        ASSERT_LE(std::abs(m.torque.z), b.torque.limit.along * (1.0 + 1e-12));
        ASSERT_NEAR(m.release, b.release_damping * std::max(0.0, dot(b.release_along, linear(m.rate)) - b.release_from),
                    1e-12);
        for (std::size_t c = 0; c < b.channels.size(); ++c)
            ASSERT_EQ(m.lambda[c], channel_force(b.channels[c], dot(direction(b.channels[c]), m.rate), b.dt).lambda);
    }
    EXPECT_GT(released, 100);
    EXPECT_GT(saturated, 100);
}

// A tool at rest after a fault: the coupling is without stretch but for rounding, in a law with steep friction. No
// force is left that could measure the rest, so it counts absolutely.
TEST(Solve, ForcesOfRoundingAreInBalance) {
    kerf_channel flanks{}, edge = cut_along_z(417.0, 1e-5, 0.0);
    flanks.kind = KERF_FRICTION;
    flanks.d[2] = 0.148874;
    flanks.d[5] = 0.00182938;
    flanks.tau = 109.008;
    flanks.w = 1e-6;
    const kerf_channel channels[] = {flanks, edge};
    Balance b;
    b.force = {{-1.50963e-13, -7.59469e-14, 0.0}, {22.9807, 31.3725}, {2.0, 2.0}};
    b.torque = {{-1.10053e-15, 2.88316e-15, -8.96884e-16}, {0.0508279, 0.0508279}, {0.14, 0.1}};
    b.centre = {0, 0, -0.186};
    b.channels = channels;
    const Motion m = solve(b);
    EXPECT_TRUE(m.has_converged) << m.residual;
    EXPECT_LE(m.iterations, 10);
    EXPECT_LT(length(linear(m.rate)), 1e-12);
}

TEST(Solve, TakesFewIterationsEvenWhereTheCouplingSlides) {
    // The derivative of a saturated pull: without it, or with a wrong one, Newton's steps are short or none
    RandomLaw law{.random = std::mt19937_64(23), .channels = {}};
    std::vector<int> iterations;
    for (int i = 0; i < 2000; ++i) {
        Balance b = law.make();
        b.force.limit = 0.5 * length(b.force.pull) + 1e-3;
        iterations.push_back(solve(b).iterations);
    }
    std::sort(iterations.begin(), iterations.end());
    EXPECT_LE(iterations[1000], 5);
    EXPECT_LE(iterations[1980], 14);
    RecordProperty("median_iterations", iterations[1000]);
    RecordProperty("p99_iterations", iterations[1980]);
}

// ---- channels ----------------------------------------------------------------------------------------------------

TEST(Channel, EveryKindRisesWithTheRate) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> rate(-0.05, 0.05);
    kerf_channel c = cut_along_z(50.0, 1e-3, 2e3, 1e-5);
    c.k = 1e4;
    c.b = 3.0;
    for (std::uint32_t kind = KERF_CUT; kind <= KERF_HOLD; ++kind)
        for (const double delta : {-1e-5, 0.0, 2e-5}) {
            c.kind = kind;
            c.delta = delta;
            for (int i = 0; i < 1000; ++i) {
                double a = rate(random), b = rate(random);
                if (a > b) std::swap(a, b);
                EXPECT_LE(channel_force(c, a, 1e-3).lambda, channel_force(c, b, 1e-3).lambda + 1e-12);
            }
        }
}

TEST(Channel, ABadCoefficientIsNotSound) {
    const kerf_channel good = cut_along_z(1.0, 1e-3, 1.0);
    EXPECT_TRUE(is_sound(good));
    const double nan = std::nan("");
    for (double kerf_channel::*field : {&kerf_channel::tau, &kerf_channel::w, &kerf_channel::eta, &kerf_channel::gap,
                                        &kerf_channel::k, &kerf_channel::b})
        for (const double bad : {-1.0, nan, HUGE_VAL}) {
            kerf_channel c = good;
            c.*field = bad;
            EXPECT_FALSE(is_sound(c));
        }
    kerf_channel c = good;
    c.d[2] = 0.0;
    EXPECT_FALSE(is_sound(c)) << "no direction";
}

}  // namespace
}  // namespace kerf
