// Brings convection from upwind to second order: to the mean of both nodes at both ends of the step.
//
// With x the implicit upwind solution and x0 the values before the step, the mean of (x0 + x)/2 alone would be explicit
// and let short waves grow. So what its fluxes move is carried on by half of the upwind operator, implicitly: P d =
// what the fluxes move, P the matrix of x less half of its convection. The flux is then the mean of (x0 + x)/2 and half
// the upwind flux of d: of second order, and no wave grows at any step. The limiter (limit.hpp) takes from it what
// makes extremes.
#include "granum/base/vectorised.hpp"
#include "granum/gas/inside.hpp"

#include <algorithm>

namespace granum::gas
{
namespace
{
// Of the correction, whose share in the velocity or scalar falls with the step.
constexpr double sweep_tolerance = 1e-9;
constexpr int most_sweeps = 200;

inline double positive(double x)
{
    return x > 0 ? x : 0;
}

GRANUM_VECTORISED void centre(Index first, Index end, std::ptrdiff_t s, double const* __restrict flux,
                              double const* __restrict coupled, double const* __restrict share,
                              double const* __restrict x, double const* __restrict earlier, double* __restrict added)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        Index const low = q - static_cast<Index>(s);
        double const centred = 0.5 * (share[q] * (x[low] + earlier[low]) + (1 - share[q]) * (x[q] + earlier[q]));
        added[q] = flux[q] * coupled[q] * (centred - (flux[q] > 0 ? x[low] : x[q]));
    }
}

struct Matrix
{
    std::array<std::ptrdiff_t, 3> s;
    std::array<double const*, 3> flux, coupled, added;
    std::array<double const*, 6> whole;
    double const* inverse;
    std::array<double*, 6> halved;
    double *inverse_halved, *right;
};

GRANUM_VECTORISED void halve(Matrix const& given, Index first, Index end)
{
    Matrix const m = given;
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        double centre = 1 / m.inverse[q], moved = 0;
        for (std::size_t e = 0; e < 3; ++e) {
            Index const high = q + static_cast<Index>(m.s[e]);
            double const from_low = 0.5 * positive(m.flux[e][q]) * m.coupled[e][q];
            double const from_high = 0.5 * positive(-m.flux[e][high]) * m.coupled[e][high];
            m.halved[2 * e][q] = m.whole[2 * e][q] - from_low;
            m.halved[2 * e + 1][q] = m.whole[2 * e + 1][q] - from_high;
            centre -= from_low + from_high;
            moved += m.added[e][q] - m.added[e][high];
        }
        m.inverse_halved[q] = 1 / centre;
        m.right[q] = moved;
    }
}

GRANUM_VECTORISED void carry_on(Index first, Index end, std::ptrdiff_t s, double const* __restrict flux,
                                double const* __restrict coupled, double const* __restrict change,
                                double* __restrict added)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        double const upwind = flux[q] > 0 ? change[q - static_cast<Index>(s)] : change[q];
        added[q] += 0.5 * flux[q] * coupled[q] * upwind;
    }
}
}

void Solver::Inside::sharpen(std::vector<Run> const& nodes, Links const& links, Field const& x, Field const& earlier)
{
    auto const pointers = [](std::array<Field const*, 3> const& fields) {
        return std::array<double const*, 3>{fields[0]->data(), fields[1]->data(), fields[2]->data()};
    };
    auto const flux = pointers(links.flux), linked = pointers(links.coupled), share = pointers(links.share);
    auto& added = limit.added;
    limit.clear();
    for (auto const& run : nodes)
        for (std::size_t e = 0; e < 3; ++e)
            centre(run.first, run.end, grid.strides[e], flux[e], linked[e], share[e], x.data(), earlier.data(),
                   added[e].data());
    refresh({&added[0], &added[1], &added[2]});

    Matrix matrix{.s = grid.strides,
                  .flux = flux,
                  .coupled = linked,
                  .added = {added[0].data(), added[1].data(), added[2].data()},
                  .whole = {},
                  .inverse = rows.inverse.data(),
                  .halved = {},
                  .inverse_halved = halves.inverse.data(),
                  .right = halves.right.data()};
    for (std::size_t m = 0; m < 6; ++m) {
        matrix.whole[m] = rows.coupling[m].data();
        matrix.halved[m] = halves.coupling[m].data();
    }
    for (auto const& run : nodes) halve(matrix, run.first, run.end);
    std::fill(change.begin(), change.end(), 0.0);
    sweep(halves, nodes, change, sweep_tolerance, most_sweeps);
    for (auto const& run : nodes)
        for (std::size_t e = 0; e < 3; ++e)
            carry_on(run.first, run.end, grid.strides[e], flux[e], linked[e], change.data(), added[e].data());
}
}
