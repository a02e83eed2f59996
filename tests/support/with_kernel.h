// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/grid/kernel/block_kernel.h"

namespace kerf::test {

/// Queries and stamps use this kernel for as long as it lives.
class WithKernel {
public:
    explicit WithKernel(const BlockKernel& kernel) : before_(block_kernel()) { use_block_kernel(kernel); }
    ~WithKernel() { use_block_kernel(before_); }
    WithKernel(const WithKernel&) = delete;
    WithKernel& operator=(const WithKernel&) = delete;

private:
    const BlockKernel& before_;
};

}  // namespace kerf::test
