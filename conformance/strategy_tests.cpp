// SPDX-License-Identifier: Apache-2.0
// Levels 3 and 4: remeshing strategies, on cuts in a slab whose volumes follow from formulas.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/remesh/local_cutting.h"
#include "bone/remesh/remesh_child.h"
#include "bone/remesh/removal.h"
#include "conformance/parameter_sets.h"
#include "conformance/strategy_scenes.h"
#include "conformance/subject.h"
#include "conformance/test_groups.h"
#include "conformance/words.h"
#include "core/plugin/guarded_memory.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"
#include "core/plugin/process_state.h"

namespace kerf::conformance {

namespace {

constexpr double default_tolerance = 20e-6;  // [m] as the host requests it

std::vector<double> defaults_of(const kerf_component& strategy) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < strategy.param_count; ++i) values.push_back(strategy.params[i].def);
    return values;
}

/// The tolerance that a strategy states with these parameters [m].
double tolerance_of(const kerf_component& strategy, const std::vector<double>& parameters) {
    for (std::uint32_t i = 0; i < strategy.param_count; ++i)
        if (std::strcmp(strategy.params[i].id, "tolerance") == 0) return parameters[i];
    return default_tolerance;
}

/// How far its surfaces may be off [m], as the host allows.
double allowed_of(const kerf_component& strategy) {
    bone::RemeshRequest request;
    request.tolerance = default_tolerance;
    return bone::allowed_for(request, tolerance_of(strategy, defaults_of(strategy)));
}

/// An arena of zeros for a result. Only the pages that are written cost memory and time.
class ResultArena {
public:
    ResultArena() : bytes_(static_cast<unsigned char*>(std::calloc(size, 1))) {
        if (bytes_ == nullptr) throw std::bad_alloc();
    }
    [[nodiscard]] kerf_arena arena() const noexcept { return {bytes_.get(), size, 64}; }

private:
    struct Free {
        void operator()(unsigned char* bytes) const noexcept { std::free(bytes); }
    };
    static constexpr std::size_t size = 64u << 20;
    std::unique_ptr<unsigned char, Free> bytes_;
};

/// One call of a strategy, with its answer.
struct Call {
    kerf_status status = KERF_FAILED;
    kerf_remesh_out out{};
    bone::RemeshResult result;  ///< as the host reads it
};

/// Calls a strategy on arenas of its own.
Call call(const kerf_component& strategy, const bone::RemeshRequest& request, const std::vector<double>& parameters) {
    std::vector<unsigned char> from(bone::request_bytes(request));
    kerf_arena in_arena{from.data(), from.size(), 0};
    kerf_remesh_in in{};
    Call made;
    if (!bone::pack(request, parameters, in_arena, in)) return made;
    const ResultArena room;
    kerf_arena to = room.arena();
    made.out.size = sizeof made.out;
    void* const cache = strategy.remesher->cache_new != nullptr ? strategy.remesher->cache_new() : nullptr;
    made.status = call_remesh(strategy, in, in_arena, to, made.out, cache);
    if (strategy.remesher->cache_drop != nullptr && cache != nullptr) strategy.remesher->cache_drop(cache);
    made.result = bone::unpack(made.status, made.out, to);
    return made;
}
Call call(const kerf_component& strategy, const RemeshTask& task) {
    return call(strategy, task.request, defaults_of(strategy));
}

RemeshTask task_for(const Examination& exam, const RemeshScene& scene) {
    const kerf_component& strategy = *exam.subject->strategy;
    return task_of(scene, strategy.remesher->scope, tolerance_of(strategy, defaults_of(strategy)));
}

std::string on(const RemeshScene& scene) { return "On " + scene.name + ", "; }

/// Calls `judge(scene, task, call)` for each scene until the test has failed.
template <class Judge>
void on_each_scene(Examination& exam, const Judge& judge) {
    for (const RemeshScene& scene : remesh_scenes()) {
        const RemeshTask task = task_for(exam, scene);
        judge(scene, task, call(*exam.subject->strategy, task));
        if (exam.has_failed()) return;
    }
}

// ---- level 3: what it answers ---------------------------------------------------------------------------------------

bool is_known(kerf_status status) {
    return status == KERF_OK || (status >= KERF_REMESH_UNCHANGED && status <= KERF_REMESH_DECLINED);
}

