// Gauss-Seidel sweeps along the lines of cells that lie contiguous in memory: what the line takes from others is summed
// first, many nodes at a time, and what it passes along itself is then one multiplication and one addition per node.
#include "granum/base/vectorised.hpp"
#include "granum/gas/inside.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
//! Which couplings are along the line and which are across it.
struct Line
{
    std::ptrdiff_t s1, s2;  // strides of the other two directions
    double const *behind, *ahead, *low1, *high1, *low2, *high2, *right, *inverse;
};

//! partial := (right + sum of neighbours but the one behind) / centre; factor of the one behind over centre. Forward:
//! behind is the lower neighbour.
GRANUM_VECTORISED void gather(Line const& given, Index first, Index end, std::ptrdiff_t forward,
                              double const* __restrict x, double* __restrict partial)
{
    Line const l = given;
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        double const along = l.ahead[q] * x[q + static_cast<Index>(forward)];
        double const one = l.low1[q] * x[q - static_cast<Index>(l.s1)] + l.high1[q] * x[q + static_cast<Index>(l.s1)];
        double const two = l.low2[q] * x[q - static_cast<Index>(l.s2)] + l.high2[q] * x[q + static_cast<Index>(l.s2)];
        partial[q] = (l.right[q] + along + (one + two)) * l.inverse[q];
    }
}

struct Seen
{
    double change = 0, largest = 0;
};

void forward(Line const& l, Index first, Index end, double const* partial, double* x, Seen& seen)
{
    double last = x[first - 1];
    for (Index q = first; q < end; ++q) {
        double const value = partial[q] + (l.behind[q] * l.inverse[q]) * last;
        seen.change = std::max(seen.change, std::abs(value - x[q]));
        seen.largest = std::max(seen.largest, std::abs(value));
        x[q] = last = value;
    }
}

void backward(Line const& l, Index first, Index end, double const* partial, double* x, Seen& seen)
{
    double last = x[end];
    for (Index q = end; q-- > first;) {
        double const value = partial[q] + (l.behind[q] * l.inverse[q]) * last;
        seen.change = std::max(seen.change, std::abs(value - x[q]));
        seen.largest = std::max(seen.largest, std::abs(value));
        x[q] = last = value;
    }
}
}

void Solver::Inside::sweep(Rows& system_of, std::vector<Run> const& nodes, Field& x, double tolerance, int most)
{
    auto const [a, b, c] = grid.order;
    Line up{.s1 = grid.strides[b],
            .s2 = grid.strides[c],
            .behind = system_of.coupling[2 * a].data(),
            .ahead = system_of.coupling[2 * a + 1].data(),
            .low1 = system_of.coupling[2 * b].data(),
            .high1 = system_of.coupling[2 * b + 1].data(),
            .low2 = system_of.coupling[2 * c].data(),
            .high2 = system_of.coupling[2 * c + 1].data(),
            .right = system_of.right.data(),
            .inverse = system_of.inverse.data()};
    Line down = up;
    std::swap(down.behind, down.ahead);

    double scale = 0;  // largest value of all ranks, from the first sweep
    for (int sweep = 0; sweep < most; ++sweep) {
        Seen seen;
        ++sweeps;
        if (sweep % 2 == 0)
            for (auto const& run : nodes) {
                gather(up, run.first, run.end, 1, x.data(), system_of.partial.data());
                forward(up, run.first, run.end, system_of.partial.data(), x.data(), seen);
            }
        else
            for (auto run = nodes.rbegin(); run != nodes.rend(); ++run) {
                gather(down, run->first, run->end, -1, x.data(), system_of.partial.data());
                backward(down, run->first, run->end, system_of.partial.data(), x.data(), seen);
            }
        for (auto const& end : system_of.ends) {
            double const value = (end.right + end.coupling * x[end.inner]) / (end.mobility + end.coupling);
            seen.change = std::max(seen.change, std::abs(value - x[end.face]));
            x[end.face] = value;
        }
        refresh({&x});
        if (sweep == 0) scale = comm.size() > 1 ? comm.max(seen.largest) : seen.largest;
        if (comm.size() > 1) seen.change = comm.max(seen.change);
        if (seen.change <= tolerance * scale) break;
    }
}
}
