#include "granum/solve/multigrid.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/solve/gathering.hpp"
#include "granum/solve/rows.hpp"
#include "granum/solve/transfer.hpp"

#include <algorithm>

namespace granum::solve
{
namespace
{
// Directions are paired whose links are above this part of the strongest direction's. No round number, so that no
// common ratio of spacings meets it, where round-off would decide.
constexpr double strong = 0.6180;
//! Sweeps over one colour before the correction, and as many after it: on the finest level, on others, on the last.
constexpr std::size_t finest_sweeps = 3, sweeps = 6, last_sweeps = 9;

GRANUM_VECTORISED void deal(int count, double scale, double const* __restrict line, float* __restrict one,
                            float* __restrict other)
{
    deal_row(count, scale, line, one, other);
}
GRANUM_VECTORISED void join(int count, float const* __restrict one, float const* __restrict other,
                            double* __restrict line)
{
    join_row(count, one, other, line);
}

//! A level and what leads to the next one: pairs of cells, or gathering on every rank.
struct Stage
{
    std::unique_ptr<Level> level;
    std::unique_ptr<Transfer> transfer;
    std::unique_ptr<Gathering> gathering;
};

Directions strongly_coupled(Level const& level, std::array<double, 3> const& links)
{
    std::array<double, 3> per_cell{};
    for (std::size_t d = 0; d < 3; ++d) {
        int const cells = level.layout.cells[d], faces = level.layout.periodic[d] ? cells : cells - 1;
        if (cells > 1) per_cell[d] = links[d] * cells / faces;
    }
    double const most = std::max({per_cell[0], per_cell[1], per_cell[2]});
    Directions out{};
    for (std::size_t d = 0; d < 3; ++d) out[d] = most > 0 && per_cell[d] >= strong * most;
    return out;
}
}

struct Multigrid::Inside
{
    //! A line of the grid's owned cells.
    struct Line
    {
        Index here;   // its first cell in fields of the grid
        Index there;  // number of that in the finest level
    };

    par::Communicator const& comm;
    long few;
    std::array<std::size_t, 3> order;  // of directions in memory, on all levels and ranks
    std::vector<Stage> stages;         // kept from solve to solve where the same directions are paired
    std::size_t depth = 0;             // of them in use
    std::vector<Line> lines;
    int length;             // of a line
    std::ptrdiff_t stride;  // along a line in the finest level
    double scale = 1;       // of residuals

    Inside(grid::Grid const& grid, par::Communicator const& ranks, long few_cells)
        : comm(ranks), few(few_cells), order(grid::Shape(grid.global).order), length(grid.n[grid.order[0]])
    {
        append(grid.halo->layout(), comm.rank());
        stride = finest().strides[grid.order[0]];
        std::array<int, 3> low{}, high{grid.n[0] - 1, grid.n[1] - 1, grid.n[2] - 1};
        high[grid.order[0]] = 0;
        grid::for_each_cell(grid, low, high, [&](int i, int j, int k, Index cell) {
            lines.push_back({.here = cell, .there = finest().number({i, j, k})});
        });
    }

    Level& finest() const { return *stages.front().level; }

    void append(grid::Layout const& layout, int rank)
    {
        stages.push_back({std::make_unique<Level>(layout, rank, order, comm), nullptr, nullptr});
    }

    void take(Line const& line, double factor, double const* from, Values& to) const
    {
        float* const one = to.data() + finest().place(line.there);
        float* const other = to.data() + finest().place(line.there + static_cast<Index>(stride));
        if (stride == 1) {
            deal(length, factor, from, one, other);
            return;
        }
        for (int m = 0; m < length; ++m) {
            float* const at = (m % 2 == 0 ? one : other) + m / 2 * stride;
            *at = static_cast<float>(factor * from[m]);
        }
    }

    void give(Line const& line, double* to) const
    {
        float const* const one = finest().x.data() + finest().place(line.there);
        float const* const other = finest().x.data() + finest().place(line.there + static_cast<Index>(stride));
        if (stride == 1) {
            join(length, one, other, to);
            return;
        }
        for (int m = 0; m < length; ++m) {
            float const* const at = (m % 2 == 0 ? one : other) + m / 2 * stride;
            to[m] = static_cast<double>(*at);
        }
    }

