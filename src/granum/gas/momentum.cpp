// The predictor: momentum of the gas on faces with the old pressure, implicit in convection, viscosity and drag.
//
// Control volumes are the halves of the two cells at a face, so their mass fluxes are means of the cells' fluxes and
// obey the cells' continuity. Convection takes the fluxes of the last step and has continuity subtracted: uniform flow
// stays uniform whatever the fluxes do. After the sweeps the convected momentum is evaluated once more face by face, so
// that what leaves one control volume enters the next to round-off.
#include "granum/gas/inside.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
constexpr double sweep_tolerance = 1e-6;  // change of a sweep over the largest speed
constexpr int most_sweeps = 200;
}

void Solver::Inside::set_plate_velocity(State& state, Field const& voidage) const
{
    if (!plate) return;
    double const density =
        equation_of_state(settings.pressure, settings.inlet->temperature, settings.inlet->vapour_fraction);
    double const flux = settings.inlet->mass_flow / plate_area;
    for (int j = 0; j < grid.n[1]; ++j)
        for (int i = 0; i < grid.n[0]; ++i) {
            Index const c = grid.at(i, j, 0);
            if (area[2][c] == 0) continue;
            state.mass_flux[2][c] = inlet_flux(c);
            state.velocity[2][c] = flux / (density * voidage[c]);
        }
}

void Solver::Inside::predict(State& state, SharedSources const& sources, Field const& voidage, double dt)
{
    auto& u = state.velocity;
    auto const& flux = state.mass_flux;
    Field viscous = grid.make_field();
    for (Index c = 0; c < viscous.size(); ++c) viscous[c] = grid.open(c) ? viscosity(state.temperature[c]) : 0;

    std::array<double, 2> outflow{};  // through the outlet: velocity times area, area
    if (top) {
        for (FaceRow const& face : faces[2]) {
            if (!face.outlet) continue;
            outflow[0] += u[2][face.face] * area[2][face.face];
            outflow[1] += area[2][face.face];
        }
        comm.sum(outflow);
    }
    double const mean_outflow = outflow[1] > 0 ? outflow[0] / outflow[1] : 0;

    FaceField constant = grid.make_face_field();  // right side without convection
    for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t r = 0; r < faces[d].size(); ++r) {
            FaceRow const& face = faces[d][r];
            Row& row = momentum_rows[d][r];
            Index const q = face.face, low = before(q, d);
            double const mass = face_mass(face, d, state.mass), gas = face_gas_volume(face, d, voidage);
            double const inertia = mass / dt;

            double drag = 0, push = 0;
            if (face.outlet) {
                drag = settings.outlet_resistance * area[d][q];
                push = drag * mean_outflow;
            } else {
                double const above = weights.lower[d][q], below = weights.upper[d][low];
                drag = below * sources.drag_coefficient[low] + above * sources.drag_coefficient[q];
                push = below * sources.push[d][low] + above * sources.push[d][q];
            }
            mobility[d][q] = inertia + drag;
            constant[d][q] =
                inertia * u[d][q] + push + mass * settings.gravity[d] - gas * pressure_slope(face, d, state.pressure);

            double const eps = gas / face_volume[d][q];
            double const mu = face.outlet ? viscous[low] : 0.5 * (viscous[low] + viscous[q]);
            auto const reach = viscous_reach(face, d);
            // What flows in, by neighbour.
            double inflow = std::max(0.0, 0.5 * (sources.mass[low] + (face.outlet ? 0 : sources.mass[q])));
            row.beside[2 * d] = std::max(0.5 * (flux[d][before(q, d)] + flux[d][q]), 0.0);
            row.beside[2 * d + 1] = face.outlet ? 0 : std::max(-0.5 * (flux[d][q] + flux[d][next(q, d)]), 0.0);
            for (std::size_t e = 0; e < 3; ++e) {
                if (e == d) continue;
                for (std::size_t side : {0u, 1u}) {
                    Index const beside = side == 0 ? before(q, e) : next(q, e);
                    Index const edge = side == 0 ? q : beside;
                    double const through = 0.5 * (flux[e][before(edge, d)] + (face.outlet ? 0 : flux[e][edge]));
                    double const in = std::max(side == 0 ? through : -through, 0.0);
                    bool const solved = face_volume[d][beside] > 0;
                    row.beside[2 * e + side] = solved ? in : 0;  // else as if its own velocity came in
                    if (!solved && face.on_plate && e == 2 && side == 0) inflow += in;  // plate gas rises straight
                }
            }
            double sum = 0;
            for (std::size_t m = 0; m < 6; ++m) sum += row.beside[m] += eps * mu * reach[m];
            row.right = constant[d][q];
            // Parts that act on the face alone: at rest at walls, plate gas and sources.
            double const alone = inflow + eps * mu * shear[d][q];
            row.centre = mobility[d][q] + alone + sum;
            row.inverse = 1 / row.centre;
        }

    std::array<std::ptrdiff_t, 6> offset{};
    for (std::size_t d = 0; d < 3; ++d) offset[2 * d] = -stride(d), offset[2 * d + 1] = stride(d);
    auto neighbours = [&](Row const& row, double const* at) {
        double sum = 0;
        for (std::size_t m = 0; m < 5; ++m) sum += row.beside[m] * at[offset[m]];
        // A face of the outlet lies in the uppermost layer: there is nothing above it, not even a ghost.
        if (row.beside[5] != 0) sum += row.beside[5] * at[offset[5]];
        return sum;
    };
    double scale = 0;  // largest speed of all ranks, from the first sweep
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double change = 0, speed = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            auto step = [&](std::size_t r) {
                Row const& row = momentum_rows[d][r];
                double* at = u[d].data() + faces[d][r].face;
                double const value = (row.right + neighbours(row, at)) * row.inverse;
                change = std::max(change, std::abs(value - *at));
                speed = std::max(speed, std::abs(value));
                *at = value;
            };
            std::size_t const count = faces[d].size();
            if (sweep % 2 == 0)
                for (std::size_t r = 0; r < count; ++r) step(r);
            else
                for (std::size_t r = count; r-- > 0;) step(r);
        }
        refresh({&u[0], &u[1], &u[2]});
        if (sweep == 0) scale = comm.size() > 1 ? comm.max(speed) : speed;
        if (comm.size() > 1) change = comm.max(change);
        if (change <= sweep_tolerance * scale) break;
    }

    // Once more with the exchange between control volumes taken from the converged values on both sides.
    for (std::size_t d = 0; d < 3; ++d) {
        Field const& swept = u[d];
        Field& exact = constant[d];
        for (std::size_t r = 0; r < faces[d].size(); ++r) {
            Row const& row = momentum_rows[d][r];
            Index const q = faces[d][r].face;
            double const own = row.centre - mobility[d][q];
            exact[q] = (exact[q] + neighbours(row, swept.data() + q) - own * swept[q]) / mobility[d][q];
        }
        for (FaceRow const& face : faces[d]) u[d][face.face] = exact[face.face];
    }
}
}
