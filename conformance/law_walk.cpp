// SPDX-License-Identifier: Apache-2.0
#include "conformance/law_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plugin/plugin_call.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

constexpr std::size_t slack = 512;  // [B] on either side of plain memory

}  // namespace

LawWalk::LawWalk(const Subject& subject, const WalkSettings& settings)
    : subject_(subject), settings_(settings), setup_(subject.setup()), bone_(settings.bone), air_([&] {
          PlaneBone::Settings air = settings.bone;
          air.shape = PlaneBone::Shape::air;
          return air;
      }()) {
    if (settings.tool_parameters) setup_.tool_parameters = *settings.tool_parameters;
    if (settings.force_parameters) setup_.force_parameters = *settings.force_parameters;
    if (settings.drives) setup_.drives = *settings.drives;
    if (!outline_of(setup_, outline_, refusal_)) return;

    allocate();
    move_state();
}

/// Inputs and outputs. The memory of before stays as it is.
void LawWalk::allocate() {
    const Guards& guards = settings_.guards;
    guarded_ = std::make_unique<GuardedMemory>();
    const auto plain = [&](std::size_t size, std::size_t alignment) {
        std::size_t space = size + alignment + 2 * slack;
        plain_.push_back(std::make_unique<std::byte[]>(space));
        void* at = plain_.back().get() + slack;
        return std::align(alignment, size, at, space);
    };
    const auto input = [&]<class T>(const T* values, std::size_t count, const char* beyond,
                                    const char* written) -> const T* {
        if (!guards.inputs && !guards.input_ends) {
            auto* const to = static_cast<T*>(plain(count * sizeof(T), alignof(T)));
            std::copy(values, values + count, to);
            return to;
        }
        constexpr std::size_t room = 64;  // values behind the last, where their end is not guarded
        const std::size_t behind = guards.input_ends ? 0 : room;
        auto* const to = static_cast<T*>(guarded_->allocate((count + behind) * sizeof(T), alignof(T), beyond));
        std::copy(values, values + count, to);
        if (guards.inputs) guarded_->make_read_only(written);
        return to;
    };
    const auto output = [&](std::size_t size, std::size_t alignment, const char* beyond) {
        return guards.output_ends ? guarded_->allocate(size, alignment, beyond) : plain(size, alignment);
    };

    in_ = tick_in_of(setup_, bone_.query(), settings_.dt);
    in_.tool_params = input(setup_.tool_parameters.data(), setup_.tool_parameters.size(),
                            "it read beyond the end of `tool_params`; the tool declares fewer parameters",
                            "it wrote to `tool_params`, which is the host's");
    in_.force_params = input(setup_.force_parameters.data(), setup_.force_parameters.size(),
                             "it read beyond the end of `force_params`; the law declares fewer parameters",
                             "it wrote to `force_params`, which is the host's");
    in_.drive = input(setup_.drives.data(), setup_.drives.size(),
                      "it read beyond the end of `drive`; the tool declares fewer drives",
                      "it wrote to `drive`, which is the host's");
    in_.bound = setup_.bound.empty() ? nullptr
                                     : input(setup_.bound.data(), setup_.bound.size(),
                                             "it read beyond the end of `bound`; the law declares fewer needs",
                                             "it wrote to `bound`, which is the host's");
    solid_ = outline_.solid();
    solid_.profile = input(outline_.profile.data(), outline_.profile.size(), "it read beyond the end of the outline",
                           "it wrote to the outline, which is the host's");
    in_.outline = input(&solid_, 1, "it read beyond `outline`", "it wrote to `outline`, which is the host's");

    law_ = static_cast<kerf_law*>(output(sizeof(kerf_law), alignof(kerf_law), "it wrote beyond `kerf_law`"));
    *law_ = {};
    law_->size = sizeof(kerf_law);
    law_->channel =
        static_cast<kerf_channel*>(output(KERF_MAX_CHANNELS * sizeof(kerf_channel), alignof(kerf_channel),
                                          "it wrote a channel beyond the 16 that there are (KERF_MAX_CHANNELS)"));
    out_ = static_cast<kerf_commit_out*>(
        output(sizeof(kerf_commit_out), alignof(kerf_commit_out), "it wrote beyond `kerf_commit_out`"));
    *out_ = {};
    out_->size = sizeof(kerf_commit_out);
    out_->action = static_cast<kerf_action*>(output(KERF_MAX_ACTIONS * sizeof(kerf_action), alignof(kerf_action),
                                                    "it wrote an action beyond the 8 that there are"));
    out_->thread = thread_ = static_cast<kerf_thread*>(
        output(sizeof(kerf_thread), alignof(kerf_thread), "it wrote beyond the one `kerf_thread`"));
    out_->signal = static_cast<double*>(output(std::max(subject_.force->force->signal_count, 1u) * sizeof(double),
                                               alignof(double), "it wrote a signal that it does not declare"));
    fill_outputs();
}