    void set_up(System const& system, Facts const& facts)
    {
        // Numbers near one: single precision has a narrow range.
        double const unit = 1 / facts.diagonal;
        scale = 1 / facts.right;
        for (auto const& line : lines) {
            for (std::size_t d = 0; d < 3; ++d)
                if (!finest().idle(d)) take(line, unit, system.link[d].data() + line.here, finest().link[d]);
            take(line, unit, system.extra.data() + line.here, finest().extra);
        }
        auto links = finest().close();
        bool alone = comm.size() == 1;
        for (depth = 1;; ++depth) {
            if (!alone) comm.sum(links);
            Level const& fine = *stages[depth - 1].level;
            if (!alone && depth > 1 && fine.cells() <= few) {
                gather();
                alone = true;
            } else {
                auto const paired = strongly_coupled(fine, links);
                if (paired == Directions{}) break;
                coarsen(paired, alone ? 0 : comm.rank());
            }
            links = stages[depth].level->close();
        }
    }

    //! Makes links and extras of the next stage. What leads to it is made anew where it is not what it was.
    void gather()
    {
        if (!stages[depth - 1].gathering) {
            stages.resize(depth);
            auto whole = stages.back().level->layout;
            whole.boxes = {grid::CellBox{{}, whole.cells}};
            stages.back().transfer.reset();
            stages.back().gathering = std::make_unique<Gathering>(*stages.back().level, comm);
            append(whole, 0);
        }
        stages[depth - 1].gathering->aggregate(*stages[depth - 1].level, *stages[depth].level);
    }
    void coarsen(Directions const& paired, int rank)
    {
        if (!stages[depth - 1].transfer || stages[depth - 1].transfer->paired() != paired) {
            stages.resize(depth);
            auto const layout = coarser(stages.back().level->layout, paired);
            stages.back().gathering.reset();
            stages.back().transfer = std::make_unique<Transfer>(*stages.back().level, paired);
            append(layout, rank);
        }
        stages[depth - 1].transfer->aggregate(*stages[depth - 1].level, *stages[depth].level);
    }

    //! x of a level from its right side: approximately, and as a symmetric positive operator.
    void cycle(std::size_t at)
    {
        Level& level = *stages[at].level;
        if (at + 1 == depth) {
            smooth_down(level, last_sweeps);
            return;
        }
        Level& next = *stages[at + 1].level;
        if (stages[at].gathering) {
            stages[at].gathering->restrict(level, next);
            cycle(at + 1);
            stages[at].gathering->prolong(next, level);
            return;
        }
        std::size_t const count = at == 0 ? finest_sweeps : sweeps;
        smooth_down(level, count);
        // The colour solved for last has no residual, and needs no correction as it is solved for next.
        std::array<std::size_t, 2> const both{count % 2, (count + 1) % 2};
        Colours const lacking(both.data(), level.meets_itself() ? 2 : 1);
        for (auto const colour : lacking) level.find_residual(colour);
        stages[at].transfer->restrict(level, next, lacking);
        cycle(at + 1);
        stages[at].transfer->prolong(next, level, lacking);
        for (std::size_t s = count; s-- > 0;) {
            level.refresh(level.x, (s + 1) % 2);
            level.relax(s % 2);
        }
    }

    static void smooth_down(Level& level, std::size_t count)
    {
        level.start(0);
        for (std::size_t s = 1; s < count; ++s) {
            level.refresh(level.x, (s + 1) % 2);
            level.relax(s % 2);
        }
        level.refresh(level.x, (count + 1) % 2);
    }
};

Multigrid::Multigrid(grid::Grid const& grid, par::Communicator const& comm, long few)
    : inside_(std::make_unique<Inside>(grid, comm, few))
{
}
Multigrid::~Multigrid() = default;

void Multigrid::set_up(System const& system, Field const&, Facts const& facts)
{
    inside_->set_up(system, facts);
}

void Multigrid::take(std::size_t line, double const* residual)
{
    inside_->take(inside_->lines[line], inside_->scale, residual, inside_->finest().right);
}

double Multigrid::apply()
{
    inside_->cycle(0);
    return inside_->finest().dot() / inside_->scale;
}

void Multigrid::give(std::size_t line, double* result) const
{
    inside_->give(inside_->lines[line], result);
}
}
