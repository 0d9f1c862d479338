#include "granum/gas/inside.hpp"

#include "granum/base/error.hpp"
#include "granum/grid/halo.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
//! Wall area over wall distance of a cell for walls with normals along `e`, m. Where the two faces of a cell differ,
//! the difference is wall, and the mean distance to it is half of volume over wall; two closed faces are two walls.
double wall_reach(grid::Grid const& grid, FaceField const& area, Index cell, std::size_t e)
{
    double const open = grid.open_volume[cell];
    if (open <= 0) return 0;
    double const low = area[e][cell], high = area[e][cell + static_cast<Index>(grid.strides()[e])];
    double const width = grid.spacing[e];
    if (low == 0 && high == 0) return 2 * (open / width) / (0.5 * width);
    double const wall = std::abs(high - low);
    if (wall == 0) return 0;
    return wall / std::max(0.5 * open / wall, 0.1 * width);  // slivers: no nearer than a tenth of a cell
}
}

Solver::Inside::Inside(Settings given, grid::Grid const& cells, par::Communicator const& ranks)
    : settings(std::move(given)),
      grid(cells),
      comm(ranks),
      plate(settings.inlet.has_value() && !cells.periodic[2]),
      top(settings.outlet && !cells.periodic[2]),
      area(cells.open_area),
      face_volume(cells.make_face_field()),
      shear(cells.make_face_field()),
      weights{},
      pressure(cells, ranks, solve::Method::multigrid),
      system(cells),
      correction(cells.make_field()),
      exchanged(cells.make_field(settings.ambient_temperature)),
      mobility(cells.make_face_field())
{
    base::require(!plate || top, "gas enters through the plate but has no outlet");
    auto const [nx, ny, nz] = grid.n;
    for (int j = -1; j <= ny; ++j)
        for (int i = -1; i <= nx; ++i) {
            if (grid.periodic[2]) continue;
            if (!plate) area[2][grid.at(i, j, 0)] = 0;
            if (!top) area[2][grid.at(i, j, nz)] = 0;
        }
    if (plate)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) plate_area += area[2][grid.at(i, j, 0)];
    plate_area = comm.sum(plate_area);
    base::require(!plate || plate_area > 0, "the plate has no open area");

    FaceField inner = grid.make_face_field();
    for (std::size_t d = 0; d < 3; ++d) {
        weights.lower[d] = grid.make_field();
        weights.upper[d] = grid.make_field();
        grid::for_each_cell(grid, [&](int, int, int k, Index c) {
            bool const at_plate = d == 2 && k == 0 && !grid.periodic[2];
            if (area[d][c] == 0 || at_plate) return;
            inner[d][c] = 1;
            face_volume[d][c] = 0.5 * (grid.open_volume[c] + grid.open_volume[before(c, d)]);
            faces[d].push_back({c, false, plate && d != 2 && k == 0});
        });
        if (d == 2 && top)
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i) {
                    Index const c = grid.at(i, j, nz);
                    if (area[d][c] == 0) continue;
                    face_volume[d][c] = 0.5 * grid.open_volume[before(c, d)];
                    faces[d].push_back({c, true, false});
                }
        refresh({&inner[d], &face_volume[d]});
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            double const low = inner[d][c], high = inner[d][next(c, d)];
            if (low + high == 0) return;
            weights.lower[d][c] = low / (low + high);
            weights.upper[d][c] = high / (low + high);
        });
        refresh({&weights.lower[d], &weights.upper[d]});
    }

    // Walls of a cell slow the two components along them; each face takes half of its cells.
    std::array<Field, 3> reach{grid.make_field(), grid.make_field(), grid.make_field()};
    for (std::size_t e = 0; e < 3; ++e) {
        grid::for_each_cell(grid, [&](int, int, int k, Index c) {
            bool const end = e == 2 && !grid.periodic[2] && ((k == 0 && plate) || (k == nz - 1 && top));
            reach[e][c] = end ? 0 : wall_reach(grid, area, c, e);
        });
        refresh({&reach[e]});
    }
    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& row : faces[d])
            for (std::size_t e = 0; e < 3; ++e) {
                if (e == d) continue;
                shear[d][row.face] += 0.5 * reach[e][before(row.face, d)];
                if (!row.outlet) shear[d][row.face] += 0.5 * reach[e][row.face];
            }

    for (std::size_t d = 0; d < 3; ++d) momentum_rows[d].resize(faces[d].size());
    grid::for_each_cell(grid, [&](int, int, int, Index c) {
        if (grid.open(c)) open_cells.push_back(c);
    });
    cell_rows.resize(open_cells.size());
    carried = {.content = grid.make_field(),
               .capacity = grid.make_field(),
               .flux = grid.make_face_field(),
               .conductance = grid.make_face_field(),
               .source = grid.make_field(),
               .sink = grid.make_field(),
               .at_plate = 0,
               .at_top = 0,
               .passed = grid.make_face_field()};
}

