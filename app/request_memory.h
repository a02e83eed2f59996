// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Makes the addresses of memory a function of the requests. Some libraries order equal elements by address, so their
/// results depend on the state of the heap. During a request, `operator new` on the same thread takes memory from an
/// empty region at a fixed address. If the address space is too small for a region, or the region is full, memory comes
/// from the heap. Linked into `kerf-remesh` alone.
namespace kerf::app {

/// Lets memory come from an empty region from now on.   [main]
void begin_request_memory() noexcept;
/// Lets memory come from the heap again. The region is reused when all its blocks are freed.   [main]
void end_request_memory() noexcept;

}  // namespace kerf::app
