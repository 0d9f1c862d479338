// Bytes that a step of the gas asks of memory, per cell: each array once per loop over the cells, stores without what
// they fetch first, neighbours from a cache. What a step cannot beat is this over the bandwidth.
#pragma once

#include "granum/gas/flow.hpp"
#include "granum/solve/traffic.hpp"

namespace granum::gas
{
namespace traffic
{
// In doubles, by the loops of momentum.cpp, sharpen.cpp, limit.cpp, projection.cpp, transport.cpp, flow.cpp.
constexpr double sharpened = 3 + 18 + 24 + 1 + 15;  // convection to second order, without its sweeps
constexpr double limited = 5 + 9 + 4 + 15 + 12;
constexpr double component = 6 + 41 + sharpened + limited + 27 + 17;  // mean fluxes, matrix, ..., viscosity, result
constexpr double momentum = 30 + 3 * component;
constexpr double projection = 6 + 4 + 27 + 11 + 30 + 9 + 18;  // fluxes and links, right side, correction, stress
constexpr double scalar = 16 + 2 + 19 + sharpened + limited + 18 + 8;
constexpr double rest = 20 + 120;    // heat's content and fluxes; copies, derived fields, checks
constexpr double sweep = 6 + 2 + 2;  // couplings, right side and centre, x
}

//! Of one step with the sweeps and pressure iterations of `done`: vapour and heat, no tracer, own multigrid.
constexpr double bytes_per_cell(Balance const& done)
{
    using namespace traffic;
    return 8 * (momentum + projection + 2 * scalar + rest + done.sweeps * sweep) + solve::traffic::per_solve +
           done.pressure_iterations * solve::traffic::per_iteration;
}
}
