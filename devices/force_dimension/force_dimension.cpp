// SPDX-License-Identifier: Apache-2.0
#include "force_dimension.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "base.h"
#include "devices/realtime/raised_thread.h"
#include "kerf/device_exchange.hpp"

namespace kerf::force_dimension {

namespace {

constexpr auto period =
    std::chrono::microseconds(500);       // of an exchange at least: the calls of a real base take longer
constexpr double between_checks = 0.1;    // [s] of why forces are off
constexpr double between_searches = 1.0;  // [s] of a lost base

/// Exchanges poses and forces with a base on a thread of its own.
class Link final : public DeviceLink {
public:
    /// Throws std::runtime_error if the base cannot be opened.
    Link(SharedLibrary library, const Dhd& dhd, const std::string& serial, bool may_move)
        : library_(std::move(library)), dhd_(dhd), base_(dhd_) {
        if (const std::string fault = base_.open(serial, may_move); !fault.empty()) throw std::runtime_error(fault);
        serial_ = base_.serial();
        facts_ = base_.facts();
        thread_ = std::thread([this] { exchange(); });
    }
    ~Link() override {
        is_ending_.store(true, std::memory_order_relaxed);
        thread_.join();
    }

    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return exchange_.read(); }
    void write(const kerf_device_command& command) noexcept override { exchange_.write(command); }
    [[nodiscard]] std::string problem() override {
        const std::lock_guard lock(mutex_);
        return problem_;
    }

private:
    void exchange() noexcept {
        raise_device_thread();
        kerf_device_state state = state_without_report();
        auto next = std::chrono::steady_clock::now();
        while (!is_ending_.load(std::memory_order_relaxed)) {
            const double now = device_time();
            try {
                if (base_.is_open())
                    exchange_once(now, state);
                else
                    find_again(now, state);
            } catch (const std::exception&) {
                state.flags = 0;  // out of memory: it tries again
            }
            exchange_.put(state, now);
            next = std::max(next + period, std::chrono::steady_clock::now());
            std::this_thread::sleep_until(next);
        }
        base_.close();
    }

    void exchange_once(double now, kerf_device_state& state) {
        const bool is_there = base_.read(now, state);
        const bool is_usable = (state.flags & KERF_DEVICE_VALID) != 0;
        const Vec3 force = is_usable ? exchange_.command().force : Vec3{};
        if (!is_there || !base_.make(force)) {
            state.flags = 0;
            set_problem(base_.problem());
            base_.close();
            next_search_ = now + between_searches;
            return;
        }
        if (now < next_check_ && is_usable == was_usable_) return;
        was_usable_ = is_usable;
        next_check_ = now + between_checks;
        set_problem(base_.problem());
    }

    /// Opens a base that was unplugged, without moving it.
    void find_again(double now, kerf_device_state& state) {
        state.flags = 0;
        if (now < next_search_) return;
        next_search_ = now + between_searches;
        if (const std::string fault = base_.open(serial_, false); !fault.empty()) set_problem(fault);
    }

    void set_problem(std::string problem) {
        const std::lock_guard lock(mutex_);
        problem_ = std::move(problem);
    }

    SharedLibrary library_;
    Dhd dhd_;
    Base base_;
    kerf_device_facts facts_{};
    DeviceExchange exchange_;
    std::mutex mutex_;
    std::string problem_;
    std::string serial_;                           ///< of the base that was opened first
    double next_check_ = 0.0, next_search_ = 0.0;  ///< [s]
    bool was_usable_ = true;
    std::atomic<bool> is_ending_{false};
    std::thread thread_;
};

bool may_move(const DeviceRequest& request) {
    const std::string word = request.setting("may_move");
    if (word.empty() || word == "no") return false;
    if (word == "yes") return true;
    throw std::runtime_error("the station's setting `may_move` is `" + word.substr(0, 20) + "`. Write yes or no.");
}

}  // namespace

std::vector<DeviceFound> ForceDimension::find() const {
    if (!is_installed(places(""))) return {};
    const SharedLibrary library(places(""), false);
    return list_bases(Dhd::of(library));
}

std::unique_ptr<DeviceLink> ForceDimension::open(const DeviceRequest& request) const {
    request.require_known_settings({"library", "may_move"});
    const bool moves = may_move(request);
    SharedLibrary library(places(request.setting("library")), false);
    const Dhd dhd = Dhd::of(library);
    return std::make_unique<Link>(std::move(library), dhd, request.id(), moves);
}

}  // namespace kerf::force_dimension
