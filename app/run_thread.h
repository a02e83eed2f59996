// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <type_traits>
#include <utility>

namespace kerf::app {

/// A result to come. Its destructor waits for the work, which may refer to what lives as long.
template <class T>
class Awaited {
public:
    explicit Awaited(std::future<T> future) : future_(std::move(future)) {}
    Awaited(Awaited&&) noexcept = default;
    ~Awaited() {
        if (future_.valid()) future_.wait();
    }
    [[nodiscard]] T get() { return future_.get(); }

private:
    std::future<T> future_;
};

/// A thread for the run behind a window. It starts with the priority of the process and keeps it; the thread of the
/// window lowers its own, and a thread that it starts later would inherit that.   [main]
class RunThread {
public:
    /// Returns the thread of this process. The first call starts it; make it before a window shows a run.
    [[nodiscard]] static RunThread& of_process();

    /// Calls `work` on the thread, after earlier work.
    template <class Work>
    [[nodiscard]] auto run(Work work) -> Awaited<std::invoke_result_t<Work>> {
        auto task = std::make_shared<std::packaged_task<std::invoke_result_t<Work>()>>(std::move(work));
        Awaited<std::invoke_result_t<Work>> result(task->get_future());
        post([task] { (*task)(); });
        return result;
    }

private:
    class Queue;
    explicit RunThread(std::shared_ptr<Queue> queue) : queue_(std::move(queue)) {}
    void post(std::function<void()> work);

    std::shared_ptr<Queue> queue_;
};

}  // namespace kerf::app
