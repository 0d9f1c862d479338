// The open geometry of a rank as the gas sees it: openings at the ends of the domain, faces between cells, walls.
#include "granum/base/error.hpp"
#include "granum/gas/inside.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
//! Opposite corners of the lower face of a cell across d.
std::array<Vec3, 2> corners(grid::Grid const& grid, std::size_t d, std::array<int, 3> const& cell)
{
    std::array<Vec3, 2> out;
    for (std::size_t e = 0; e < 3; ++e) {
        out[0][e] = grid.axes[e].face(cell[e]);
        out[1][e] = e == d ? out[0][e] : grid.axes[e].face(cell[e] + 1);
    }
    return out;
}

//! Calls visit(cell of the face, cell inside) for the open faces of this rank at an end of the domain.
template <class Visitor>
void for_end(grid::Grid const& grid, std::size_t d, bool upper, Visitor&& visit)
{
    if (!grid.at_end(d, upper)) return;
    std::array<int, 3> low{}, high{grid.n[0] - 1, grid.n[1] - 1, grid.n[2] - 1};
    low[d] = high[d] = upper ? grid.n[d] : 0;
    grid::for_each_cell(grid, low, high, [&](int i, int j, int k, Index face) {
        if (grid.open_area[d][face] == 0) return;
        visit(std::array<int, 3>{i, j, k}, face, upper ? grid.before(face, d) : face);
    });
}
}

void Solver::Inside::find_openings()
{
    for (std::size_t d = 0; d < 3; ++d)
        for (bool const upper : {false, true})
            for_end(grid, d, upper, [&](auto const&, Index face, Index) { area[d][face] = 0; });

    auto const add = [&](Opening const& at, std::size_t number, bool inlet) {
        double sum = 0;
        auto& list = inlet ? inlets : outlets;
        std::size_t const first = list.size();
        for_end(grid, at.direction, at.upper, [&](std::array<int, 3> const& cell, Index face, Index inside) {
            auto const [low, high] = corners(grid, at.direction, cell);
            double const full = grid.area(at.direction, cell), open = grid.open_area[at.direction][face];
            double const share = at.share ? at.share(low, high) : full;
            if (share <= (inlet ? 0.0 : 0.5 * full)) return;
            base::require(area[at.direction][face] == 0,
                          "gas: the openings \"{}\" and another one meet at ({}, {}, {}) m", at.name,
                          0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z));
            area[at.direction][face] = open;
            std::array<int, 3> within = cell;
            if (at.upper) --within[at.direction];
            double const to_centre = 0.5 * grid.axes[at.direction].width(within[at.direction]);
            list.push_back({face, inside, at.direction, at.upper, number, open, to_centre, share * open / full});
            sum += inlet ? list.back().share : open;
        });
        sum = comm.sum(sum);
        base::require(sum > 0, "gas: the {} \"{}\" has no open area", inlet ? "inlet" : "outlet", at.name);
        if (inlet)
            for (std::size_t k = first; k < list.size(); ++k) list[k].share /= sum;
        double open = 0;
        for (std::size_t k = first; k < list.size(); ++k) open += list[k].area;
        (inlet ? inlet_areas : outlet_areas).push_back(comm.sum(open));
    };
    for (std::size_t k = 0; k < settings.inlets.size(); ++k) add(settings.inlets[k].at, k, true);
    for (std::size_t k = 0; k < settings.outlets.size(); ++k)
        if (!grid.periodic[settings.outlets[k].at.direction]) add(settings.outlets[k].at, k, false);
    base::require(
        settings.inlets.empty() || !outlet_areas.empty() || settings.compressibility != Compressibility::constant,
        "gas of constant density enters but has no outlet");
    refresh({&area[0], &area[1], &area[2]});
}

