#include "granum/solve/level.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/solve/sums.hpp"

namespace granum::solve
{
namespace
{
//! For the cells of one colour by their places: the links of their six faces, and x behind these. In the order of
//! directions, not of memory, so that sums have the same bits on any ranks.
struct Around
{
    std::array<float const*, 6> link, x;

    float sum(Index m) const
    {
        return ((link[0][m] * x[0][m] + link[1][m] * x[1][m]) + (link[2][m] * x[2][m] + link[3][m] * x[3][m])) +
               (link[4][m] * x[4][m] + link[5][m] * x[5][m]);
    }
    float links(Index m) const
    {
        return ((link[0][m] + link[1][m]) + (link[2][m] + link[3][m])) + (link[4][m] + link[5][m]);
    }
};

GRANUM_VECTORISED void relax_run(Index first, Index end, Around const& around, float const* __restrict inverse,
                                 float const* __restrict right, float* __restrict x)
{
#pragma GCC ivdep
    for (Index m = first; m < end; ++m) x[m] = inverse[m] * (right[m] + around.sum(m));
}

GRANUM_VECTORISED void residual_run(Index first, Index end, Around const& around, float const* __restrict diagonal,
                                    float const* __restrict inverse, float const* __restrict right,
                                    float const* __restrict x, float* __restrict residual)
{
    // The diagonal last: ghosts, where it is zero, have no residual, whatever lies around them.
#pragma GCC ivdep
    for (Index m = first; m < end; ++m) residual[m] = diagonal[m] * (inverse[m] * (right[m] + around.sum(m)) - x[m]);
}

GRANUM_VECTORISED void start_run(Index first, Index end, float const* __restrict inverse, float const* __restrict right,
                                 float* __restrict x)
{
#pragma GCC ivdep
    for (Index m = first; m < end; ++m) x[m] = inverse[m] * right[m];
}

GRANUM_VECTORISED void close_run(Index first, Index end, Around const& around, float const* __restrict extra,
                                 float* __restrict diagonal, float* __restrict inverse)
{
#pragma GCC ivdep
    for (Index m = first; m < end; ++m) {
        diagonal[m] = extra[m] + around.links(m);
        inverse[m] = diagonal[m] > 0 ? 1 / diagonal[m] : 0;
    }
}

GRANUM_VECTORISED double sum_run(Index first, Index end, float const* __restrict a)
{
    return sum(first, end, a);
}

GRANUM_VECTORISED double dot_run(Index first, Index end, float const* __restrict a, float const* __restrict b)
{
    return dot(first, end, a, b);
}
}

Level::Level(grid::Layout const& cells_of_ranks, int rank, std::array<std::size_t, 3> const& order_in_memory,
             par::Communicator const& comm)
    : layout(cells_of_ranks), order(order_in_memory), lower(layout.box(rank).lower)
{
    int sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        n[d] = layout.box(rank).size(d);
        sum += lower[d];
        meets_itself_ = meets_itself_ || (layout.periodic[d] && layout.cells[d] > 1 && layout.cells[d] % 2 == 1);
    }
    auto const [a, b, c] = order;
    strides[a] = 1;
    strides[b] = (n[a] + 2) | 1;
    strides[c] = (strides[b] * (n[b] + 2)) | 1;
    origin_ = 1 + strides[b] + strides[c];
    origin_ += (origin_ + sum) % 2;  // the parity of the first cell's number is its colour
    half_ = static_cast<Index>(origin_ + strides[c] * (n[c] + 1)) / 2 + 1;
    half_ = (half_ + 15) / 16 * 16;  // both colours begin on a cache line

    for (auto* field : {&link[0], &link[1], &link[2], &extra, &diagonal, &inverse, &right, &x, &residual})
        field->assign(2 * half_, 0.0f);
    grid::Shape shape(n);
    shape.order = order;
    shape.strides = strides;
    shape.origin = static_cast<Index>(origin_);
    exchange_.emplace(layout, shape, half_, rank, comm);
    if (layout.box(rank).cells() == 0) return;
    for (std::size_t colour = 0; colour < 2; ++colour)
        all_[colour] = span(colour, number({0, 0, 0}), number({n[0] - 1, n[1] - 1, n[2] - 1}));
}

Level::Span Level::span(std::size_t colour, Index first, Index last) const
{
    return {(first + 1 - colour) / 2, (last + 2 - colour) / 2};
}

namespace
{
Around around(Level const& level, Index half, std::size_t colour)
{
    Around out;
    for (std::size_t d = 0; d < 3; ++d) {
        // Between the places of a cell of this colour and of its neighbours in the other one.
        std::ptrdiff_t const high = (level.strides[d] - 1) / 2 + static_cast<std::ptrdiff_t>(colour);
        std::ptrdiff_t const low = high - level.strides[d];
        auto const own = static_cast<std::ptrdiff_t>(colour * half), other = static_cast<std::ptrdiff_t>(half) - own;
        out.link[2 * d] = level.link[d].data() + own;
        out.link[2 * d + 1] = level.link[d].data() + other + high;
        out.x[2 * d] = level.x.data() + other + low;
        out.x[2 * d + 1] = level.x.data() + other + high;
    }
    return out;
}
}

std::array<double, 3> Level::close()
{
    std::array<double, 3> sums{};
    exchange_->refresh({&link[0], &link[1], &link[2], &extra});
    for_rows([&](Index first) {
        for (std::size_t colour = 0; colour < 2; ++colour) {
            auto const row = span(colour, first, first + static_cast<Index>(n[order[0]]) - 1);
            Index const at = colour * half_;
            close_run(row.first, row.end, around(*this, half_, colour), extra.data() + at, diagonal.data() + at,
                      inverse.data() + at);
            for (std::size_t d = 0; d < 3; ++d) sums[d] += sum_run(row.first, row.end, link[d].data() + at);
        }
    });
    return sums;
}

void Level::start(std::size_t colour)
{
    if (meets_itself_) std::fill(x.begin(), x.end(), 0.0f);  // ghosts of the other colour's cells are asked for first
    Index const at = colour * half_;
    start_run(all_[colour].first, all_[colour].end, inverse.data() + at, right.data() + at, x.data() + at);
}

void Level::relax(std::size_t colour)
{
    Index const at = colour * half_;
    relax_run(all_[colour].first, all_[colour].end, around(*this, half_, colour), inverse.data() + at,
              right.data() + at, x.data() + at);
}

void Level::find_residual(std::size_t colour)
{
    Index const at = colour * half_;
    residual_run(all_[colour].first, all_[colour].end, around(*this, half_, colour), diagonal.data() + at,
                 inverse.data() + at, right.data() + at, x.data() + at, residual.data() + at);
}

void Level::refresh(Values& field, std::size_t colour) const
{
    if (meets_itself_)  // a sweep has passed over ghosts that stand for cells of the other colour
        exchange_->refresh({&field});
    else
        exchange_->refresh(field, colour);
}

double Level::dot() const
{
    double sum = 0;
    for (std::size_t colour = 0; colour < 2; ++colour)
        sum += dot_run(all_[colour].first, all_[colour].end, right.data() + colour * half_, x.data() + colour * half_);
    return sum;
}
}
