/// \file
/// Memory of one block that grows: what `GrowingArray` asks for.
#pragma once

#include <cstddef>

namespace sesame::sparse {

/// Blocks of so many bytes and more have pages of their own, where the system can move pages.
inline constexpr std::size_t least_bytes_of_pages = std::size_t{256} << 10;

/// Makes a block larger or smaller, as std::realloc does: its bytes stay, its address may not. `block`: null, or what
/// this function gave for `bytes`. Returns null, and leaves the block as it is, when there is no memory.
///
/// A block with pages of its own is not copied: the system gives its pages another address. std::realloc does the same
/// at first, but copies blocks of up to 32 MB once a program has given back one as large, with a pause as long as it
/// takes to touch all their pages for the first time.
///
/// Requires: 0 < wanted <= PTRDIFF_MAX. Cost: O(bytes), but from `least_bytes_of_pages` on 8 bytes for a page of 4096.
[[nodiscard]] void* resize_block(void* block, std::size_t bytes, std::size_t wanted) noexcept;

/// Gives a block back; null is none.
void release_block(void* block, std::size_t bytes) noexcept;

}  // namespace sesame::sparse
