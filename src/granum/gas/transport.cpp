// Vapour and heat, carried by the fluxes of the projection: implicit first-order upwind and two-point diffusion.
//
// Heat is solved in its sensible part, capacity times (T - 0 degC): the part that vapour holds, its evaporation
// enthalpy at 0 degC, travels with the vapour's own fluxes. The capacity fluxes follow from the fluxes of mass and
// vapour, diffusion included, so that gas of one temperature keeps it whatever its vapour does.
#include "granum/gas/inside.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
constexpr double sweep_tolerance = 1e-10;  // change of a sweep over the largest value
constexpr int most_sweeps = 500;
}

void Solver::Inside::carry(Carried& what, Field& x, double dt)
{
    for (int j = -1; j <= grid.n[1]; ++j)
        for (int i = -1; i <= grid.n[0]; ++i) {
            if (plate) x[grid.at(i, j, -1)] = what.at_plate;
            if (top) x[grid.at(i, j, grid.n[2])] = what.at_top;
        }
    for (std::size_t r = 0; r < open_cells.size(); ++r) {
        Row& row = cell_rows[r];
        Index const c = open_cells[r];
        row.centre = what.capacity[c] / dt + what.sink[c];
        row.right = what.content[c] / dt + what.source[c];
        for (std::size_t d = 0; d < 3; ++d) {
            Index const up = next(c, d);
            double const in = what.flux[d][c], out = what.flux[d][up];
            row.beside[2 * d] = std::max(in, 0.0) + what.conductance[d][c];
            row.beside[2 * d + 1] = std::max(-out, 0.0) + what.conductance[d][up];
            row.centre += std::max(-in, 0.0) + what.conductance[d][c] + std::max(out, 0.0) + what.conductance[d][up];
        }
        row.inverse = 1 / row.centre;
    }

    std::array<std::ptrdiff_t, 6> offset{};
    for (std::size_t d = 0; d < 3; ++d) offset[2 * d] = -stride(d), offset[2 * d + 1] = stride(d);
    double scale = 0;  // largest value of all ranks, from the first sweep
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double change = 0, largest = 0;
        auto step = [&](Row const& row, Index c) {
            double const* at = x.data() + c;
            double sum = row.right;
            for (std::size_t m = 0; m < 6; ++m) sum += row.beside[m] * at[offset[m]];
            double const value = sum * row.inverse;
            change = std::max(change, std::abs(value - x[c]));
            largest = std::max(largest, std::abs(value));
            x[c] = value;
        };
        // Along the rise of the gas first, then back.
        std::size_t const count = open_cells.size();
        if (sweep % 2 == 0)
            for (std::size_t r = 0; r < count; ++r) step(cell_rows[r], open_cells[r]);
        else
            for (std::size_t r = count; r-- > 0;) step(cell_rows[r], open_cells[r]);
        refresh({&x});
        if (sweep == 0) scale = comm.size() > 1 ? comm.max(largest) : largest;
        if (comm.size() > 1) change = comm.max(change);
        if (change <= sweep_tolerance * scale) break;
    }

    // What passed each face at the solution; contents change by that and by nothing else.
    for (std::size_t d = 0; d < 3; ++d) {
        auto pass = [&](Index q) {
            double const low = x[before(q, d)], high = x[q], flux = what.flux[d][q];
            what.passed[d][q] = flux * (flux > 0 ? low : high) - what.conductance[d][q] * (high - low);
        };
        grid::for_each_cell(grid, [&](int, int, int, Index c) { pass(c); });
        if (d == 2)
            for (int j = 0; j < grid.n[1]; ++j)
                for (int i = 0; i < grid.n[0]; ++i) pass(grid.at(i, j, grid.n[2]));
    }
    refresh({&what.passed[0], &what.passed[1], &what.passed[2]});
    grid::for_each_cell(grid, [&](int, int, int, Index c) {
        if (!grid.open(c)) return;
        double gain = what.source[c] - what.sink[c] * x[c];
        for (std::size_t d = 0; d < 3; ++d) gain += what.passed[d][c] - what.passed[d][next(c, d)];
        what.content[c] += dt * gain;
    });
}