void answers(Examination& exam) {
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask&, const Call& made) {
        if (!is_known(made.status))
            return exam.fail(on(scene) + "`remesh` returned " + std::to_string(made.status) +
                             ", expected KERF_OK or one of KERF_REMESH_….");
        if (made.status == KERF_OK && made.result.status != KERF_OK)
            exam.fail(on(scene) + "its result cannot be read: " + made.result.message + ".");
    });
}

std::string name_of(kerf_status status) {
    return status == KERF_REMESH_UNCHANGED   ? "unchanged"
           : status == KERF_REMESH_CANCELLED ? "cancelled"
           : status == KERF_REMESH_REFUSED   ? "refused"
                                             : "status " + std::to_string(status);
}

void refuses_in_words(Examination& exam) {
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask&, const Call& made) {
        if (made.status != KERF_REMESH_DECLINED && made.status != KERF_REMESH_REFUSED) return;
        const char* const end = static_cast<const char*>(std::memchr(made.out.message, 0, sizeof made.out.message));
        const std::string words(made.out.message, end != nullptr ? end : made.out.message + sizeof made.out.message);
        if (end == nullptr) return exam.fail(on(scene) + "its `message` does not end with NUL.");
        if (words.empty() || !is_utf8(words) || !is_plain(words))
            exam.fail(on(scene) + "it declines with the message " + quoted_plain(words) +
                      ", expected a sentence in plain UTF-8. Write why it makes no such cut.");
    });
}

void cuts_a_scene(Examination& exam) {
    int cut = 0;
    std::string reasons;
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask&, const Call& made) {
        cut += made.status == KERF_OK;
        if (!scene.is_in_air() && made.status != KERF_OK)
            reasons += (reasons.empty() ? "" : "; ") + scene.name + ": " +
                       (made.result.message.empty() ? name_of(made.status) : made.result.message);
    });
    if (cut == 0) return exam.fail("It cuts none of the kit's scenes. " + reasons + ".");
    exam.note("cuts " + std::to_string(cut) + " of " + std::to_string(remesh_scenes().size() - 1) + " scenes");
}

void makes_sound_meshes(Examination& exam) {
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask& task, const Call& made) {
        if (made.result.status != KERF_OK) return;
        const std::string flaw = task.request.locked.empty()
                                     ? bone::flaw_of_result(task.request, made.result.mesh)
                                     : bone::flaw_of_patch(task.request, made.result.mesh, task.ring);
        if (!flaw.empty()) exam.fail(on(scene) + "its mesh is refused: " + flaw + ".");
    });
}

void leaves_air_alone(Examination& exam) {
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask& task, const Call& made) {
        if (!scene.is_in_air() || made.result.status != KERF_OK) return;
        if (const double volume = bone::volume_between(made.result.mesh.mesh, task.request.base.mesh);
            std::abs(volume) > 1e-15)
            exam.fail(on(scene) + "it removes " + number(1e9 * volume) + " mm3, expected none. Return UNCHANGED.");
    });
}

/// As a run calls it: in the program beside this one, which gives each request memory at the same addresses.
std::unique_ptr<bone::RemeshChild> start(Examination& exam) {
    rlimit shared{};
    getrlimit(RLIMIT_FSIZE, &shared);
    shared.rlim_cur = shared.rlim_max;
    setrlimit(RLIMIT_FSIZE, &shared);
    std::error_code none;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    std::string error;
    auto child =
        bone::RemeshChild::start({(folder / "kerf-remesh").string(), exam.path, exam.subject->strategy->id}, error);
    if (child == nullptr) exam.fail("It cannot be started: " + error);
    return child;
}

void repeats(Examination& exam) {
    constexpr std::chrono::seconds limit(20);
    const auto first = start(exam), other = first != nullptr ? start(exam) : nullptr;
    if (other == nullptr) return;
    std::vector<bone::RemeshResult> results;
    for (const RemeshScene& scene : remesh_scenes()) {
        results.push_back(first->remesh(task_for(exam, scene).request, limit));
        if (results.back().status == KERF_FAILED)
            return exam.fail(on(scene) + "in a process of its own it gives no result: " + results.back().message + ".");
    }
    for (std::size_t i = results.size(); i-- > 0;)
        for (bone::RemeshChild* child : {first.get(), other.get()})
            if (const bone::RemeshResult again = child->remesh(task_for(exam, remesh_scenes()[i]).request, limit);
                again.status != results[i].status || !bone::has_same_bytes(again.mesh, results[i].mesh))
                return exam.fail(on(remesh_scenes()[i]) +
                                 "the same request gives another result when it is made again, " +
                                 (child == first.get() ? "after others" : "in another process") +
                                 ". It must depend on the request alone.");
}

