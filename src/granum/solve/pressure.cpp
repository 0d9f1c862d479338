#include "granum/solve/pressure.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/grid/halo.hpp"
#include "granum/solve/multigrid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace granum::solve
{
namespace
{
using grid::Index;
constexpr int most_iterations = 2000;
constexpr int most_solves_per_set_up = 200;
constexpr int patience = 3;  // iterations above those right after a set-up

//! In eight parts, so that the order of additions is the same whatever the machine does at a time.
GRANUM_VECTORISED double dot_of(Index first, Index end, double const* __restrict a, double const* __restrict b)
{
    double part[8]{};
    Index c = first;
    for (; c + 8 <= end; c += 8)
        for (int k = 0; k < 8; ++k) part[k] += a[c + static_cast<Index>(k)] * b[c + static_cast<Index>(k)];
    for (int k = 0; c < end; ++c, ++k) part[k] += a[c] * b[c];
    return ((part[0] + part[4]) + (part[1] + part[5])) + ((part[2] + part[6]) + (part[3] + part[7]));
}

GRANUM_VECTORISED void multiply_run(Index first, Index end, std::array<std::ptrdiff_t, 3> const s,
                                    double const* __restrict diagonal, double const* __restrict lx,
                                    double const* __restrict ly, double const* __restrict lz,
                                    double const* __restrict x, double* __restrict out)
{
    Index const sx = static_cast<Index>(s[0]), sy = static_cast<Index>(s[1]), sz = static_cast<Index>(s[2]);
#pragma GCC ivdep
    for (Index c = first; c < end; ++c)
        out[c] = diagonal[c] * x[c] - lx[c] * x[c - sx] - lx[c + sx] * x[c + sx] - ly[c] * x[c - sy] -
                 ly[c + sy] * x[c + sy] - lz[c] * x[c - sz] - lz[c + sz] * x[c + sz];
}
}

struct Pressure::Inside
{
    grid::Grid const& grid;
    par::Communicator const& comm;
    Method method;
    std::optional<Multigrid> multigrid;
    std::vector<grid::Run> lines;  // of owned cells
    Field diagonal, residual, direction, product, better;
    Memory memory;  //!< fresh_iterations: of the first solve after a set-up, -1: none yet; solves: since the set-up

    Inside(grid::Grid const& g, par::Communicator const& c, Method m)
        : grid(g),
          comm(c),
          method(m),
          lines(grid::runs(g, [](int, int, int, Index) { return true; })),
          diagonal(g.make_field()),
          residual(g.make_field()),
          direction(g.make_field()),
          product(g.make_field()),
          better(g.make_field())
    {
        if (method == Method::multigrid && !Multigrid::suits(g)) method = Method::diagonal;
        if (method == Method::multigrid) multigrid.emplace(g, c);
    }

    double dot(Field const& a, Field const& b) const
    {
        double sum = 0;
        for (auto const& line : lines) sum += dot_of(line.first, line.end, a.data(), b.data());
        return comm.size() > 1 ? comm.sum(sum) : sum;
    }

    void refresh(Field& field) const { grid::refresh(grid, {&field}); }

    //! out := A in on owned cells; the ghosts of `in` are refreshed.
    void multiply(System const& system, Field& in, Field& out) const
    {
        refresh(in);
        for (auto const& line : lines)
            multiply_run(line.first, line.end, grid.strides, diagonal.data(), system.link[0].data(),
                         system.link[1].data(), system.link[2].data(), in.data(), out.data());
    }

    //! Diagonal of the matrix. Returns true if the system has no extra anywhere: then x is free up to a constant.
    bool prepare(System const& system)
    {
        double extra = 0;
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            double sum = system.extra[c];
            for (std::size_t d = 0; d < 3; ++d) sum += system.link[d][c] + system.link[d][grid.next(c, d)];
            diagonal[c] = sum;
            extra = std::max(extra, system.extra[c]);
        });
        return comm.max(extra) == 0;
    }

    //! The preconditioner must not be singular: there a part of the diagonal is added that no mode but the constant
    //! feels.
    void set_up(System const& system, bool free)
    {
        Field raised = diagonal;
        if (free)
            for (double& value : raised) value *= 1 + 1e-4;
        memory = {.set_up = true, .stale = false, .diagonal = std::move(raised), .link = system.link};
        multigrid->set_up(memory.diagonal, memory.link);
    }

    //! Mean over the cells that take part.
    double mean(Field const& field) const
    {
        std::array<double, 2> sums{};
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            if (diagonal[c] > 0) sums[0] += field[c], sums[1] += 1;
        });
        comm.sum(sums);
        return sums[1] > 0 ? sums[0] / sums[1] : 0;
    }

    void precondition(Field const& from, Field& to)
    {
        if (multigrid) {
            multigrid->apply(from, to);
            return;
        }
        grid::for_each_cell(grid, [&](int, int, int, Index c) { to[c] = diagonal[c] > 0 ? from[c] / diagonal[c] : 0; });
    }
};

