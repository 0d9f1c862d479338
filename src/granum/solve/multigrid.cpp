#include "granum/solve/multigrid.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/solve/gathering.hpp"
#include "granum/solve/transfer.hpp"

#include <algorithm>
#include <cstdlib>

namespace granum::solve
{
namespace
{
constexpr long few_cells = 4096;  // of all ranks: as many are done by each rank alone
// A direction is paired if its links are above this part of the strongest direction's. No round number, so that no
// grid's ratio of spacings meets it and round-off decides.
constexpr double strong = 0.6180;

//! Sweeps over one colour before and after the correction, by level.
std::size_t sweeps(std::size_t level)
{
    static std::size_t const s[3] = {std::getenv("S0") ? (std::size_t)atoi(std::getenv("S0")) : 3,std::getenv("S1") ? (std::size_t)atoi(std::getenv("S1")) : 4,std::getenv("S2") ? (std::size_t)atoi(std::getenv("S2")) : 8};
    return s[std::min<std::size_t>(level,2)];
}

//! Between a line of doubles and the cells of alternating colour, a stride apart in each colour.
GRANUM_VECTORISED void split(int count, double scale, double const* __restrict line, float* __restrict one,
                             float* __restrict other)
{
    int const pairs = count / 2;
#pragma GCC ivdep
    for (int m = 0; m < pairs; ++m) {
        one[m] = static_cast<float>(scale * line[2 * m]);
        other[m] = static_cast<float>(scale * line[2 * m + 1]);
    }
    if (count % 2 != 0) one[pairs] = static_cast<float>(scale * line[2 * pairs]);
}
GRANUM_VECTORISED void join(int count, float const* __restrict one, float const* __restrict other,
                            double* __restrict line)
{
    int const pairs = count / 2;
#pragma GCC ivdep
    for (int m = 0; m < pairs; ++m) {
        line[2 * m] = static_cast<double>(one[m]);
        line[2 * m + 1] = static_cast<double>(other[m]);
    }
    if (count % 2 != 0) line[2 * pairs] = static_cast<double>(one[pairs]);
}
}

struct Multigrid::Inside
{
    //! A level and what leads to the next: pairs, or gathering on every rank.
    struct Stage
    {
        std::unique_ptr<Level> level;
        std::unique_ptr<Transfer> transfer;
        std::unique_ptr<Gathering> gathering;
    };

    grid::Grid const& grid;
    par::Communicator const& comm;
    std::vector<Stage> stages;
    std::size_t depth = 0;  // stages in use
    std::vector<Index> lines;  // number of the first cell
    int length;
    std::ptrdiff_t stride;
    double scale = 1;  // of the residual
    std::array<std::size_t, 3> order;

    Inside(grid::Grid const& g, par::Communicator const& c)
        : grid(g), comm(c), length(g.n[g.order[0]]), order(grid::Shape(g.global).order)
    {
        stages.emplace_back(std::make_unique<Level>(grid.halo->layout(), comm.rank(), order, comm));
        Level const& finest = *stages[0].level;
        stride = finest.strides[grid.order[0]];
        for (auto const& line : grid::runs(grid, [](int, int, int, Index) { return true; })) {
            std::array<int, 3> cell{};
            auto rest = static_cast<std::ptrdiff_t>(line.first);
            for (int k = 2; k >= 0; --k) {
                auto const d = grid.order[static_cast<std::size_t>(k)];
                cell[d] = static_cast<int>(rest / grid.strides[d]) - 1;
                rest %= grid.strides[d];
            }
            lines.push_back(finest.number(cell));
        }
    }

    void take_line(std::size_t line, double factor, double const* from, Values& to) const
    {
        Level const& level = *stages[0].level;
        auto const first = static_cast<std::ptrdiff_t>(lines[line]);
        float* const one = to.data() + level.place(static_cast<Index>(first));
        float* const other = to.data() + level.place(static_cast<Index>(first + stride));
        if (stride == 1) {
            split(length, factor, from, one, other);
            return;
        }
        for (int m = 0; m < length; ++m)
            (m % 2 == 0 ? one : other)[m / 2 * stride] = static_cast<float>(factor * from[m]);
    }

    Directions strongly_coupled(Level const& level, std::array<double, 3> sums) const
    {
        double most = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            int const cells = level.layout.cells[d], faces = level.layout.periodic[d] ? cells : cells - 1;
            sums[d] = cells > 1 ? sums[d] / faces * cells : 0;
            most = std::max(most, sums[d]);
        }
        Directions out{};
        for (std::size_t d = 0; d < 3; ++d) out[d] = sums[d] > 0 && sums[d] >= strong * most;
        return out;
    }