void LawWalk::move_memory() {
    const kerf_law law = *law_;
    const std::vector<kerf_channel> channels(law_->channel, law_->channel + KERF_MAX_CHANNELS);
    retired_.push_back(std::move(guarded_));
    allocate();
    retired_.back()->forbid("it kept a pointer to memory of an earlier call");
    kerf_channel* const to = law_->channel;
    *law_ = law;
    law_->channel = to;
    std::copy(channels.begin(), channels.end(), to);
    in_.tick = tick_;
}

void LawWalk::move_state() {
    const kerf_force& force = *subject_.force->force;
    void* to = nullptr;
    std::unique_ptr<std::byte[]> plain;
    if (settings_.guards.state_end) {
        to = guarded_state_.allocate(force.state_size, force.state_align,
                                     "it wrote or read beyond the end of its state");
    } else {
        std::size_t space = force.state_size + force.state_align + 2 * slack;
        plain = std::make_unique<std::byte[]>(space);
        to = plain.get() + slack;
        to = std::align(force.state_align, force.state_size, to, space);
    }
    if (state_ != nullptr) {
        std::copy_n(static_cast<std::byte*>(state_), force.state_size, static_cast<std::byte*>(to));
        std::fill_n(static_cast<unsigned char*>(state_), force.state_size, settings_.state_fill);
    }
    if (plain_state_ != nullptr) kept_states_.push_back(std::move(plain_state_));  // what points there reads garbage
    plain_state_ = std::move(plain);
    state_ = to;
}

void LawWalk::before_call() noexcept {
    if (settings_.is_watched) start_watching();
}
void LawWalk::after_call(const char* call) {
    if (!settings_.is_watched) return;
    const Watched seen = stop_watching();
    for (std::size_t kind = 0; kind < offences_.size(); ++kind)
        if (seen.function[kind] != nullptr && offences_[kind].function == nullptr)
            offences_[kind] = {seen.function[kind], call, where()};
}

void LawWalk::add_to(std::uint64_t& hash) const noexcept {
    const auto add = [&](const void* bytes, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ull;
    };
    for (const kerf_channel& channel : channels()) add(&channel, sizeof channel);
    add(law_->wrench, sizeof law_->wrench);
    for (const double signal : signals()) add(&signal, sizeof signal);
    for (std::uint32_t i = 0; i < std::min(out_->action_count, KERF_MAX_ACTIONS); ++i)
        add(&out_->action[i], sizeof(kerf_action));
    if (out_->thread_count > 0) add(thread_, sizeof(kerf_thread));
}

LawWalk::~LawWalk() = default;

void LawWalk::fill_outputs() noexcept {
    law_->count = 0;
    std::fill(std::begin(law_->wrench), std::end(law_->wrench), 0.0);
    std::fill(std::begin(law_->note), std::end(law_->note), static_cast<unsigned char>(0));
    for (std::uint32_t i = 0; i < KERF_MAX_CHANNELS; ++i) law_->channel[i] = {};
}

void LawWalk::begin(const Pose& pose) {
    const std::span<unsigned char> bytes = state();
    std::fill(bytes.begin(), bytes.end(), settings_.state_fill);
    tick_ = 0;
    bone_.forget_threads();
    place(pose);
    in_.tick = 0;
    before_call();
    call_begin(*subject_.force, in_, state_);
    after_call("begin");
}