Pressure::Pressure(grid::Grid const& grid, par::Communicator const& comm, Method method)
    : inside_(std::make_unique<Inside>(grid, comm, method))
{
}
Pressure::~Pressure() = default;
Method Pressure::method() const
{
    return inside_->method;
}

Pressure::Memory const& Pressure::memory() const
{
    return inside_->memory;
}

void Pressure::recall(Memory memory)
{
    inside_->memory = std::move(memory);
    if (inside_->multigrid && inside_->memory.set_up)
        inside_->multigrid->set_up(inside_->memory.diagonal, inside_->memory.link);
}

Outcome Pressure::solve(System const& system, Field& x, double tolerance, double floor)
{
    Inside& in = *inside_;
    auto each = [&in](auto&& visit) { grid::for_each_cell(in.grid, [&](int, int, int, Index c) { visit(c); }); };
    bool const free = in.prepare(system);
    double const mean = free ? in.mean(system.right) : 0;
    auto right = [&](Index c) { return in.diagonal[c] > 0 ? system.right[c] - mean : 0.0; };
    if (in.multigrid && (in.memory.stale || in.memory.solves >= most_solves_per_set_up)) in.set_up(system, free);

    double norm2 = 0;
    each([&](Index c) {
        if (in.diagonal[c] <= 0) x[c] = 0;
        norm2 += right(c) * right(c);
    });
    norm2 = in.comm.sum(norm2);
    double const goal = std::max(tolerance * std::sqrt(norm2), floor);

    in.multiply(system, x, in.product);
    each([&](Index c) { in.residual[c] = right(c) - in.product[c]; });
    Outcome outcome;
    outcome.residual = std::sqrt(in.dot(in.residual, in.residual));
    if (outcome.residual > std::sqrt(norm2)) {  // a first guess worse than none
        each([&](Index c) { x[c] = 0, in.residual[c] = right(c); });
        outcome.residual = std::sqrt(norm2);
    }
    double old = 0;
    while (outcome.residual > goal && outcome.iterations < most_iterations) {
        in.precondition(in.residual, in.better);
        double const now = in.dot(in.residual, in.better);
        double const keep = outcome.iterations > 0 ? now / old : 0;
        old = now;
        each([&](Index c) { in.direction[c] = in.better[c] + keep * in.direction[c]; });
        in.multiply(system, in.direction, in.product);
        double const curve = in.dot(in.direction, in.product);
        if (!(curve > 0)) break;  // nothing left but round-off
        double const step = now / curve;
        each([&](Index c) {
            x[c] += step * in.direction[c];
            in.residual[c] -= step * in.product[c];
        });
        outcome.residual = std::sqrt(in.dot(in.residual, in.residual));
        ++outcome.iterations;
    }
    outcome.converged = outcome.residual <= goal;
    if (free) {
        double const shift = in.mean(x);
        each([&](Index c) {
            if (in.diagonal[c] > 0) x[c] -= shift;
        });
    }
    in.refresh(x);

    auto& memory = in.memory;
    ++memory.solves;
    if (memory.fresh_iterations < 0) memory.fresh_iterations = outcome.iterations;
    memory.stale = outcome.iterations > memory.fresh_iterations + patience;
    return outcome;
}
}
