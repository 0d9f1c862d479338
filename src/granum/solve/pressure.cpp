#include "granum/solve/pressure.hpp"

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
}

struct Pressure::Inside
{
    grid::Grid const& grid;
    par::Communicator const& comm;
    Method method;
    std::optional<Multigrid> multigrid;
    Field diagonal, residual, direction, product, better;
    Memory memory;  //!< fresh_iterations: of the first solve after a set-up, -1: none yet; solves: since the set-up

    Inside(grid::Grid const& g, par::Communicator const& c, Method m)
        : grid(g),
          comm(c),
          method(m),
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
        for (int k = 0; k < grid.n[2]; ++k)
            for (int j = 0; j < grid.n[1]; ++j) {
                Index const row = grid.at(0, j, k);
                double line = 0;
                for (Index i = row; i < row + static_cast<Index>(grid.n[0]); ++i) line += a[i] * b[i];
                sum += line;
            }
        return comm.size() > 1 ? comm.sum(sum) : sum;
    }

    void refresh(Field& field) const
    {
        std::array<Field*, 1> const fields{&field};
        grid::refresh(grid, comm, fields);
    }

    //! out := A in on owned cells; the ghosts of `in` are refreshed.
    void multiply(System const& system, Field& in, Field& out) const
    {
        refresh(in);
        auto const s = grid.strides();
        auto const sy = static_cast<Index>(s[1]), sz = static_cast<Index>(s[2]);
        double const *x = in.data(), *lx = system.link[0].data(), *ly = system.link[1].data(),
                     *lz = system.link[2].data();
        for (int k = 0; k < grid.n[2]; ++k)
            for (int j = 0; j < grid.n[1]; ++j) {
                Index const row = grid.at(0, j, k);
                for (Index c = row; c < row + static_cast<Index>(grid.n[0]); ++c)
                    out[c] = diagonal[c] * x[c] - lx[c] * x[c - 1] - lx[c + 1] * x[c + 1] - ly[c] * x[c - sy] -
                             ly[c + sy] * x[c + sy] - lz[c] * x[c - sz] - lz[c + sz] * x[c + sz];
            }
    }

    //! Diagonal of the matrix. Returns true if the system has no extra anywhere: then x is free up to a constant.
    bool prepare(System const& system)
    {
        auto const s = grid.strides();
        double extra = 0;
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            double sum = system.extra[c];
            for (std::size_t d = 0; d < 3; ++d) sum += system.link[d][c] + system.link[d][c + static_cast<Index>(s[d])];
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