void Solver::Inside::refresh(std::initializer_list<Field*> fields) const
{
    grid::refresh(grid, comm, std::span<Field* const>(fields.begin(), fields.size()));
}

double Solver::Inside::viscosity(double temperature) const
{
    return settings.viscosity ? *settings.viscosity : material::viscosity(temperature);
}

double Solver::Inside::equation_of_state(double at_pressure, double temperature, double vapour_fraction) const
{
    return settings.density ? *settings.density : material::density(at_pressure, temperature, vapour_fraction);
}

double Solver::Inside::inlet_flux(Index face) const
{
    return settings.inlet->mass_flow * area[2][face] / plate_area;
}

std::array<double, 6> Solver::Inside::viscous_reach(FaceRow const& row, std::size_t d) const
{
    std::array<double, 6> reach{};
    Index const q = row.face, low = before(q, d);
    double const width = grid.spacing[d];
    reach[2 * d] = grid.open_volume[low] / (width * width);
    if (!row.outlet) reach[2 * d + 1] = grid.open_volume[q] / (width * width);
    for (std::size_t e = 0; e < 3; ++e) {
        if (e == d) continue;
        for (int side : {0, 1}) {
            Index const beside = side == 0 ? before(q, e) : next(q, e);
            if (face_volume[d][beside] == 0) continue;  // plate, top or wall: nothing to drag along
            Index const edge = side == 0 ? q : beside;
            double const open = 0.5 * (area[e][before(edge, d)] + (row.outlet ? 0 : area[e][edge]));
            reach[2 * e + static_cast<std::size_t>(side)] = open / grid.spacing[e];
        }
    }
    return reach;
}

void Solver::Inside::check(Sources const& sources) const
{
    // What is given to a closed cell would be lost without a word.
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        if (grid.open(c)) return;
        bool const none = sources.mass[c] == 0 && sources.vapour[c] == 0 && sources.enthalpy[c] == 0 &&
                          sources.heat_value[c] == 0 && sources.heat_coefficient[c] == 0;
        base::require(none, "gas: a source lies in cell ({}, {}, {}), which is closed by the wall", i + grid.shift, j,
                      k);
    });
}

SharedSources Solver::Inside::share(Sources const& sources) const
{
    SharedSources shared{sources.drag_coefficient, sources.mass, sources.force};
    for (std::size_t d = 0; d < 3; ++d)
        for (Index c = 0; c < shared.push[d].size(); ++c) shared.push[d][c] += sources.drag_momentum[d][c];
    refresh({&shared.drag_coefficient, &shared.mass, &shared.push[0], &shared.push[1], &shared.push[2]});
    return shared;
}

void Solver::Inside::check(State const& state) const
{
    auto look = [&](Field const& field, char const* name, bool positive) {
        grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
            if (std::isfinite(field[c]) && !(positive && grid.open(c) && !(field[c] > 0))) return;
            Vec3 const x = grid.centre(i, j, k);
            throw base::NumericsError(fmt::format("gas: {} is {} in cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m",
                                                  name, field[c], i + grid.shift, j, k, x.x, x.y, x.z));
        });
    };
    look(state.mass, "mass", true);
    look(state.pressure, "pressure", false);
    look(state.velocity[0], "velocity along x", false);
    look(state.velocity[1], "velocity along y", false);
    look(state.velocity[2], "velocity along z", false);
    look(state.vapour_fraction, "vapour fraction", false);
    look(state.temperature, "temperature", true);
}
}