void Solver::Inside::carry_vapour_and_heat(State& state, Sources const& sources, double dt, Balance& balance)
{
    using namespace material;
    constexpr double more = heat_capacity_vapour - heat_capacity_air;
    Settings const& set = settings;
    Carried& it = carried;
    double const inlet_temperature = set.inlet ? set.inlet->temperature : set.ambient_temperature;

    Field density_diffusivity = grid.make_field(), conducting = grid.make_field();
    for (Index c = 0; c < grid.size(); ++c) {
        if (!grid.open(c)) continue;
        density_diffusivity[c] = state.mass[c] / grid.open_volume[c] * diffusivity(state.temperature[c], set.pressure);
        conducting[c] = state.voidage[c] * (set.conductivity ? *set.conductivity : conductivity(state.temperature[c]));
    }
    auto conduct = [&](Field const& property) {
        for (std::size_t d = 0; d < 3; ++d) {
            for (FaceRow const& face : faces[d]) {
                if (face.outlet) continue;
                double const mean = 0.5 * (property[face.face] + property[before(face.face, d)]);
                it.conductance[d][face.face] = mean * area[d][face.face] / grid.spacing[d];
            }
            refresh({&it.conductance[d]});
        }
    };
    auto at_plate = [&](auto&& add) {
        for (int j = 0; j < grid.n[1]; ++j)
            for (int i = 0; i < grid.n[0]; ++i) add(grid.at(i, j, 0));
    };
    auto at_top = [&](auto&& add) {
        for (int j = 0; j < grid.n[1]; ++j)
            for (int i = 0; i < grid.n[0]; ++i) add(grid.at(i, j, grid.n[2]));
    };

    // Sensible heat before the vapour changes.
    Field sensible = grid.make_field();
    for (Index c = 0; c < grid.size(); ++c) sensible[c] = state.enthalpy[c] - evaporation_enthalpy_0 * state.vapour[c];

    conduct(density_diffusivity);
    it.content = state.vapour;
    it.capacity = state.mass;
    it.flux = state.mass_flux;
    it.source = sources.vapour;
    std::fill(it.sink.begin(), it.sink.end(), 0.0);
    it.at_plate = set.inlet ? set.inlet->vapour_fraction : 0;
    it.at_top = set.ambient_vapour_fraction;
    carry(it, state.vapour_fraction, dt);
    state.vapour = it.content;
    if (plate)
        at_plate([&](Index q) {
            balance.mass_in += dt * state.mass_flux[2][q];
            balance.vapour_in += dt * it.passed[2][q];
            balance.enthalpy_in += dt * evaporation_enthalpy_0 * it.passed[2][q];
        });
    if (top)
        at_top([&](Index q) {
            balance.mass_out += dt * state.mass_flux[2][q];
            balance.vapour_out += dt * it.passed[2][q];
            balance.enthalpy_out += dt * evaporation_enthalpy_0 * it.passed[2][q];
        });

    conduct(conducting);
    for (std::size_t d = 0; d < 3; ++d)
        for (Index q = 0; q < grid.size(); ++q)
            it.flux[d][q] = heat_capacity_air * state.mass_flux[d][q] + more * it.passed[d][q];
    for (Index c = 0; c < grid.size(); ++c) {
        it.capacity[c] = heat_capacity_air * state.mass[c] + more * state.vapour[c];
        it.source[c] = sources.enthalpy[c] - evaporation_enthalpy_0 * sources.vapour[c] + sources.heat_value[c];
        exchanged[c] = state.temperature[c] - math::zero_celsius;
    }
    it.content = sensible;
    it.sink = sources.heat_coefficient;
    it.at_plate = inlet_temperature - math::zero_celsius;
    it.at_top = set.ambient_temperature - math::zero_celsius;
    carry(it, exchanged, dt);
    if (plate) at_plate([&](Index q) { balance.enthalpy_in += dt * it.passed[2][q]; });
    if (top) at_top([&](Index q) { balance.enthalpy_out += dt * it.passed[2][q]; });
    grid::for_each_cell(grid, [&](int, int, int, Index c) {
        if (grid.open(c)) state.enthalpy[c] = it.content[c] + evaporation_enthalpy_0 * state.vapour[c];
    });
    for (double& value : exchanged) value += math::zero_celsius;
}

void Solver::Inside::derive(State& state) const
{
    grid::for_each_cell(grid, [&](int, int, int, Index c) {
        if (!grid.open(c)) return;
        double const w = state.vapour[c] / state.mass[c];
        state.vapour_fraction[c] = w;
        state.temperature[c] = material::temperature(state.enthalpy[c] / state.mass[c], w);
        state.density[c] = state.mass[c] / (state.voidage[c] * grid.open_volume[c]);
    });
}
}
