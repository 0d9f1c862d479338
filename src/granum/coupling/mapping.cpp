#include "granum/coupling/mapping.hpp"

#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::coupling
{
Mapping::Mapping(Grid const& grid, par::Communicator const& comm, double bandwidth)
    : grid_(grid), open_fraction_(grid.make_field()), conductance_(grid.make_face_field()), work_(grid.make_field())
{
    grid::for_each_cell(grid, [&](int i, int j, int k, Index cell) {
        open_fraction_[cell] = grid.open_volume[cell] / grid.volume(i, j, k);
    });
    grid::refresh(grid, {&open_fraction_});
    if (bandwidth <= 0) return;
    // Variance 2 D T in each direction, cut into passes in which no full cell loses more than half of its content.
    double least = std::numeric_limits<double>::infinity();
    for (auto const& axis : grid.axes) least = std::min(least, axis.narrowest());
    least = comm.min(least);
    double const diffusion = 0.5 * bandwidth * bandwidth;  // D T, m2
    passes_ = std::max(1, static_cast<int>(std::ceil(diffusion / (least * least / 12))));
    for (std::size_t d = 0; d < 3; ++d) {
        grid::for_each_cell(grid, [&](int i, int j, int k, Index cell) {
            std::array<int, 3> const at{i, j, k};
            double const smaller = std::min(grid.open_volume[cell], grid.open_volume[grid.before(cell, d)]);
            double const full = diffusion / passes_ * grid.open_area[d][cell] / grid.axes[d].gap(at[d]);
            conductance_[d][cell] = std::min(full, smaller / 12);  // small cut cells must not overshoot
        });
        grid::refresh(grid, {&conductance_[d]});
    }
}

Stencil Mapping::stencil(Vec3 const& position) const
{
    std::array<int, 3> low;
    std::array<std::array<double, 2>, 3> weight;
    for (std::size_t d = 0; d < 3; ++d) {
        auto const& axis = grid_.axes[d];
        double x = position[d];
        // A granule may be ahead of its rank's part by less than half a cell, over a periodic end too.
        if (grid_.periodic[d] && (x < axis.face(-1) || x >= axis.face(grid_.n[d] + 1))) {
            double const length = grid_.lines[d].back() - grid_.lines[d].front();
            x += x < axis.face(-1) ? length : -length;
        }
        int const cell = std::clamp(axis.cell(x), 0, grid_.n[d] - 1);
        low[d] = x < axis.centre(cell) ? cell - 1 : cell;
        if (x >= axis.face(grid_.n[d])) low[d] = grid_.n[d] - 1;
        double const part = std::clamp((x - axis.centre(low[d])) / axis.gap(low[d] + 1), 0.0, 1.0);
        weight[d] = {1 - part, part};
    }
    Stencil out;
    double sum = 0;
    for (int s = 0; s < 8; ++s) {
        int const a = s & 1, b = (s >> 1) & 1, c = s >> 2;
        Index const cell = grid_.at(low[0] + a, low[1] + b, low[2] + c);
        double const w = weight[0][static_cast<std::size_t>(a)] * weight[1][static_cast<std::size_t>(b)] *
                         weight[2][static_cast<std::size_t>(c)] * open_fraction_[cell];
        out.cell[static_cast<std::size_t>(s)] = static_cast<std::uint32_t>(cell);
        out.weight[static_cast<std::size_t>(s)] = w;
        sum += w;
    }
    if (sum > 0)
        for (double& w : out.weight) w /= sum;
    return out;
}

void Mapping::locate(particle::Store const& granules)
{
    stencils_.resize(granules.owned);
    for (std::size_t row = 0; row < granules.owned; ++row) stencils_[row] = stencil(granules.position[row]);
    order_ = particle::rows_by_identity(granules);
}

void Mapping::finish(std::span<Field* const> amounts) const
{
    grid::fold(grid_, amounts);
    grid::refresh(grid_, amounts);
    if (passes_ == 0) return;
    // What diffuses is the amount per open volume; in the sum over cells every exchange cancels.
    for (Field* amount : amounts)
        for (Index cell = 0; cell < amount->size(); ++cell)
            if (grid_.open(cell)) (*amount)[cell] /= grid_.open_volume[cell];
    smooth(amounts);
    for (Field* amount : amounts)
        for (Index cell = 0; cell < amount->size(); ++cell) (*amount)[cell] *= grid_.open_volume[cell];
}

void Mapping::prepare(std::span<Field* const> fields) const
{
    grid::refresh(grid_, fields);
    smooth(fields);
}

void Mapping::smooth(std::span<Field* const> fields) const
{
    for (int pass = 0; pass < passes_; ++pass) {
        for (Field* field : fields) {
            Field const& old = *field;
            work_ = old;
            grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
                if (!grid_.open(cell)) return;
                double gain = 0;
                for (std::size_t d = 0; d < 3; ++d)
                    for (Index face : {cell, grid_.next(cell, d)}) {
                        double const g = conductance_[d][face];
                        if (g == 0) continue;
                        Index const other = face == cell ? grid_.before(cell, d) : face;
                        gain += g * (old[other] - old[cell]);
                    }
                work_[cell] += gain / grid_.open_volume[cell];
            });
            field->swap(work_);
        }
        grid::refresh(grid_, fields);
    }
}
}
