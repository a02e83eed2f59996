// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/kernel/block_kernel.h"

#include <atomic>

namespace kerf {

#ifdef KERF_HAS_AVX2
extern const BlockKernel avx2_kernel_table;
#endif

namespace {
// Chosen at the first use, so that objects constructed before main can use it too.
std::atomic<const BlockKernel*> in_use{nullptr};
}  // namespace

const BlockKernel* avx2_kernel() noexcept {
#ifdef KERF_HAS_AVX2
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) return &avx2_kernel_table;
#endif
    return nullptr;
}

const BlockKernel& block_kernel() noexcept {
    if (const BlockKernel* chosen = in_use.load(std::memory_order_relaxed)) return *chosen;
    const BlockKernel* fastest = avx2_kernel();
    const BlockKernel& chosen = fastest != nullptr ? *fastest : portable_kernel();
    in_use.store(&chosen, std::memory_order_relaxed);
    return chosen;
}

void use_block_kernel(const BlockKernel& kernel) noexcept { in_use.store(&kernel, std::memory_order_relaxed); }

}  // namespace kerf
