#include "granum/coupling/mapping.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/geometry/ball_in_box.hpp"
#include "granum/math/short_axes.hpp"

#include <algorithm>
#include <cmath>

namespace granum::coupling
{
namespace
{
GRANUM_VECTORISED void diffuse(Index first, Index end, std::array<std::ptrdiff_t, 3> const s,
                               std::array<double const*, 3> const g, double const* __restrict per_volume,
                               double const* __restrict old, double* __restrict fresh)
{
    Index const s0 = static_cast<Index>(s[0]), s1 = static_cast<Index>(s[1]), s2 = static_cast<Index>(s[2]);
    double const *g0 = g[0], *g1 = g[1], *g2 = g[2];
#pragma GCC ivdep
    for (Index c = first; c < end; ++c) {
        double const here = old[c];
        double const gain = g0[c] * (old[c - s0] - here) + g0[c + s0] * (old[c + s0] - here) +
                            g1[c] * (old[c - s1] - here) + g1[c + s1] * (old[c + s1] - here) +
                            g2[c] * (old[c - s2] - here) + g2[c + s2] * (old[c + s2] - here);
        fresh[c] = here + gain * per_volume[c];
    }
}
}

Mapping::Mapping(Grid const& grid, par::Communicator const& comm, double width, Scheme scheme)
    : grid_(grid),
      scheme_(scheme),
      open_fraction_(grid.make_field()),
      open_cells_(grid::runs(grid, [&](int, int, int, Index c) { return grid.open(c); })),
      conductance_(grid.make_face_field()),
      per_volume_(grid.make_field()),
      work_(grid.make_field())
{
    for (std::size_t s = 0; s < 8; ++s)
        offset_[s] = static_cast<std::ptrdiff_t>(s & 1) * grid.strides[0] +
                     static_cast<std::ptrdiff_t>((s >> 1) & 1) * grid.strides[1] +
                     static_cast<std::ptrdiff_t>(s >> 2) * grid.strides[2];
    grid::for_each_cell(grid, [&](int i, int j, int k, Index cell) {
        open_fraction_[cell] = grid.open_volume[cell] / grid.volume(i, j, k);
        per_volume_[cell] = grid.open(cell) ? 1 / grid.open_volume[cell] : 0;
    });
    grid::refresh(grid, {&open_fraction_});
    if (width <= 0) return;
    // The cells' own share of the variance, and the rest as 2 D T: cut into passes in which no cell loses more than
    // half of its content.
    double const of_cells = scheme == Scheme::kernel ? 1.0 / 6 : 1.0 / 12;
    grid::FaceField rest = grid.make_face_field();
    double most = 0;
    for (std::size_t d = 0; d < 3; ++d)
        grid::for_each_cell(grid, [&](int i, int j, int k, Index cell) {
            double const gap = grid.axes[d].gap(std::array{i, j, k}[d]);
            if (grid.open_area[d][cell] == 0 || !grid.open(cell) || !grid.open(grid.before(cell, d))) return;
            rest[d][cell] = std::max(0.0, width * width - of_cells * gap * gap);
            most = std::max(most, rest[d][cell] / (gap * gap));
        });
    passes_ = static_cast<int>(std::ceil(6 * comm.max(most)));
    for (std::size_t d = 0; d < 3; ++d) {
        grid::for_each_cell(grid, [&](int i, int j, int k, Index cell) {
            if (rest[d][cell] == 0) return;
            double const smaller = std::min(grid.open_volume[cell], grid.open_volume[grid.before(cell, d)]);
            double const full =
                0.5 * rest[d][cell] / passes_ * grid.open_area[d][cell] / grid.axes[d].gap(std::array{i, j, k}[d]);
            conductance_[d][cell] = std::min(full, smaller / 12);  // small cut cells must not overshoot
        });
        grid::refresh(grid, {&conductance_[d]});
    }
}

double Mapping::near(std::size_t d, double x) const
{
    auto const& axis = grid_.axes[d];
    if (!grid_.periodic[d] || (x >= axis.face(-1) && x < axis.face(grid_.n[d] + 1))) return x;
    double const length = grid_.lines[d].back() - grid_.lines[d].front();
    return x + (x < axis.face(-1) ? length : -length);
}

Stencil Mapping::stencil(Vec3 const& position, double radius) const
{
    std::array<int, 3> low;
    std::array<std::array<double, 2>, 3> weight;
    Vec3 x;
    for (std::size_t d = 0; d < 3; ++d) {
        auto const& axis = grid_.axes[d];
        int const last = grid_.n[d] - 1;
        x[d] = near(d, position[d]);
        int const cell = std::clamp(axis.cell(x[d]), 0, last);
        switch (scheme_) {
            case Scheme::kernel: {
                bool const beyond = x[d] >= axis.face(last + 1);
                low[d] = beyond ? last : x[d] < axis.centre(cell) ? cell - 1 : cell;
                double const part = std::clamp((x[d] - axis.centre(low[d])) / axis.gap(low[d] + 1), 0.0, 1.0);
                weight[d] = {1 - part, part};
                break;
            }
            case Scheme::centre:
                low[d] = cell;
                weight[d] = {1, 0};
                break;
            case Scheme::divided:
                low[d] = std::clamp(axis.cell(x[d] - radius), -1, last);
                weight[d] = {1, 1};
                break;
        }
    }
    Stencil out;
    out.base = static_cast<std::uint32_t>(grid_.at(low));
    double sum = 0;
    for (std::size_t s = 0; s < 8; ++s) {
        std::array<std::size_t, 3> const up{s & 1, (s >> 1) & 1, s >> 2};
        Index const here = cell(out, s);
        double w = weight[0][up[0]] * weight[1][up[1]] * weight[2][up[2]];
        if (scheme_ == Scheme::kernel)
            w *= open_fraction_[here];
        else if (!grid_.open(here))
            w = 0;
        else if (scheme_ == Scheme::divided) {
            Vec3 from, to;
            for (std::size_t d = 0; d < 3; ++d) {
                int const i = low[d] + static_cast<int>(up[d]);
                from[d] = grid_.axes[d].face(i), to[d] = grid_.axes[d].face(i + 1);
            }
            w = geometry::ball_in_box(x, radius, from, to);
        }
        out.weight[s] = w;
        sum += w;
    }
    if (!(sum > 0) && scheme_ != Scheme::kernel) {
        // The cell of the centre is behind a wall: the open ones around it take over.
        Mapping const& other = *this;
        Stencil around;
        around.base = out.base;
        for (std::size_t s = 0; s < 8; ++s) around.weight[s] = open_fraction_[other.cell(around, s)];
        for (double const w : around.weight) sum += w;
        out = around;
    }
    if (sum > 0)
        for (double& w : out.weight) w /= sum;
    return out;
}

void Mapping::place_cells(particle::Store const& granules)
{
    Vec3 low = granules.owned > 0 ? granules.position[0] : Vec3{}, high = low;
    for (std::size_t row = 0; row < granules.owned; ++row)
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], granules.position[row][d]);
            high[d] = std::max(high[d], granules.position[row][d]);
        }
    auto const axes = math::short_axes(high - low);
    if (axes == fastest_ && !place_.empty()) return;
    fastest_ = axes;
    place_.resize(grid_.size());
    std::array<std::uint32_t, 3> stride{};
    std::uint32_t next = 1;
    for (auto const d : axes) stride[d] = next, next *= static_cast<std::uint32_t>(grid_.n[d] + 2);
    for (int k = -1; k <= grid_.n[2]; ++k)
        for (int j = -1; j <= grid_.n[1]; ++j)
            for (int i = -1; i <= grid_.n[0]; ++i)
                place_[grid_.at({i, j, k})] = static_cast<std::uint32_t>(i + 1) * stride[0] +
                                              static_cast<std::uint32_t>(j + 1) * stride[1] +
                                              static_cast<std::uint32_t>(k + 1) * stride[2];
}