    void set_up(System const& system, Facts const& facts)
    {
        Level& finest = *stages[0].level;
        double const unit = 1 / facts.diagonal;
        scale = 1 / facts.right;
        for (std::size_t d = 0; d < 3; ++d)
            if (!finest.idle(d))
                for (std::size_t line = 0; line < lines.size(); ++line)
                    take_line(line, unit, system.link[d].data() + grid_line(line), finest.link[d]);
        for (std::size_t line = 0; line < lines.size(); ++line)
            take_line(line, unit, system.extra.data() + grid_line(line), finest.extra);
        auto sums = finest.close();
        bool alone = comm.size() == 1;
        for (depth = 1;; ++depth) {
            Level& fine = *stages[depth - 1].level;
            if (fine.cells() <= 1) break;
            if (!alone) comm.sum(sums);
            if (!alone && depth > 1 && fine.cells() <= few_cells) {
                gather(depth);
                sums = stages[depth].level->close();
                alone = true;
                continue;
            }
            auto const paired = strongly_coupled(fine, sums);
            if (paired == Directions{}) break;
            coarsen(depth, paired, alone);
            Level& coarse = *stages[depth].level;
            stages[depth - 1].transfer->aggregate(fine, coarse);
            sums = coarse.close();
        }
    }

    void gather(std::size_t next)
    {
        Stage& stage = stages[next - 1];
        if (!stage.gathering) {
            stages.resize(next);
            Stage& again = stages[next - 1];
            again.transfer.reset();
            auto whole = again.level->layout;
            whole.boxes = {grid::CellBox{{}, whole.cells}};
            stages.push_back({std::make_unique<Level>(whole, 0, order, comm), nullptr, nullptr});
            stages[next - 1].gathering = std::make_unique<Gathering>(*stages[next - 1].level, comm);
        }
        stages[next - 1].gathering->aggregate(*stages[next - 1].level, *stages[next].level);
    }

    void coarsen(std::size_t next, Directions const& paired, bool alone)
    {
        if (stages.size() > next && stages[next - 1].transfer && stages[next - 1].transfer->paired() == paired) return;
        stages.resize(next);
        Stage& stage = stages[next - 1];
        stage.gathering.reset();
        stage.transfer = std::make_unique<Transfer>(*stage.level, paired);
        auto level =
            std::make_unique<Level>(coarser(stage.level->layout, paired), alone ? 0 : comm.rank(), order, comm);
        stages.push_back({std::move(level), nullptr, nullptr});
    }

    Index grid_line(std::size_t line) const { return runs[line]; }
    std::vector<Index> runs;

    void cycle(std::size_t at)
    {
        Level& level = *stages[at].level;
        if (at + 1 == depth) {
            level.start(0);
            for (std::size_t s = 1; s < 9; ++s) {
                level.refresh(level.x, (s + 1) % 2);
                level.relax(s % 2);
            }
            return;
        }
        Level& next = *stages[at + 1].level;
        if (stages[at].gathering) {
            stages[at].gathering->restrict(level, next);
            cycle(at + 1);
            stages[at].gathering->prolong(next, level);
            return;
        }
        std::size_t const count = sweeps(at);
        level.start(0);
        level.refresh(level.x, 0);
        for (std::size_t s = 1; s < count; ++s) {
            level.relax(s % 2);
            level.refresh(level.x, s % 2);
        }
        std::size_t const lacking = count % 2;
        level.find_residual(lacking);
        stages[at].transfer->restrict(level, next, lacking);
        cycle(at + 1);
        stages[at].transfer->prolong(next, level, lacking);
        for (std::size_t s = count; s-- > 0;) {
            level.refresh(level.x, (s + 1) % 2);
            level.relax(s % 2);
        }
    }
};

Multigrid::Multigrid(grid::Grid const& grid, par::Communicator const& comm)
    : inside_(std::make_unique<Inside>(grid, comm))
{
    for (auto const& line : grid::runs(grid, [](int, int, int, Index) { return true; })) inside_->runs.push_back(line.first);
}
Multigrid::~Multigrid() = default;

void Multigrid::set_up(System const& system, Field const&, Facts const& facts)
{
    inside_->set_up(system, facts);
}

void Multigrid::take(std::size_t line, double const* residual)
{
    inside_->take_line(line, inside_->scale, residual, inside_->stages[0].level->right);
}

double Multigrid::apply()
{
    inside_->cycle(0);
    return inside_->stages[0].level->dot() / inside_->scale;
}

void Multigrid::give(std::size_t line, double* result) const
{
    Inside const& in = *inside_;
    Level const& level = *in.stages[0].level;
    auto const first = static_cast<std::ptrdiff_t>(in.lines[line]);
    float const* const one = level.x.data() + level.place(static_cast<Index>(first));
    float const* const other = level.x.data() + level.place(static_cast<Index>(first + in.stride));
    if (in.stride == 1) {
        join(in.length, one, other, result);
        return;
    }
    for (int m = 0; m < in.length; ++m) result[m] = static_cast<double>((m % 2 == 0 ? one : other)[m / 2 * in.stride]);
}
}
