// SPDX-License-Identifier: Apache-2.0
#include "app/run_thread.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace kerf::app {

class RunThread::Queue {
public:
    Queue() : thread_([this] { work(); }) {}
    ~Queue() {
        {
            const std::lock_guard lock(mutex_);
            is_over_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;

    void post(std::function<void()> work) {
        {
            const std::lock_guard lock(mutex_);
            waiting_.push_back(std::move(work));
        }
        wake_.notify_one();
    }

private:
    void work() {
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            const std::function<void()> next = std::move(waiting_.front());
            waiting_.pop_front();
            lock.unlock();
            next();
            lock.lock();
        }
    }

    std::mutex mutex_;  ///< guards the members below
    std::condition_variable wake_;
    std::deque<std::function<void()>> waiting_;
    bool is_over_ = false;
    std::thread thread_;  ///< last: it uses the others
};

RunThread& RunThread::of_process() {
    static RunThread one(std::make_shared<Queue>());
    return one;
}

void RunThread::post(std::function<void()> work) { queue_->post(std::move(work)); }

}  // namespace kerf::app