void Solver::Inside::find_faces()
{
    FaceField present = grid.make_face_field();
    std::array<int, 3> const last{grid.n[0] - 1, grid.n[1] - 1, grid.n[2] - 1};
    for (std::size_t d = 0; d < 3; ++d) {
        std::array<int, 3> beyond = last;
        ++beyond[d];  // the upper face of the last cell has a gap too
        grid::for_each_cell(grid, {0, 0, 0}, beyond, [&](int i, int j, int k, Index c) {
            std::array<int, 3> const cell{i, j, k};
            double const above = grid.axes[d].width(cell[d]), below = grid.axes[d].width(cell[d] - 1);
            per_gap[d][c] = 1 / grid.axes[d].gap(cell[d]);
            low_share[d][c] = above / (above + below);
        });
        faces[d] = grid::runs(grid, [&](int i, int j, int k, Index c) {
            std::array<int, 3> const cell{i, j, k};
            bool const end = cell[d] == 0 && grid.at_end(d, false);
            bool const inner = area[d][c] > 0 && !end;
            if (inner) solved[d][c] = present[d][c] = 1;
            return inner;
        });
        for (auto const* list : {&inlets, &outlets})
            for (auto const& opening : *list)
                if (opening.d == d) present[d][opening.face] = 1;
        refresh({&solved[d], &present[d], &per_gap[d], &low_share[d]});
    }
    for (std::size_t d = 0; d < 3; ++d) {
        for (auto const& run : faces[d])
            for (Index q = run.first; q < run.end; ++q)
                face_volume[d][q] = 0.5 * (grid.open_volume[q] + grid.open_volume[before(q, d)]);
        refresh({&face_volume[d]});
        for (std::size_t e = 0; e < 3; ++e) {
            if (repeats_itself(e)) continue;
            // Links of all faces, and those above the last: of faces that another rank or an opening has.
            std::array<int, 3> beyond = last;
            ++beyond[e];
            grid::for_each_cell(grid, {0, 0, 0}, beyond, [&](int i, int j, int k, Index q) {
                std::array<int, 3> const cell{i, j, k};
                Index const low = before(q, e);
                if (e == d) {
                    if (present[d][q] * present[d][low] == 0) return;
                    double const width = grid.axes[d].width(cell[d] - 1);
                    reach[d][d][q] = grid.open_volume[low] / (width * width);
                } else {
                    if (solved[d][q] * solved[d][low] == 0) return;
                    reach[d][e][q] = 0.5 * (area[e][before(q, d)] + area[e][q]) * per_gap[e][q];
                }
                coupled[d][e][q] = 1;
            });
            refresh({&reach[d][e], &coupled[d][e]});
        }
        weights.lower[d] = grid.make_field();
        weights.upper[d] = grid.make_field();
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            double const low = solved[d][c], high = solved[d][next(c, d)];
            if (low + high == 0) return;
            weights.lower[d][c] = low / (low + high);
            weights.upper[d][c] = high / (low + high);
        });
        refresh({&weights.lower[d], &weights.upper[d]});
    }
    cells = grid::runs(grid, [&](int, int, int, Index c) { return grid.open(c); });

    // Faces along which an inlet's gas flows.
    FaceField entered = grid.make_face_field();
    for (auto const& inlet : inlets) entered[inlet.d][inlet.face] = 1;
    refresh({&entered[0], &entered[1], &entered[2]});
    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& run : faces[d])
            for (Index q = run.first; q < run.end; ++q)
                for (std::size_t e = 0; e < 3; ++e)
                    for (bool const upper : {false, true}) {
                        Index const edge = upper ? next(q, e) : q, low = before(edge, d);
                        if (e != d && entered[e][edge] + entered[e][low] > 0)
                            inlet_edges[d].push_back({q, e, low, edge, upper ? -1.0 : 1.0});
                    }
}

// Where the two faces of a cell differ, the difference is wall, and the mean distance to it is half of volume over
// wall; two closed faces are two walls.
void Solver::Inside::find_walls()
{
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        if (!grid.open(c)) return;
        std::array<int, 3> const cell{i, j, k};
        double const open = grid.open_volume[c];
        int ends = 0;  // pieces that are faces of the cell
        for (std::size_t e = 0; e < 3; ++e) {
            double const low = area[e][c], high = area[e][next(c, e)], width = grid.axes[e].width(cell[e]);
            auto const add = [&](bool upper, double wall, double distance) {
                Vec3 x = grid.centre(i, j, k);
                x[e] = grid.axes[e].face(cell[e] + (upper ? 1 : 0));
                std::size_t const number = settings.wall_at ? settings.wall_at(x) : 0;
                base::require(number < settings.walls.size(), "gas: wall {} of {}", number, settings.walls.size());
                wall_pieces.push_back({c, e, number, upper, wall, distance, x});
            };
            if (low == 0 && high == 0) {
                for (bool const upper : {false, true}) add(upper, open / width, 0.5 * width);
                ends += open > 0.999999 * grid.volume(i, j, k);
            } else if (double const wall = std::abs(high - low); wall > 1e-12 * std::max(low, high)) {
                // Slivers: no nearer than a tenth of a cell.
                add(high < low, wall, std::max(0.5 * open / wall, 0.1 * width));
                ends += std::min(low, high) == 0 && open > 0.999999 * grid.volume(i, j, k);
            }
        }
        wall_oblique.resize(wall_pieces.size(), ends == 0);
    });
}
}