void LawWalk::place(const Pose& pose) noexcept {
    pose_ = pose;
    bone_.place(pose);
}

void LawWalk::run_up() {
    constexpr int longest = 600;  // [ticks] a motor is given
    kerf_advance advance{};
    advance.size = sizeof advance;
    in_.bone = &air_.query();
    for (int i = 0; i < longest; ++i) {
        in_.tick = tick_++;
        out_->action_count = out_->thread_count = 0;
        before_call();
        const kerf_status status = call_commit(*subject_.force, in_, advance, state_, *out_);
        after_call("commit");
        if (status != KERF_OK) break;
    }
    in_.bone = &bone_.query();
}

kerf_status LawWalk::resist() {
    fill_outputs();
    in_.tick = tick_;
    in_.bone = &bone_.query();
    if (settings_.keeps_state) state_before_.assign(state().begin(), state().end());
    before_call();
    const kerf_status status = call_resist(*subject_.force, in_, state_, *law_);
    after_call("resist");
    return status;
}

kerf_status LawWalk::resist_in(PlaneBone& bone) {
    fill_outputs();
    kerf_tick_in in = in_;
    in.bone = &bone.query();
    return call_resist(*subject_.force, in, state_, *law_);
}

Vec6 LawWalk::rate_to(const Pose& next) const noexcept {
    const Quat back = conjugate(pose_.rotation);
    const Vec3 linear = (1.0 / settings_.dt) * rotate(back, next.position - pose_.position);
    const Vec3 angular = (1.0 / settings_.dt) * small_rotation_vector(back * next.rotation);
    return make_vec6(linear, angular);
}

Vec6 LawWalk::force_at(const Vec6& rate) const noexcept {
    Vec6 force{};
    for (std::size_t i = 0; i < 6; ++i) force[i] = law_->wrench[i];
    for (const kerf_channel& c : channels()) {
        const double lambda = channel_force(c, dot(direction(c), rate), settings_.dt).lambda;
        for (std::size_t i = 0; i < 6; ++i) force[i] += lambda * (c.follow[i] - c.d[i]);
    }
    return force;
}

kerf_status LawWalk::commit(const Pose& next) {
    const Vec6 rate = rate_to(next);
    std::array<double, KERF_MAX_CHANNELS> lambda{};
    kerf_advance advance{};
    advance.size = sizeof advance;
    advance.channel_count = static_cast<std::uint32_t>(channels().size());
    advance.channel = law_->channel;
    advance.lambda = lambda.data();
    advance.note = law_->note;
    for (std::size_t i = 0; i < 6; ++i) advance.rate[i] = rate[i], advance.following[i] = law_->wrench[i];
    for (std::size_t c = 0; c < channels().size(); ++c) {
        lambda[c] = channel_force(channels()[c], dot(direction(channels()[c]), rate), settings_.dt).lambda;
        for (std::size_t i = 0; i < 6; ++i) advance.following[i] += lambda[c] * channels()[c].follow[i];
    }
    out_->action_count = out_->thread_count = 0;
    out_->thread = thread_;
    *thread_ = {};
    const std::uint32_t signal_count = subject_.force->force->signal_count;
    std::fill(out_->signal, out_->signal + signal_count, std::numeric_limits<double>::quiet_NaN());
    in_.tick = tick_++;
    before_call();
    const kerf_status status = call_commit(*subject_.force, in_, advance, state_, *out_);
    after_call("commit");
    if (out_->thread_count > 0) static_cast<void>(bone_.leave(*thread_));
    place(next);
    return status;
}

std::string LawWalk::where() const {
    const Vec3 along = rotate(pose_.rotation, {0, 0, 1});
    std::string text = "at tick " + std::to_string(tick_) + ", the tip " + number(1e3 * std::abs(pose_.position.z)) +
                       " mm " + (pose_.position.z > 0.0 ? "above" : "below") + " the face";
    const double tilt = std::acos(std::clamp(-along.z, -1.0, 1.0)) * 180.0 / pi;
    if (tilt > 0.5) text += ", " + number(std::round(tilt)) + "° askew";
    return text;
}

