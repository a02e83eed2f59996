// SPDX-License-Identifier: Apache-2.0
#include "session/recorder.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "session/recorder_impl.h"
#include "text/write_file.h"

namespace kerf::session {
namespace {

/// A process that ends at once loses less than this in lock-step: half a second of the operation.
constexpr std::uint64_t max_unwritten_ticks = 500;

/// Copies as much as fits, without cutting a UTF-8 character.
template <std::size_t N>
void copy_text(char (&to)[N], const std::string& from) noexcept {
    std::size_t count = std::min(from.size(), N - 1);
    if (count < from.size())
        while (count > 0 && (static_cast<unsigned char>(from[count]) & 0xc0u) == 0x80u) --count;
    std::memcpy(to, from.data(), count);
    to[count] = '\0';
}

}  // namespace

Recorder::Recorder(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}

Recorder::~Recorder() {
    impl_->wait_if_abandoned();  // the thread that ends the program reads the path
    if (impl_->is_closed) return;
    impl_->stop();
    impl_->close("incomplete");
}

SavedRecord Recorder::save_what_is_open(const char* event_id, const char* detail) noexcept {
    Impl* impl = Impl::open.exchange(nullptr);
    if (impl == nullptr) return {};
    impl->last_event = event_id;
    impl->last_detail = detail;
    impl->is_abandoned.store(true, std::memory_order_release);
    impl->is_stopping.store(true, std::memory_order_release);  // the writer checks it every 10 ms
    constexpr timespec pause{0, 10'000'000};
    for (int attempts = 0; attempts < 200; ++attempts) {
        if (impl->is_saved.load(std::memory_order_acquire)) return {impl->path.c_str(), true};
        nanosleep(&pause, nullptr);
    }
    return {impl->path.c_str(), false};
}

Recorder::Created Recorder::create(const std::string& path, const SessionHeader& header) {
    const std::string part = path + ".part";
    const std::vector<std::string> all{part, part + "-journal", path + "-wal", path + "-shm", path + "-journal", path};
    for (const std::string& file : all) {
        std::error_code error;
        std::filesystem::remove(file, error);
        if (error) return {nullptr, file + " could not be replaced: " + error.message()};
    }
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    SqliteDatabase& database = impl->database;
    const auto failed = [&](const std::string& why) -> Created {
        database.close();
        for (const std::string& file : all) {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
        }
        return {nullptr, why};
    };
    const auto refusal = [&] { return path + " could not be made: " + database.error() + "."; };

    if (database.open(part)) impl->create(header);
    if (!database.is_good()) return failed(refusal());
    database.close();
    if (std::string why = text::rename_into_position(part, path); !why.empty()) return failed(why);
    if (database.open(path)) impl->open_to_write();
    impl->file = text::identity_of(path);
    if (database.is_good()) {
        impl->own_files.watch({path, path + "-wal", path + "-shm"});  // before another thread opens them for itself
        impl->start();
    }
    if (!database.is_good()) {
        impl->own_files.release();
        impl->finalize();
        return failed(refusal());
    }
    return {std::unique_ptr<Recorder>(new Recorder(std::move(impl))), {}};
}

void Recorder::push(const TickRow& row) noexcept {
    if (impl_->ticks.push(row))
        ++impl_->pushed_ticks;
    else
        impl_->lost_ticks.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::push_cut(const CutRow& cut) noexcept {
    if (!impl_->cuts.push(cut)) impl_->lost_cuts.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::push_event(const EventRow& event) noexcept {
    EventSlot slot;
    slot.tick = event.tick;
    slot.time = event.time;
    copy_text(slot.id, event.id);
    copy_text(slot.detail, event.detail);
    if (!impl_->events.push(slot)) impl_->lost_events.fetch_add(1, std::memory_order_relaxed);
}

bool Recorder::wait_for_capacity() {
    impl_->wait_if_abandoned();
    const auto is_filled = [](const auto& ring, std::size_t parts) { return ring.size() > ring.capacity() / parts; };
    const auto any_filled = [&](std::size_t parts) {
        return is_filled(impl_->ticks, parts) || is_filled(impl_->cuts, parts) || is_filled(impl_->events, parts);
    };
    const auto unwritten = [&] { return impl_->pushed_ticks - impl_->written_ticks.load(std::memory_order_acquire); };
    const auto can_wait = [&] { return !impl_->has_writer_ended.load(std::memory_order_acquire); };
    if (unwritten() == Impl::batch_rows) {
        const std::lock_guard lock(impl_->mutex);  // the writer is not between its check and its sleep
        impl_->wake.notify_all();
    }
    while (unwritten() >= max_unwritten_ticks && can_wait())
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    if (any_filled(2))
        while (any_filled(4) && can_wait()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return !impl_->is_failed.load(std::memory_order_acquire);
}

bool Recorder::is_removed() const noexcept { return impl_->was_removed || impl_->is_removed(); }

RecorderLosses Recorder::losses() const noexcept {
    return {impl_->lost_ticks.load(), impl_->lost_events.load(), impl_->lost_cuts.load()};
}

EventRow Recorder::as_kept(EventRow event) {
    EventSlot slot;
    copy_text(slot.id, event.id);
    copy_text(slot.detail, event.detail);
    event.id = slot.id;
    event.detail = slot.detail;
    return event;
}

std::string Recorder::finish(const RunSummary& summary, const DrawnSurface& bone_after) {
    if (impl_->is_closed) return "this session is finished already";
    impl_->stop();
    impl_->wait_if_abandoned();

    impl_->database.run("BEGIN");
    impl_->write_results(summary, bone_after);
    impl_->database.run("COMMIT");
    impl_->close(losses().any() ? "incomplete" : "finished", &summary);
    if (impl_->was_removed)
        return impl_->path + " is no longer there: it was removed, renamed or replaced during the run.";
    if (!impl_->error.empty()) return impl_->path + " is incomplete: " + impl_->error + ".";
    if (!impl_->fold_error.empty())
        return impl_->path +
               " is complete together with session.db-wal, which could not be folded into it: " + impl_->fold_error +
               ". Keep both files together.";
    if (!impl_->plain_error.empty())
        return impl_->path + " is complete, and larger than it needs to be: some rows could not be compressed: " +
               impl_->plain_error + ".";
    return {};
}

}  // namespace kerf::session