void works_over_its_parameters(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    const auto sets = parameter_sets(strategy, 6);
    for (const ParameterSet& set : sets)
        for (const RemeshScene& scene : {remesh_scenes().front(), remesh_scenes().back()}) {
            const RemeshTask task = task_of(scene, strategy.remesher->scope, tolerance_of(strategy, set.values));
            const Call made = call(strategy, task.request, set.values);
            if (!is_known(made.status))
                return exam.fail("With " + set.name + ", on " + scene.name + ", `remesh` returned " +
                                 std::to_string(made.status) + ".");
            if (made.result.status != KERF_OK) continue;
            const std::string flaw = task.request.locked.empty()
                                         ? bone::flaw_of_result(task.request, made.result.mesh)
                                         : bone::flaw_of_patch(task.request, made.result.mesh, task.ring);
            if (!flaw.empty())
                return exam.fail("With " + set.name + ", on " + scene.name + ", its mesh is refused: " + flaw + ".");
        }
    exam.note(std::to_string(sets.size()) + " sets of parameters");
}

// ---- level 3: its memory and its process
// ------------------------------------------------------------------------------

void reads_only_its_request(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    const RemeshTask task = task_for(exam, remesh_scenes().front());
    std::vector<unsigned char> packed(bone::request_bytes(task.request));
    kerf_arena arena{packed.data(), packed.size(), 0};
    kerf_remesh_in in{};
    if (!bone::pack(task.request, defaults_of(strategy), arena, in)) return exam.skip("the request does not fit");
    GuardedMemory memory;
    unsigned char* const guarded =
        memory.copy(packed.data(), arena.used, "it read beyond the end of the request's arena");
    memory.make_read_only("it wrote to the request's arena, which is the host's");
    const kerf_arena from{guarded, arena.used, arena.used};
    const ResultArena room;
    kerf_arena to = room.arena();
    kerf_remesh_out out{};
    out.size = sizeof out;
    static_cast<void>(call_remesh(strategy, in, from, to, out, nullptr));
}

void keeps_within_its_arena(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    const RemeshTask task = task_for(exam, remesh_scenes().front());
    std::vector<unsigned char> packed(bone::request_bytes(task.request));
    kerf_arena from{packed.data(), packed.size(), 0};
    kerf_remesh_in in{};
    if (!bone::pack(task.request, defaults_of(strategy), from, in)) return exam.skip("the request does not fit");
    for (const std::size_t room : {128u, 4096u}) {
        GuardedMemory memory;
        auto* const guarded =
            static_cast<unsigned char*>(memory.allocate(room, 8, "it wrote beyond the end of the result's arena"));
        kerf_arena to{guarded, room, 64};
        kerf_remesh_out out{};
        out.size = sizeof out;
        const kerf_status status = call_remesh(strategy, in, from, to, out, nullptr);
        if (status == KERF_OK && bone::unpack(status, out, to).status == KERF_OK) continue;  // it is that small
        if (status == KERF_OK)
            return exam.fail("With an arena of " + std::to_string(room) +
                             " bytes it returns 0 (KERF_OK) and a mesh that does not lie in it. Return "
                             "KERF_REMESH_REFUSED where the arena has no room.");
    }
}

void gives_way(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    const RemeshTask task = task_for(exam, remesh_scenes().front());
    std::vector<unsigned char> packed(bone::request_bytes(task.request));
    kerf_arena from{packed.data(), packed.size(), 0};
    kerf_remesh_in in{};
    if (!bone::pack(task.request, defaults_of(strategy), from, in)) return exam.skip("the request does not fit");
    const std::uint32_t cancelled = 1;
    std::memcpy(packed.data() + in.cancel, &cancelled, sizeof cancelled);
    const ResultArena room;
    kerf_arena to = room.arena();
    kerf_remesh_out out{};
    out.size = sizeof out;
    const kerf_status status = call_remesh(strategy, in, from, to, out, nullptr);
    if (!is_known(status))
        exam.fail("A request that is cancelled gives " + std::to_string(status) +
                  ", expected KERF_REMESH_CANCELLED, or any answer soon.");
}

