#include "granum/coupling/mapping.hpp"

#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cmath>

namespace granum::coupling
{
Mapping::Mapping(Grid const& grid, par::Communicator const& comm, double bandwidth)
    : grid_(grid), comm_(comm), conductance_(grid.make_face_field()), work_(grid.make_field())
{
    if (bandwidth <= 0) return;
    // Variance 2 D T in each direction, cut into passes in which no full cell loses more than half of its content.
    double const least = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    double const diffusion = 0.5 * bandwidth * bandwidth;  // D T, m2
    passes_ = std::max(1, static_cast<int>(std::ceil(diffusion / (least * least / 12))));
    auto const strides = grid.strides();
    for (int direction = 0; direction < 3; ++direction) {
        auto const stride = strides[static_cast<std::size_t>(direction)];
        Field& conductance = conductance_[static_cast<std::size_t>(direction)];
        double const spacing = grid.spacing[static_cast<std::size_t>(direction)];
        for (Index cell = static_cast<Index>(stride); cell < grid.size(); ++cell) {
            double const smaller =
                std::min(grid.open_volume[cell], grid.open_volume[cell - static_cast<Index>(stride)]);
            double const full =
                diffusion / passes_ * grid.open_area[static_cast<std::size_t>(direction)][cell] / spacing;
            conductance[cell] = std::min(full, smaller / 12);  // small cut cells must not overshoot
        }
    }
}

Stencil Mapping::stencil(Vec3 const& position) const
{
    std::array<int, 3> low;
    std::array<std::array<double, 2>, 3> weight;
    for (std::size_t d = 0; d < 3; ++d) {
        double const local = (position[d] - grid_.origin[d]) / grid_.spacing[d] - 0.5 - (d == 0 ? grid_.shift : 0);
        double const floor = std::floor(local);
        low[d] = std::clamp(static_cast<int>(floor), -1, grid_.n[d] - 1);
        double const part = std::clamp(local - low[d], 0.0, 1.0);
        weight[d] = {1 - part, part};
    }
    Stencil out;
    double sum = 0;
    double const full = grid_.volume();
    for (int s = 0; s < 8; ++s) {
        int const a = s & 1, b = (s >> 1) & 1, c = s >> 2;
        Index const cell = grid_.at(low[0] + a, low[1] + b, low[2] + c);
        double const w = weight[0][static_cast<std::size_t>(a)] * weight[1][static_cast<std::size_t>(b)] *
                         weight[2][static_cast<std::size_t>(c)] * grid_.open_volume[cell] / full;
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
    grid::fold(grid_, comm_, amounts);
    grid::refresh(grid_, comm_, amounts);
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
    grid::refresh(grid_, comm_, fields);
    smooth(fields);
}

void Mapping::smooth(std::span<Field* const> fields) const
{
    auto const strides = grid_.strides();
    for (int pass = 0; pass < passes_; ++pass) {
        for (Field* field : fields) {
            Field const& old = *field;
            work_ = old;
            grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
                if (!grid_.open(cell)) return;
                double gain = 0;
                for (std::size_t d = 0; d < 3; ++d)
                    for (Index face : {cell, cell + static_cast<Index>(strides[d])}) {
                        double const g = conductance_[d][face];
                        if (g == 0) continue;
                        Index const other = face == cell ? cell - static_cast<Index>(strides[d]) : face;
                        gain += g * (old[other] - old[cell]);
                    }
                work_[cell] += gain / grid_.open_volume[cell];
            });
            field->swap(work_);
        }
        grid::refresh(grid_, comm_, fields);
    }
}
}