// ---- paths --------------------------------------------------------------------------------------------------------

Pose at_depth(double depth, double tilt, Vec3 aside) {
    const Vec3 along{std::sin(tilt), 0, -std::cos(tilt)};
    return {aside + depth * along, quat_between({0, 0, 1}, along)};
}

namespace {

constexpr double above = -0.6e-3, deep = 2e-3;  // [m]

/// Poses from one depth to the other, `step` [m] apart.
void go(std::vector<Pose>& path, double from, double to, double step, double tilt = 0.0) {
    const int count = std::max(1, static_cast<int>(std::lround(std::abs(to - from) / step)));
    for (int i = 0; i < count; ++i) path.push_back(at_depth(from + (to - from) * i / count, tilt));
}

}  // namespace

std::vector<Pose> eventful_path() {
    std::vector<Pose> path;
    go(path, above, deep, 4e-6);
    for (int i = 0; i < 30; ++i) path.push_back(at_depth(deep));
    for (int i = 0; i < 60; ++i) path.push_back(at_depth(deep, 0.0, {5e-6 * i, 0, 0}));
    for (int i = 60; i > 0; --i) path.push_back(at_depth(deep, 0.0, {5e-6 * i, 0, 0}));
    for (int i = 0; i < 60; ++i) path.push_back(at_depth(deep, 0.0, {0, -5e-6 * i, 0}));
    for (int i = 0; i < 60; ++i) {  // about the shaft
        Pose turned = at_depth(deep, 0.0, {0, -3e-4, 0});
        turned.rotation = turned.rotation * quat_from_rotation_vector({0, 0, 5e-3 * i});
        path.push_back(turned);
    }
    go(path, deep, above, 50e-6);
    constexpr double askew = 25.0 * pi / 180.0;
    go(path, above, 0.5e-3, 10e-6, askew);
    for (int i = 0; i < 60; ++i) path.push_back(at_depth(0.5e-3, askew, {0, 10e-6 * i, 0}));
    go(path, 0.5e-3, above, 50e-6, askew);
    return path;
}

std::vector<Pose> short_path() {
    std::vector<Pose> path;
    go(path, above, 1e-3, 4e-6);
    for (int i = 0; i < 60; ++i) path.push_back(at_depth(1e-3, 0.0, {5e-6 * i, 0, 0}));
    for (int i = 0; i < 60; ++i) path.push_back(at_depth(1e-3, 0.0, {3e-4, 5e-6 * i, 0}));
    go(path, 1e-3, above, 20e-6);
    return path;
}

std::vector<Pose> coarse_path() {
    std::vector<Pose> path;
    go(path, above, 1e-3, 40e-6);
    for (int i = 0; i < 10; ++i) path.push_back(at_depth(1e-3, 0.0, {20e-6 * i, 0, 0}));
    for (int i = 0; i < 10; ++i) path.push_back(at_depth(1e-3, 0.02 * i, {2e-4, 20e-6 * i, 0}));
    go(path, 1e-3, above, 80e-6);
    return path;
}

void walk(Examination& exam, const WalkSettings& settings, const std::vector<Pose>& path, const AtPose& after_resist,
          const AtPose& after_commit) {
    LawWalk law(*exam.subject, settings);
    if (!law.refusal().empty()) return exam.skip(law.refusal());
    law.begin(path.front());
    law.run_up();
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        if (const kerf_status status = law.resist(); status != KERF_OK)
            return exam.fail("`resist` " + name_of_status(status) + " " + law.where() + ".");
        if (after_resist && !after_resist(law)) return;
        if (const kerf_status status = law.commit(path[i + 1]); status != KERF_OK)
            return exam.fail("`commit` " + name_of_status(status) + " " + law.where() + ".");
        if (after_commit && !after_commit(law)) return;
    }
}

}  // namespace kerf::conformance