void leaves_its_process(Examination& exam) {
    const ProcessState before = process_state();
    static_cast<void>(call(*exam.subject->strategy, task_for(exam, remesh_scenes().front())));
    const ProcessState after = process_state();
    if (take_changed_floating_point(*exam.subject->strategy))
        return exam.fail("A call leaves another rounding mode. Restore it.");
    if (before.locale != after.locale) return exam.fail("A call leaves another locale. Restore it.");
    if (const StateChange change = change_between(before.shared, after.shared); change.has_happened())
        return exam.fail("A call changes " + plain(change.text()) + ". Restore it.");
    if (after.files.size() > before.files.size()) return exam.fail("A call leaves a file open. Close it.");
    if (after.threads > before.threads) exam.fail("A call leaves a thread running. Join it.");
}

// ---- level 4: what it removes
// ----------------------------------------------------------------------------------------

void removes_what_is_swept(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask& task, const Call& made) {
        const double allowed = allowed_of(strategy);
        std::string flaw;
        if (made.status == KERF_REMESH_UNCHANGED) flaw = bone::flaw_of_unchanged(task.request, allowed);
        if (made.result.status == KERF_OK) flaw = bone::flaw_of_removal(task.request, made.result.mesh, allowed);
        if (!flaw.empty()) exam.fail(on(scene) + flaw + ". Its tolerance allows " + number(1e3 * allowed) + " mm.");
    });
}

void removes_the_volume(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    double worst = 0.0;
    on_each_scene(exam, [&](const RemeshScene& scene, const RemeshTask& task, const Call& made) {
        if (made.result.status != KERF_OK || scene.is_in_air()) return;
        const double allowed = tolerance_of(strategy, defaults_of(strategy)) * scene.walls + 1e-13;
        const double volume = bone::volume_between(made.result.mesh.mesh, task.request.base.mesh);
        worst = std::max(worst, std::abs(volume / scene.volume - 1.0));
        if (std::abs(volume - scene.volume) > allowed)
            exam.fail(on(scene) + "it removes " + number(1e9 * volume) + " mm3, expected " +
                      number(1e9 * scene.volume) + " mm3 within " + number(1e9 * allowed) +
                      " mm3: its tolerance on all walls.");
    });
    exam.note("off by " + number(100.0 * worst) + " % at most");
}

/// The surface of a slab that a strategy cuts step by step, as a run has it.
class SteppedSurface {
public:
    SteppedSurface(const kerf_component& strategy, const RemeshScene& scene)
        : strategy_(&strategy),
          is_whole_(strategy.remesher->scope == KERF_REMESH_WHOLE),
          request_(task_of(scene, KERF_REMESH_WHOLE, default_tolerance).request),
          patches_(request_.base, {&scene.solid}, default_tolerance,
                   {{{strategy.id, [this](const bone::RemeshRequest& request) { return answer_to(request); },
                      tolerance_of(strategy, defaults_of(strategy))}}}) {}

    /// Returns whether the strategy made the cut; `why` if not.
    [[nodiscard]] bool cut(const bone::CutStretch& stretch, std::string& why) {
        if (!is_whole_) return patches_.cut(stretch, why);
        request_.cuts = {stretch};
        constexpr std::uint64_t max_seeds = 5;  // as in a run
        for (request_.nudge_seed = 0; request_.nudge_seed < max_seeds; ++request_.nudge_seed) {
            bone::RemeshResult result = answer_to(request_);
            why = result.message;
            if (result.status == KERF_REMESH_UNCHANGED) return true;
            if (result.status == KERF_REMESH_DECLINED) return false;
            if (result.status == KERF_OK) why = bone::flaw_of_result(request_, result.mesh);
            if (result.status == KERF_OK && why.empty())
                why = bone::flaw_of_removal(request_, result.mesh, allowed_of(*strategy_));
            if (result.status != KERF_OK || !why.empty()) continue;
            removed_ += bone::volume_between(result.mesh.mesh, request_.base.mesh);
            request_.base = std::move(result.mesh);
            return true;
        }
        return false;
    }
    [[nodiscard]] double removed() const { return is_whole_ ? removed_ : patches_.removed(); }  ///< [m³]
    [[nodiscard]] bool is_declined() const { return is_declined_; }

private:
    bone::RemeshResult answer_to(const bone::RemeshRequest& request) {
        bone::RemeshResult result = call(*strategy_, request, defaults_of(*strategy_)).result;
        is_declined_ = is_declined_ || result.status == KERF_REMESH_DECLINED;
        return result;
    }