void Mapping::locate(particle::Store const& granules)
{
    stencils_.resize(granules.owned);
    order_.resize(granules.owned);
    count_.assign(grid_.size() + 1, 0);
    place_cells(granules);
    for (std::size_t row = 0; row < granules.owned; ++row) {
        stencils_[row] = stencil(granules.position[row], granules.radius[row]);
        ++count_[place_[stencils_[row].base] + 1];
    }
    for (std::size_t c = 1; c < count_.size(); ++c) count_[c] += count_[c - 1];
    for (std::uint32_t row = 0; row < granules.owned; ++row) order_[count_[place_[stencils_[row].base]]++] = row;
    // count_[c] is now the end of cell c.
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < grid_.size(); ++c) {
        auto const end = count_[c];
        for (std::uint32_t k = begin + 1; k < end; ++k) {
            auto const row = order_[k];
            std::uint32_t at = k;
            for (; at > begin && granules.id[order_[at - 1]] > granules.id[row]; --at) order_[at] = order_[at - 1];
            order_[at] = row;
        }
        begin = end;
    }
}

void Mapping::bundle(std::array<Field const*, 8> const& fields, Bundle& out) const
{
    for (std::size_t k = 0; k < 8; ++k) {
        if (fields[k])
            for (Index c = 0; c < grid_.size(); ++c) out[c][k] = (*fields[k])[c];
        else
            for (Index c = 0; c < grid_.size(); ++c) out[c][k] = 0;
    }
}

void Mapping::unbundle(Bundle const& cells, std::array<Field*, 8> const& fields) const
{
    for (std::size_t k = 0; k < 8; ++k)
        if (fields[k])
            for (Index c = 0; c < grid_.size(); ++c) (*fields[k])[c] += cells[c][k];
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
    std::array<double const*, 3> const g{conductance_[0].data(), conductance_[1].data(), conductance_[2].data()};
    for (int pass = 0; pass < passes_; ++pass) {
        for (Field* field : fields) {
            work_ = *field;
            for (auto const& run : open_cells_)
                diffuse(run.first, run.end, grid_.strides, g, per_volume_.data(), field->data(), work_.data());
            field->swap(work_);
        }
        grid::refresh(grid_, fields);
    }
}
}
