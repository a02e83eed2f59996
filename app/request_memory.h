// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Memory whose addresses are a function of what was requested. Libraries order by address what is otherwise equal, so
/// their results depend on where the heap had room. While a request is answered, `operator new` on the same thread
/// takes memory from an empty region at a fixed address. Not so where the address space is too small for a region, and
/// for what a request needs beyond it: then memory comes from the heap. Linked into `kerf-remesh` alone.
namespace kerf {

/// From now on memory comes from an empty region.   [main]
void begin_request_memory() noexcept;
/// From now on it comes from the heap again. The region is used again once all that came from it is freed.   [main]
void end_request_memory() noexcept;

}  // namespace kerf