    const kerf_component* strategy_;
    bool is_whole_, is_declined_ = false;
    bone::RemeshRequest request_;
    bone::LocalCutting patches_;
    double removed_ = 0.0;
};

void goes_on(Examination& exam) {
    const kerf_component& strategy = *exam.subject->strategy;
    const int steps = strategy.remesher->scope == KERF_REMESH_WHOLE ? 4 : 24;
    const std::string in_steps = "in " + std::to_string(steps) + " steps";
    int cut = 0;
    for (const RemeshScene& scene : remesh_scenes()) {
        if (scene.is_in_air()) continue;
        SteppedSurface surface(strategy, scene);
        const Vec3 way = scene.cut.to.position - scene.cut.from.position;
        const auto pose_at = [&](int step) {
            return Pose{scene.cut.from.position + (static_cast<double>(step) / steps) * way, scene.cut.from.rotation};
        };
        std::string why;
        for (int step = 0; step < steps && !surface.is_declined(); ++step)
            if (!surface.cut({pose_at(step), pose_at(step + 1), 0}, why) && !surface.is_declined())
                return exam.fail(on(scene) + in_steps + ", it fails on step " + std::to_string(step + 1) +
                                 ", on the surface that it has left: " + why + ".");
        if (surface.is_declined()) continue;
        ++cut;
        const double allowed = tolerance_of(strategy, defaults_of(strategy)) * scene.walls + 1e-13;
        if (std::abs(surface.removed() - scene.volume) > allowed)
            return exam.fail(on(scene) + in_steps + ", it removes " + number(1e9 * surface.removed()) +
                             " mm3, expected " + number(1e9 * scene.volume) + " mm3 within " + number(1e9 * allowed) +
                             " mm3: its tolerance on all walls.");
    }
    if (cut == 0) return exam.skip("it declines a step of each scene");
    exam.note(std::to_string(cut) + (cut == 1 ? " scene " : " scenes ") + in_steps);
}

constexpr Test tests[] = {
    {"remesh.status", 3, Scope::strategy, "It answers with a status of the boundary, and a mesh in its arena.",
     &answers, "describe.tables", 20},
    {"remesh.words", 3, Scope::strategy, "It says why it declines.", &refuses_in_words, "remesh.status", 20},
    {"remesh.cuts", 3, Scope::strategy, "It cuts at least one of the kit's scenes.", &cuts_a_scene, "remesh.status",
     20},
    {"remesh.sound", 3, Scope::strategy, "Its meshes are closed, keep their border, and none of their faces cross.",
     &makes_sound_meshes, "remesh.status", 20},
    {"remesh.air", 3, Scope::strategy, "A pass in air leaves the mesh as it was.", &leaves_air_alone, "remesh.status",
     20},
    {"remesh.repeats", 3, Scope::strategy, "The same request gives the same bytes.", &repeats, "remesh.status", 30},
    {"remesh.range", 3, Scope::strategy, "It works over the ranges of its parameters.", &works_over_its_parameters,
     "remesh.sound", 60},
    {"remesh.reads", 3, Scope::strategy, "It reads its request, and no more.", &reads_only_its_request, "remesh.status",
     20},
    {"remesh.arena", 3, Scope::strategy, "It writes into its arena, and no more.", &keeps_within_its_arena,
     "remesh.status", 20},
    {"remesh.cancel", 3, Scope::strategy, "It returns when its request is cancelled.", &gives_way, "remesh.status", 20},
    {"remesh.process", 3, Scope::strategy, "It leaves rounding, locale, files and threads as they were.",
     &leaves_its_process, "remesh.status", 20},
    {"remesh.removal", 4, Scope::strategy, "It removes what the tool sweeps, and nothing else.", &removes_what_is_swept,
     "remesh.sound", 30},
    {"remesh.volume", 4, Scope::strategy, "The volumes that it removes are those of formulas.", &removes_the_volume,
     "remesh.sound", 30},
    {"remesh.steps", 4, Scope::strategy, "It cuts in steps, each on the surface that the ones before it have left.",
     &goes_on, "remesh.volume", 60},
};

}  // namespace

std::span<const Test> strategy_tests() { return tests; }

}  // namespace kerf::conformance
