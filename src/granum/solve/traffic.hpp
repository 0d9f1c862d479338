// Bytes that a pressure solve by the own multigrid asks of memory, per cell: each array once per loop, stores without
// what they fetch first, neighbours from a cache. Doubles are 8 bytes; the multigrid's numbers are 4, and a sweep
// passes over the cells of one colour but over the links of all.
#pragma once

namespace granum::solve::traffic
{
constexpr double half_sweep = 12 + 2 + 2 + 2 + 2;  // links; right side, inverse, x of either colour
constexpr double finest_level =
    (2 + 2 + 2) + 5 * half_sweep + (half_sweep + 4) + (2 + 4);  // start, residual, transfers
constexpr double other_levels = ((2 + 2 + 2) + 11 * half_sweep + (half_sweep + 4) + (2 + 4)) / 7;  // eight to one
constexpr double gradients = (4 + 16) + (24 + 8 + 8 + 8) + (48 + 4) + 8;  // direction, product, step, residual times z
constexpr double per_iteration = finest_level + other_levels + gradients;
constexpr double per_solve = (32 + 8 + 16) + 24 + (32 + 32) + (8 + 4) + (32 + 16) + (16 + 8) + 16;
}
