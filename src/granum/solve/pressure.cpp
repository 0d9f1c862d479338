#include "granum/solve/pressure.hpp"

#include "granum/base/aligned.hpp"
#include "granum/base/vectorised.hpp"
#include "granum/grid/halo.hpp"
#include "granum/solve/diagonal.hpp"
#include "granum/solve/hypre.hpp"
#include "granum/solve/multigrid.hpp"
#include "granum/solve/sums.hpp"
#include "granum/solve/whole.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::solve
{
namespace
{
using grid::Index;
constexpr int most_iterations = 2000;
constexpr long few_cells = 16384;  // of all ranks: as many are solved for by each rank alone

//! A system as the loops over lines see it.
struct Matrix
{
    std::array<Index, 3> strides;
    std::array<double const*, 3> link;
    double const* extra;

    //! In differences, which do not feel what is the same everywhere.
    double times(double const* x, Index c) const
    {
        double sum = extra[c] * x[c];
        for (std::size_t d = 0; d < 3; ++d)
            sum += link[d][c] * (x[c] - x[c - strides[d]]) + link[d][c + strides[d]] * (x[c] - x[c + strides[d]]);
        return sum;
    }
    double diagonal(Index c) const
    {
        double sum = extra[c];
        for (std::size_t d = 0; d < 3; ++d) sum += link[d][c] + link[d][c + strides[d]];
        return sum;
    }
};

//! Makes the diagonal. Puts x to zero in cells that do not take part.
GRANUM_VECTORISED void prepare(grid::Run const line, Matrix const& matrix, double* __restrict x,
                               double* __restrict diagonal)
{
#pragma GCC ivdep
    for (Index c = line.first; c < line.end; ++c) {
        diagonal[c] = matrix.diagonal(c);
        x[c] = diagonal[c] > 0 ? x[c] : 0;
    }
}

//! Puts the right side without its mean in the place of the residual and returns its square.
GRANUM_VECTORISED double centre(grid::Run const line, double const* __restrict diagonal, double const* __restrict right,
                                double mean, double* __restrict residual)
{
#pragma GCC ivdep
    for (Index c = line.first; c < line.end; ++c) residual[c] = diagonal[c] > 0 ? right[c] - mean : 0;
    return dot(line.first, line.end, residual, residual);
}

GRANUM_VECTORISED double begin(grid::Run const line, Matrix const& matrix, double const* __restrict diagonal,
                               double const* __restrict right, double mean, double const* __restrict x,
                               double* __restrict residual)
{
#pragma GCC ivdep
    for (Index c = line.first; c < line.end; ++c)
        residual[c] = (diagonal[c] > 0 ? right[c] - mean : 0) - matrix.times(x, c);
    return dot(line.first, line.end, residual, residual);
}

GRANUM_VECTORISED void turn(grid::Run const line, double const* __restrict better, double keep,
                            double* __restrict direction)
{
#pragma GCC ivdep
    for (Index c = line.first; c < line.end; ++c) direction[c] = better[c - line.first] + keep * direction[c];
}

//! Returns x times the product.
GRANUM_VECTORISED double multiply(grid::Run const line, Matrix const& matrix, double const* __restrict x,
                                  double* __restrict product)
{
#pragma GCC ivdep
    for (Index c = line.first; c < line.end; ++c) product[c] = matrix.times(x, c);
    return dot(line.first, line.end, product, x);
}

//! Returns the square of the new residual.
GRANUM_VECTORISED double go(grid::Run const line, double step, double const* __restrict direction,
                            double const* __restrict product, double* __restrict x, double* __restrict residual)
{
#pragma GCC ivdep
    for (Index c = line.first; c < line.end; ++c) {
        x[c] += step * direction[c];
        residual[c] -= step * product[c];
    }
    return dot(line.first, line.end, residual, residual);
}

std::unique_ptr<Preconditioner> make(grid::Grid const& grid, par::Communicator const& comm, Method method)
{
    switch (method) {
        case Method::pfmg:
        case Method::smg:
            return std::make_unique<Hypre>(grid, comm, method);
        case Method::diagonal:
            return std::make_unique<Diagonal>(grid);
        case Method::multigrid:
            break;
    }
    return std::make_unique<Multigrid>(grid, comm);
}
}

struct Pressure::Inside
{
    grid::Grid const& grid;
    par::Communicator const& comm;
    Method method;
    std::unique_ptr<Preconditioner> preconditioner;
    std::unique_ptr<Whole> whole;  // where the system is a small one
    std::vector<grid::Run> lines;  // of owned cells
    Field diagonal, direction;
    base::AlignedVector<double> residual, product;
    std::vector<double> better;  // a line

    Inside(grid::Grid const& g, par::Communicator const& c, Method m)
        : grid(g),
          comm(c),
          method((m == Method::pfmg || m == Method::smg) && !Hypre::suits(g) ? Method::multigrid : m),
          preconditioner(make(g, c, method)),
          lines(grid::runs(g, [](int, int, int, Index) { return true; })),
          diagonal(g.make_field()),
          direction(g.make_field()),
          residual(g.size()),
          product(g.size()),
          better(static_cast<std::size_t>(g.n[g.order[0]]))
    {
        long const cells = static_cast<long>(g.global[0]) * g.global[1] * g.global[2];
        if (method == Method::multigrid && comm.size() > 1 && cells <= few_cells) whole = std::make_unique<Whole>(g, c);
    }

    Matrix matrix(System const& system) const
    {
        Matrix out{.strides = {}, .link = {}, .extra = system.extra.data()};
        for (std::size_t d = 0; d < 3; ++d) {
            out.strides[d] = static_cast<Index>(grid.strides[d]);
            out.link[d] = system.link[d].data();
        }
        return out;
    }

    //! Sum over the lines of all ranks.
    template <class Visitor>
    double sum(Visitor&& visit) const
    {
        double total = 0;
        for (auto const& line : lines) total += visit(line);
        return comm.size() > 1 ? comm.sum(total) : total;
    }

    //! Mean over the cells that take part.
    double mean(Field const& field) const
    {
        std::array<double, 2> sums{};
        for (auto const& line : lines)
            for (Index c = line.first; c < line.end; ++c)
                if (diagonal[c] > 0) sums[0] += field[c], sums[1] += 1;
        comm.sum(sums);
        return sums[1] > 0 ? sums[0] / sums[1] : 0;
    }

    Facts look(System const& system, Field& x)
    {
        std::array<double, 2> most{};
        Matrix const of_system = matrix(system);
        for (auto const& line : lines) {
            prepare(line, of_system, x.data(), diagonal.data());
            for (Index c = line.first; c < line.end; ++c) {
                most[0] = std::max(most[0], diagonal[c]);
                most[1] = std::max(most[1], system.extra[c]);
            }
        }
        comm.max(most);
        return {.free = most[1] == 0, .diagonal = most[0], .right = 0};
    }

    void hand_over()
    {
        for (std::size_t line = 0; line < lines.size(); ++line)
            preconditioner->take(line, residual.data() + lines[line].first);
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
    return inside_->preconditioner->memory();
}

void Pressure::recall(Memory memory)
{
    inside_->preconditioner->recall(std::move(memory));
}

Outcome Pressure::solve(System const& system, Field& x, double tolerance, double floor)
{
    Inside& in = *inside_;
    if (in.whole) return in.whole->solve(system, x, tolerance, floor);
    Matrix const matrix = in.matrix(system);
    Facts facts = in.look(system, x);
    double const mean = facts.free ? in.mean(system.right) : 0;
    facts.right = std::sqrt(in.sum([&](grid::Run const& line) {
        return centre(line, in.diagonal.data(), system.right.data(), mean, in.residual.data());
    }));
    double const goal = std::max(tolerance * facts.right, floor);

    auto const start = [&] {
        grid::refresh(in.grid, {&x});
        return std::sqrt(in.sum([&](grid::Run const& line) {
            return begin(line, matrix, in.diagonal.data(), system.right.data(), mean, x.data(), in.residual.data());
        }));
    };
    Outcome outcome;
    outcome.residual = start();
    if (outcome.residual > facts.right) {  // a first guess worse than none
        std::fill(x.begin(), x.end(), 0.0);
        outcome.residual = start();
    }
    if (outcome.residual > goal) {
        in.preconditioner->set_up(system, in.diagonal, facts);
        in.hand_over();
    }
    double old = 0;
    while (outcome.residual > goal && outcome.iterations < most_iterations) {
        double const now = in.comm.sum(in.preconditioner->apply());
        double const keep = outcome.iterations > 0 ? now / old : 0;
        old = now;
        for (std::size_t line = 0; line < in.lines.size(); ++line) {
            in.preconditioner->give(line, in.better.data());
            turn(in.lines[line], in.better.data(), keep, in.direction.data());
        }
        grid::refresh(in.grid, {&in.direction});
        double const curve = in.sum(
            [&](grid::Run const& line) { return multiply(line, matrix, in.direction.data(), in.product.data()); });
        if (!(curve > 0)) break;  // nothing left but round-off
        ++outcome.iterations;
        double const step = now / curve;
        double square = 0;
        for (std::size_t line = 0; line < in.lines.size(); ++line) {
            square += go(in.lines[line], step, in.direction.data(), in.product.data(), x.data(), in.residual.data());
            in.preconditioner->take(line, in.residual.data() + in.lines[line].first);
        }
        outcome.residual = std::sqrt(in.comm.sum(square));
    }
    outcome.converged = outcome.residual <= goal;
    if (facts.free) {
        double const shift = in.mean(x);
        for (auto const& line : in.lines)
            for (Index c = line.first; c < line.end; ++c)
                if (in.diagonal[c] > 0) x[c] -= shift;
    }
    grid::refresh(in.grid, {&x});
    in.preconditioner->served(outcome.iterations);
    return outcome;
}
}
