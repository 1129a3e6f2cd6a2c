/// \file
/// Zigzags to measure with in which simplices follow edges that come and go: every clique of up to four vertices is a
/// simplex as long as its edges are there. Each is determined by its size and seed, on every machine.
#pragma once

#include <cstdint>
#include <ostream>

namespace sesame::tools {

/// A stream of contacts between people, of whom those are remembered that came last: each contact is an edge from when
/// it is met until `window` others have been. People live on a circle, and most meet their neighbours; a contact that
/// is remembered is only refreshed. Ends after so many operations, at the end of a contact.
void write_temporal_network(std::ostream& out, std::uint64_t operations, std::uint32_t people, std::uint32_t window,
                            std::uint64_t seed);

/// An oscillating Rips zigzag of random points in the unit square, up to triangles. Points come one by one, each the
/// farthest from those before; with the distance of the next one as the unit, all pairs nearer than `farther` are
/// joined when a point comes, and those farther than `nearer` are parted afterwards. Source: S. Y. Oudot, D. R. Sheehy,
/// "Zigzag zoology: Rips zigzags for homology inference" (2015). Requires: nearer <= farther, and fewer than 2^16
/// points.
void write_oscillating_rips(std::ostream& out, std::uint32_t points, double nearer, double farther, std::uint64_t seed);

}  // namespace sesame::tools
