/// \file
/// What the blocks of `sparse/block_memory.hpp` take, for who measures.
#pragma once

#include <cstddef>

namespace sesame::sparse {

/// What all blocks take that have pages of their own: the size that was asked for, whether their pages have been
/// touched or not. They are in no statistics of malloc.
[[nodiscard]] std::size_t bytes_of_pages() noexcept;

}  // namespace sesame::sparse
