// SPDX-License-Identifier: Apache-2.0
// Level 3: whether a law answers the same again: nothing but its inputs and its state may count.
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

/// A law's answer as it was.
struct Answer {
    std::vector<kerf_channel> channels;
    kerf_law law{};

    explicit Answer(const LawWalk& walk) : channels(walk.channels().begin(), walk.channels().end()), law(walk.law()) {}
    [[nodiscard]] std::string difference(const Answer& other) const {
        if (law.count != other.law.count)
            return std::to_string(law.count) + " and then " + std::to_string(other.law.count) + " channels";
        for (std::size_t i = 0; i < channels.size(); ++i)
            if (std::memcmp(&channels[i], &other.channels[i], sizeof(kerf_channel)) != 0)
                return "another " + name_of(channels[i], i);
        if (std::memcmp(law.wrench, other.law.wrench, sizeof law.wrench) != 0) return "another wrench";
        return {};
    }
};

void is_pure(Examination& exam) {
    walk(exam, {}, eventful_path(), [&](LawWalk& law) {
        const Answer first(law);
        static_cast<void>(law.resist());
        if (const std::string difference = first.difference(Answer(law)); !difference.empty())
            exam.fail("Called twice with the same inputs and the same state, `resist` returns " + difference + ", " +
                      law.where() + ".");
        return !exam.has_failed();
    });
}

void keeps_its_state(Examination& exam) {
    WalkSettings settings;
    settings.keeps_state = true;
    walk(exam, settings, eventful_path(), [&](LawWalk& law) {
        const auto before = law.state_before_resist();
        for (std::size_t i = 0; i < before.size() && !exam.has_failed(); ++i)
            if (law.state()[i] != before[i])
                exam.fail("`resist` changes byte " + std::to_string(i) + " of its state, " + law.where() +
                          ". The state is const there: only `commit` may change it.");
        return !exam.has_failed();
    });
}

void is_not_disturbed(Examination& exam) {
    PlaneBone::Settings settings;
    settings.shape = PlaneBone::Shape::air;
    PlaneBone air(settings);
    settings.shape = PlaneBone::Shape::endless;
    settings.density = 2500.0;
    PlaneBone endless(settings);
    walk(exam, {}, eventful_path(), [&](LawWalk& law) {
        const Answer first(law);
        static_cast<void>(law.resist_in(endless));
        static_cast<void>(law.resist_in(air));
        static_cast<void>(law.resist());
        if (const std::string difference = first.difference(Answer(law)); !difference.empty())
            exam.fail("After it was called in other bone, `resist` returns " + difference + ", " + law.where() +
                      ". It must remember nothing between its calls.");
        return !exam.has_failed();
    });
}

/// All that a law returns along a path, as one number.
std::uint64_t hash_of_walk(Examination& exam, const WalkSettings& settings, const AtPose& before_commit = {}) {
    std::uint64_t hash = 14695981039346656037ull;
    walk(
        exam, settings, short_path(),
        [&](LawWalk& law) {
            law.add_to(hash);
            return !before_commit || before_commit(law);
        },
        [&](LawWalk& law) {
            law.add_to(hash);
            return true;
        });
    return hash;
}

void begins_again(Examination& exam) {
    const std::uint64_t first = hash_of_walk(exam, {}), second = hash_of_walk(exam, {});
    if (first != second)
        exam.fail("After `begin`, the same path ends otherwise than the first time: something outlives `begin`, as a "
                  "global variable does. Keep it in the state.");
}

void begins_whole(Examination& exam) {
    WalkSettings settings;
    const std::uint64_t first = hash_of_walk(exam, settings);
    for (const int fill : {0x00, 0xff, 0x3f}) {
        settings.state_fill = static_cast<unsigned char>(fill);
        if (hash_of_walk(exam, settings) != first)
            return exam.fail("What it returns depends on what the memory of its state held before `begin`: `begin` "
                             "must write all of it.");
    }
}

void has_instances(Examination& exam) {
    const std::uint64_t alone = hash_of_walk(exam, {});
    LawWalk other(*exam.subject);
    const std::vector<Pose> path = eventful_path();
    std::size_t at = 0;
    const auto disturb = [&](LawWalk&) {
        if (!other.refusal().empty()) return true;
        if (at == 0) other.begin(path[300]);
        static_cast<void>(other.resist());
        static_cast<void>(other.commit(path[300 + at++ % 300]));
        return true;
    };
    if (hash_of_walk(exam, {}, disturb) != alone)
        exam.fail("A second instance that runs in between changes what the first returns: they share something beside "
                  "their states. Keep it in the state.");
}

void may_be_moved(Examination& exam) {
    const std::uint64_t first = hash_of_walk(exam, {});
    int n = 0;
    const std::uint64_t moved = hash_of_walk(exam, {}, [&](LawWalk& law) {
        if (++n % 50 == 0) law.move_state();
        return true;
    });
    if (first != moved)
        exam.fail("What it returns changes when the host moves its state: the state holds a pointer into itself.");
}

void may_change_threads(Examination& exam) {
    const auto path = short_path();
    const auto run = [&](bool is_on_threads) {
        std::uint64_t hash = 14695981039346656037ull;
        LawWalk law(*exam.subject);
        if (!law.refusal().empty()) return hash;
        law.begin(path.front());
        law.run_up();
        const auto stretch = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) {
                static_cast<void>(law.resist());
                static_cast<void>(law.commit(path[i + 1]));
                law.add_to(hash);
            }
        };
        const std::size_t half = path.size() / 2;
        if (is_on_threads) {
            std::thread(stretch, 0, half).join();
            std::thread(stretch, half, path.size() - 1).join();
        } else {
            stretch(0, path.size() - 1);
        }
        return hash;
    };
    if (run(false) != run(true))
        exam.fail("What it returns changes when its calls come from another thread than `begin`: it keeps something in "
                  "a thread's memory. Keep it in the state.");
}

constexpr Test tests[] = {
    {"law.pure", 3, Scope::law, "The same call returns the same bits.", &is_pure, "law.answers"},
    {"law.state_kept", 3, Scope::law, "`resist` leaves its state as it was.", &keeps_its_state, "law.answers"},
    {"law.undisturbed", 3, Scope::law, "Calls in other bone in between change nothing.", &is_not_disturbed, "law.pure"},
    {"law.begins_again", 3, Scope::law, "After `begin` everything is as the first time.", &begins_again, "law.pure"},
    {"law.begins_whole", 3, Scope::law, "`begin` writes all of the state that counts.", &begins_whole,
     "law.begins_again"},
    {"law.instances", 3, Scope::law, "Two instances do not know of each other.", &has_instances, "law.begins_again"},
    {"law.moved", 3, Scope::law, "The host may move the state.", &may_be_moved, "law.begins_again"},
    {"law.threads", 3, Scope::law, "Its calls may come from another thread.", &may_change_threads, "law.begins_again"},
};

}  // namespace

std::span<const Test> repeat_tests() { return tests; }

}  // namespace kerf::conformance
