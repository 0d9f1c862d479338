#include "granum/gas/limit.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/grid/halo.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
using grid::Index;

GRANUM_VECTORISED void find_bends(Index first, Index end, std::ptrdiff_t s, double const* __restrict x,
                                  double const* __restrict coupled, double* __restrict bend)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) bend[q] = coupled[q] * coupled[q + s] * (x[q + s] + x[q - s] - 2 * x[q]);
}

GRANUM_VECTORISED void find_ranges(Index first, Index end, double const* __restrict x, double const* __restrict earlier,
                                   double* __restrict high, double* __restrict low)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        high[q] = x[q] > earlier[q] ? x[q] : earlier[q];
        low[q] = x[q] < earlier[q] ? x[q] : earlier[q];
    }
}

struct Node
{
    double most, least, gain, loss, bend_up, bend_down;
};

inline double smaller(double a, double b)
{
    return a < b ? a : b;
}
inline double larger(double a, double b)
{
    return a > b ? a : b;
}

// The part of three second differences that all have: towards higher values of x (negative ones) and lower ones.
inline void common(double a, double b, double c, double& up, double& down)
{
    double const least = smaller(smaller(a, b), c), most = larger(larger(a, b), c);
    up = larger(up, larger(-most, 0));
    down = larger(down, larger(least, 0));
}

GRANUM_VECTORISED void find_shares(Index first, Index end, std::array<std::ptrdiff_t, 3> const s,
                                   double const* __restrict x, double const* __restrict high,
                                   double const* __restrict low, double const* __restrict room,
                                   std::array<double const*, 3> const c, std::array<double const*, 3> const added,
                                   std::array<double const*, 3> const bend, double const floor, double const ceiling,
                                   double* __restrict up, double* __restrict down)
{
    double const *c0 = c[0], *c1 = c[1], *c2 = c[2], *a0 = added[0], *a1 = added[1], *a2 = added[2], *b0 = bend[0],
                 *b1 = bend[1], *b2 = bend[2];
    std::ptrdiff_t const s0 = s[0], s1 = s[1], s2 = s[2];
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        double most = high[q], least = low[q], gain = 0, loss = 0;
        auto const look = [&](double there, double enters, Index beside) {
            most = there > 0 ? larger(most, high[beside]) : most;
            least = there > 0 ? smaller(least, low[beside]) : least;
            gain += larger(enters, 0);
            loss += larger(-enters, 0);
        };
        look(c0[q], a0[q], q - s0), look(c0[q + s0], -a0[q + s0], q + s0);
        look(c1[q], a1[q], q - s1), look(c1[q + s1], -a1[q + s1], q + s1);
        look(c2[q], a2[q], q - s2), look(c2[q + s2], -a2[q + s2], q + s2);
        double rises = 0, falls = 0;
        common(b0[q - s0], b0[q], b0[q + s0], rises, falls);
        common(b1[q - s1], b1[q], b1[q + s1], rises, falls);
        common(b2[q - s2], b2[q], b2[q + s2], rises, falls);
        most = smaller(most + 0.5 * rises, larger(ceiling, most));
        least = larger(least - 0.5 * falls, smaller(floor, least));
        double const free_up = room[q] * (most - x[q]), free_down = room[q] * (x[q] - least);
        up[q] = gain > free_up ? free_up / gain : 1;
        down[q] = loss > free_down ? free_down / loss : 1;
    }
}

GRANUM_VECTORISED void take_shares(Index first, Index end, std::ptrdiff_t s, double const* __restrict up,
                                   double const* __restrict down, double* __restrict added)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        double const entering = smaller(up[q], down[q - s]), leaving = smaller(up[q - s], down[q]);
        added[q] *= added[q] > 0 ? entering : leaving;
    }
}
}

Limit::Limit(grid::Grid const& grid)
    : added(grid.make_face_field()),
      high_(grid.make_field()),
      low_(grid.make_field()),
      up_(grid.make_field(1)),
      down_(grid.make_field(1)),
      bend_(grid.make_face_field())
{
}

void Limit::clear()
{
    for (auto& links : added) std::fill(links.begin(), links.end(), 0.0);
}

void Limit::scale(grid::Grid const& grid, std::vector<Run> const& nodes, Field const& x, Field const& earlier,
                  Field const& room, std::array<Field const*, 3> coupled, std::array<Field const*, 3> bounding,
                  double least, double most)
{
    // What is no node neither bends nor limits.
    for (auto& bends : bend_) std::fill(bends.begin(), bends.end(), 0.0);
    for (auto* shares : {&up_, &down_}) std::fill(shares->begin(), shares->end(), 1.0);
    for (auto const& run : nodes)
        for (std::size_t e = 0; e < 3; ++e)
            find_bends(run.first, run.end, grid.strides[e], x.data(), coupled[e]->data(), bend_[e].data());
    grid::refresh(grid, {&added[0], &added[1], &added[2], &bend_[0], &bend_[1], &bend_[2]});
    find_ranges(0, x.size(), x.data(), earlier.data(), high_.data(), low_.data());
    for (auto const& run : nodes)
        find_shares(run.first, run.end, grid.strides, x.data(), high_.data(), low_.data(), room.data(),
                    {bounding[0]->data(), bounding[1]->data(), bounding[2]->data()},
                    {added[0].data(), added[1].data(), added[2].data()},
                    {bend_[0].data(), bend_[1].data(), bend_[2].data()}, least, most, up_.data(), down_.data());
    grid::refresh(grid, {&up_, &down_});
    for (auto const& run : nodes)
        for (std::size_t e = 0; e < 3; ++e)
            take_shares(run.first, run.end, grid.strides[e], up_.data(), down_.data(), added[e].data());
    grid::refresh(grid, {&added[0], &added[1], &added[2]});
}
}
